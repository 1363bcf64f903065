#include "sampling/footprint_groups.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ifov::sampling {

FootprintGroups::FootprintGroups(std::vector<FootprintGroup> groups, std::vector<int> group_of_channel)
    : groups_(std::move(groups)), of_channel_(std::move(group_of_channel)) {
  if (groups_.empty()) throw std::invalid_argument("no footprint");
  for (const int group : of_channel_)
    if (group < 0 || group >= static_cast<int>(groups_.size()))
      throw std::invalid_argument("a channel of a group of footprints that there is not");
  double finest = 1.0 / 16.0;
  for (const FootprintGroup& group : groups_) {
    const double half = group.footprint.half_width_px();
    half_width_px_ =
        std::max({half_width_px_, half + std::abs(group.shift_px.x), half + std::abs(group.shift_px.y)});
    finest = std::min(finest, half / 16.0);
  }
  constexpr double kMostCells = 1024.0;
  const int cells = static_cast<int>(std::min(kMostCells, std::ceil(2.0 * half_width_px_ / finest)));
  const double side = 2.0 * half_width_px_ / cells;
  std::vector<double> mean(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0);
  for (const FootprintGroup& group : groups_) {
    std::vector<double> own;
    own.reserve(mean.size());
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const double x = i * side - half_width_px_ - group.shift_px.x,
                     y = j * side - half_width_px_ - group.shift_px.y;
        own.push_back(std::max(0.0, group.footprint.integral(x, y, x + side, y + side)));
      }
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += own[k];
    tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(own)));
  }
  tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(mean)));
}

double FootprintGroups::importance(std::size_t group, double dx_px, double dy_px) const {
  const double all = mixture().density(dx_px, dy_px);
  return all > 0.0 ? tables_[group].density(dx_px, dy_px) / all : 0.0;
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

bool ColumnFootprints::reaches(std::size_t group, int dx, int dy) const {
  const double far = footprint(group).half_width_px() + 0.5 - 1e-12;
  const Point2 s = shift_px(group);
  return std::abs(dx - s.x) < far && std::abs(dy - s.y) < far;
}

std::vector<std::vector<std::size_t>> ColumnFootprints::positions(std::span<const int> columns) const {
  std::vector<std::vector<std::size_t>> found(groups());
  for (std::size_t k = 0; k < columns.size(); ++k)
    found[group_of(static_cast<std::size_t>(columns[k]))].push_back(k);
  return found;
}

}  // namespace ifov::sampling
