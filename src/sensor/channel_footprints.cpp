#include "sensor/channel_footprints.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

using sampling::Point2;

/// A pixel's response in the cells of a grid, as shares of its energy.
std::vector<double> on_cells(const Psf* psf, Point2 shift_px, double side_px, double half_px, int cells) {
  const double cell = 2.0 * half_px / cells;
  std::vector<double> shares;
  shares.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  const double half_side = 0.5 * side_px;
  const auto overlap = [&](double low) {  // of a cell and the square about 0
    return std::max(0.0, std::min(low + cell, half_side) - std::max(low, -half_side));
  };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double x = i * cell - half_px - shift_px.x, y = j * cell - half_px - shift_px.y;
      if (psf == nullptr) {
        shares.push_back(overlap(x) * overlap(y) / (side_px * side_px));
        continue;
      }
      const double mx = x + 0.5 * cell, my = y + 0.5 * cell;
      shares.push_back(psf->energy(mx - half_side, my - half_side, mx + half_side, my + half_side) * cell *
                       cell / (side_px * side_px));
    }
  return shares;
}

double reach_px(const Psf* psf, Point2 shift_px, double side_px) {
  return 0.5 * side_px + (psf == nullptr ? 0.0 : psf->half_width_px()) +
         std::max(std::abs(shift_px.x), std::abs(shift_px.y));
}

/// Channels in the order of their shifts and wavelengths, each response once.
struct Distinct {
  ChannelResponse response;
  std::vector<int> channels;
};

std::vector<Distinct> distinct(std::span<const ChannelResponse> channels) {
  std::vector<int> order(channels.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int k) {
    const ChannelResponse& c = channels[static_cast<std::size_t>(k)];
    return std::tuple<double, double, const std::vector<double>&, double, int>(
        c.shift_px.y, c.shift_px.x, c.across_px, c.wavelength_um, k);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<Distinct> found;
  for (const int k : order) {
    const ChannelResponse& own = channels[static_cast<std::size_t>(k)];
    if (found.empty() || !(found.back().response == own)) found.push_back({own, {}});
    found.back().channels.push_back(k);
  }
  return found;
}

/// From one to the other, in the column of the image where they are farthest apart.
Point2 farthest_from(const ChannelResponse& one, const ChannelResponse& other) {
  const auto across = [](const ChannelResponse& of, std::size_t i) {
    return of.across_px.empty() ? 0.0 : of.across_px[i];
  };
  double most = other.shift_px.x - one.shift_px.x;
  const std::size_t columns = std::max(one.across_px.size(), other.across_px.size());
  const double between = most;
  for (std::size_t i = 0; i < columns; ++i)
    if (const double apart = between + across(other, i) - across(one, i);
        i == 0 || std::abs(apart) > std::abs(most))
      most = apart;
  return {most, other.shift_px.y - one.shift_px.y};
}

class Grouping {
 public:
  Grouping(std::vector<Distinct> all, double fill_factor, const PsfAt& psf_at, bool ordered)
      : all_(std::move(all)), fill_factor_(fill_factor), psf_at_(psf_at), ordered_(ordered) {}

  std::vector<ChannelGroup> groups() {
    std::vector<ChannelGroup> groups;
    for (std::size_t first = 0; first < all_.size();) {
      const std::size_t last = last_like(first);
      ChannelGroup& group = groups.emplace_back();
      // Of one shift, widths rise with the wavelength, and the middle is nearest to all.
      const std::size_t like = ordered_ && same_shift(first, last) ? first + (last - first) / 2 : first;
      group.like = all_[like].channels.front();
      group.psf = psf_at_(all_[like].response.wavelength_um);
      for (std::size_t k = first; k <= last; ++k)
        group.channels.insert(group.channels.end(), all_[k].channels.begin(), all_[k].channels.end());
      std::sort(group.channels.begin(), group.channels.end());
      first = last + 1;
    }
    std::sort(groups.begin(), groups.end(), [](const ChannelGroup& a, const ChannelGroup& b) {
      return a.channels.front() < b.channels.front();
    });
    return groups;
  }

 private:
  bool same_shift(std::size_t a, std::size_t b) const { return all_[a].response.lies_as(all_[b].response); }

  bool alike(std::size_t a, std::size_t b) {
    const ChannelResponse &one = all_[a].response, &other = all_[b].response;
    if (first_ == nullptr || first_um_ != one.wavelength_um)
      first_ = psf_at_(one.wavelength_um), first_um_ = one.wavelength_um;
    const std::shared_ptr<const Psf> second =
        other.wavelength_um == one.wavelength_um ? first_ : psf_at_(other.wavelength_um);
    const Point2 from = farthest_from(one, other);
    double apart = from.x == 0.0 && from.y == 0.0
                       ? energy_apart(first_.get(), one.shift_px, second.get(), one.shift_px, fill_factor_)
                       : energy_apart(first_.get(), {}, second.get(), from, fill_factor_);
    if (first_ != nullptr && one.wavelength_um > 0.0) {
      // What is cut off lies as far out as the wavelength is long.
      const double kept = first_->kept();
      apart = kept * apart + (1.0 - kept) * std::abs(other.wavelength_um / one.wavelength_um - 1.0);
    }
    return apart < kOneFootprint;
  }

  /// The last that goes with `first`: of the same shift by doubled steps and back, as differences grow with the wavelength.
  std::size_t last_like(std::size_t first) {
    std::size_t last = first, step = 1;
    const auto goes = [&](std::size_t k) {
      return k < all_.size() && same_shift(first, k) && alike(first, k);
    };
    for (; goes(last + step); step *= ordered_ ? 2 : 1) last += step;
    for (; step > 0; step /= 2)
      if (goes(last + step)) last += step;
    while (last + 1 < all_.size() && !same_shift(first, last + 1) && alike(first, last + 1)) ++last;
    return last;
  }

  std::vector<Distinct> all_;
  double fill_factor_;
  const PsfAt& psf_at_;
  bool ordered_;
  std::shared_ptr<const Psf> first_;
  double first_um_ = 0.0;
};

}  // namespace

double energy_apart(const Psf* one, Point2 shift_px, const Psf* other, Point2 other_shift_px,
                    double fill_factor) {
  constexpr int kCells = 192;
  const double side = std::sqrt(fill_factor);
  const auto fine = [&](const Psf* psf, double half) {
    return psf == nullptr || psf->detail_px() > 4.0 * half / kCells;  // two cells
  };
  const double half = std::max(reach_px(one, shift_px, side), reach_px(other, other_shift_px, side));
  const std::vector<double> a = on_cells(one, shift_px, side, half, kCells),
                            b = on_cells(other, other_shift_px, side, half, kCells);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  const double dx = std::abs(shift_px.x - other_shift_px.x), dy = std::abs(shift_px.y - other_shift_px.y);
  if ((dx == 0.0 && dy == 0.0) || (fine(one, half) && fine(other, half))) return std::min(1.0, 0.5 * sum);
  // Edges of the squares stand between the cells: what squares are apart by, and what the PSFs are about one place.
  const double squares = 1.0 - std::max(0.0, 1.0 - dx / side) * std::max(0.0, 1.0 - dy / side);
  return std::min(1.0, squares + energy_apart(one, {}, other, {}, fill_factor));
}

std::vector<ChannelGroup> group_channels(std::span<const ChannelResponse> channels, double fill_factor,
                                         const PsfAt& psf_at, bool ordered) {
  return Grouping(distinct(channels), fill_factor, psf_at, ordered).groups();
}

}  // namespace ifov::sensor
