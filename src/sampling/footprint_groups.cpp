#include "sampling/footprint_groups.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ifov::sampling {

namespace {

/// How far a group's footprint goes to the left and the right across the image.
std::pair<double, double> across(const FootprintGroup& group) {
  if (group.across_px.empty()) return {0.0, 0.0};
  const auto [least, most] = std::minmax_element(group.across_px.begin(), group.across_px.end());
  return {*least, *most};
}

/// Places of it that stand for all columns, no more than a sixteenth of its width apart where that are not too many.
std::vector<double> places_across(const FootprintGroup& group) {
  const auto [left, right] = across(group);
  if (left == right) return {left};
  constexpr double kMost = 33.0;
  const double steps =
      std::clamp(std::ceil((right - left) * 8.0 / group.footprint.half_width_px()), 1.0, kMost - 1.0);
  std::vector<double> places;
  for (int k = 0; k <= static_cast<int>(steps); ++k) places.push_back(left + (right - left) * k / steps);
  return places;
}

}  // namespace

FootprintGroups::FootprintGroups(std::vector<FootprintGroup> groups, std::vector<int> group_of_channel)
    : groups_(std::move(groups)), of_channel_(std::move(group_of_channel)) {
  if (groups_.empty()) throw std::invalid_argument("no footprint");
  for (const int group : of_channel_)
    if (group < 0 || group >= static_cast<int>(groups_.size()))
      throw std::invalid_argument("a channel of a group of footprints that there is not");
  double finest = 1.0 / 16.0;
  for (const FootprintGroup& group : groups_) {
    const double half = group.footprint.half_width_px();
    const auto [left, right] = across(group);
    half_width_px_ = std::max({half_width_px_, half + std::abs(group.shift_px.x + left),
                               half + std::abs(group.shift_px.x + right), half + std::abs(group.shift_px.y)});
    finest = std::min(finest, half / 16.0);
    by_column_ = by_column_ || left != right;
  }
  constexpr double kMostCells = 1024.0;
  const int cells = static_cast<int>(std::min(kMostCells, std::ceil(2.0 * half_width_px_ / finest)));
  const double side = 2.0 * half_width_px_ / cells;
  std::vector<double> mean(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0);
  for (const FootprintGroup& group : groups_) {
    std::vector<double> own(mean.size(), 0.0);
    for (const double further : places_across(group))
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
          const double x = i * side - half_width_px_ - group.shift_px.x - further,
                       y = j * side - half_width_px_ - group.shift_px.y;
          own[static_cast<std::size_t>(j * cells + i)] +=
              std::max(0.0, group.footprint.integral(x, y, x + side, y + side));
        }
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += own[k];
    tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(own)));
  }
  tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(mean)));
}

double FootprintGroups::importance(std::size_t group, int column, double dx_px, double dy_px) const {
  const double all = mixture().density(dx_px, dy_px);
  if (!(all > 0.0)) return 0.0;
  const FootprintGroup& of = groups_[group];
  if (of.across_px.empty()) return tables_[group].density(dx_px, dy_px) / all;
  const Point2 s = of.shift_at(column);
  return of.footprint.density(dx_px - s.x, dy_px - s.y) / all;
}

ColumnFootprints::ColumnFootprints(const PixelFootprint& of_all, const FootprintGroups* groups,
                                   std::span<const int> channels)
    : one_(&of_all), groups_(groups) {
  if (groups_ == nullptr) return;
  for (const int channel : channels)
    of_column_.push_back(static_cast<std::uint16_t>(groups_->group_of(channel)));
}

int ColumnFootprints::reach() const {
  return std::max(0, static_cast<int>(std::ceil(half_width_px() - 0.5 - 1e-12)));
}

bool ColumnFootprints::reaches(std::size_t group, int at, int dx, int dy) const {
  const double far = footprint(group).half_width_px() + 0.5 - 1e-12;
  const Point2 s = shift_px(group, at);
  return std::abs(dx - s.x) < far && std::abs(dy - s.y) < far;
}

std::vector<std::vector<std::size_t>> ColumnFootprints::positions(std::span<const int> columns) const {
  std::vector<std::vector<std::size_t>> found(groups());
  for (std::size_t k = 0; k < columns.size(); ++k)
    found[group_of(static_cast<std::size_t>(columns[k]))].push_back(k);
  return found;
}

}  // namespace ifov::sampling
