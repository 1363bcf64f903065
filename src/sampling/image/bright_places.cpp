#include "sampling/image/bright_places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

using Rectangle = BrightPlaces::Rectangle;

constexpr std::uint64_t kThinning = 0x7468696eull;  // of random numbers
/// A place that is known to shine is quartered down to squares of this side: what is smaller may be missed.
constexpr double kSmallest_px = 1.0 / 256.0;
/// Squares along a pixel's side.
constexpr int kSquares = 4;
static_assert(kSquares * BrightPlaces::kWidest_px == 1.0);

std::uint64_t key_of(int i, int j) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(j)) << 32 | static_cast<std::uint32_t>(i);
}

/// What boxes have of a square.
struct Square {
  Rectangle about;
  std::optional<FocalPoint> brightest;
};

void add_quarters(const Rectangle& of, FocalPoint brightest, std::vector<Rectangle>& to) {
  if (std::max(of.x1 - of.x0, of.y1 - of.y0) <= kSmallest_px) {
    to.push_back(of);
    return;
  }
  const double x = 0.5 * (of.x0 + of.x1), y = 0.5 * (of.y0 + of.y1);
  for (const Rectangle& quarter :
       {Rectangle{of.x0, of.y0, x, y}, {x, of.y0, of.x1, y}, {of.x0, y, x, of.y1}, {x, y, of.x1, of.y1}})
    if (quarter.holds(brightest))
      add_quarters(quarter, brightest, to);
    else
      to.push_back(quarter);
}

}  // namespace

BrightPlaces::BrightPlaces(std::span<const Box> boxes) {
  std::map<std::pair<std::int64_t, std::int64_t>, Square> squares;  // by row and column
  for (const Box& box : boxes) {
    const Rectangle whole{box.centre.x_px - box.half_width_px, box.centre.y_px - box.half_height_px,
                          box.centre.x_px + box.half_width_px, box.centre.y_px + box.half_height_px};
    const auto square = [](double at_px) {
      return static_cast<std::int64_t>(std::floor(at_px / kWidest_px));
    };
    for (std::int64_t row = square(whole.y0); row <= square(whole.y1); ++row)
      for (std::int64_t column = square(whole.x0); column <= square(whole.x1); ++column) {
        const double x = kWidest_px * static_cast<double>(column), y = kWidest_px * static_cast<double>(row);
        const Rectangle part{std::max(whole.x0, x), std::max(whole.y0, y), std::min(whole.x1, x + kWidest_px),
                             std::min(whole.y1, y + kWidest_px)};
        if (!(part.x1 > part.x0) || !(part.y1 > part.y0)) continue;
        const auto [known, fresh] = squares.try_emplace({row, column}, Square{part, {}});
        Square& of = known->second;
        if (!fresh)
          of.about = {std::min(of.about.x0, part.x0), std::min(of.about.y0, part.y0),
                      std::max(of.about.x1, part.x1), std::max(of.about.y1, part.y1)};
        if (box.brightest && part.holds(*box.brightest)) of.brightest = box.brightest;
      }
  }
  for (const auto& [at, square] : squares) {
    const auto pixel = [](std::int64_t number) {
      return static_cast<int>(std::floor(static_cast<double>(number) / kSquares));
    };
    const int i = pixel(at.second), j = pixel(at.first);
    const auto [known, fresh] = by_pixel_.try_emplace(key_of(i, j));
    if (fresh) pixels_.push_back({i, j});
    if (square.brightest && square.about.holds(*square.brightest))
      add_quarters(square.about, *square.brightest, known->second);
    else
      known->second.push_back(square.about);
  }
  std::sort(pixels_.begin(), pixels_.end(),
            [](const Pixel& a, const Pixel& b) { return std::pair(a.j, a.i) < std::pair(b.j, b.i); });
}

std::span<const Rectangle> BrightPlaces::in(int i, int j) const {
  const auto found = by_pixel_.find(key_of(i, j));
  return found == by_pixel_.end() ? std::span<const Rectangle>() : found->second;
}

bool BrightShares::hold(FocalPoint point) const {
  return std::any_of(parts.begin(), parts.end(), [&](const Part& part) { return part.where.holds(point); });
}

BrightShares bright_shares(const TileProblem& problem, const ColumnFootprints& footprints, int i, int j) {
  BrightShares shares;
  shares.left.assign(footprints.groups(), 1.0);
  if (problem.bright == nullptr || problem.bright->empty()) return shares;
  const double reach = footprints.half_width_px(), x = i + 0.5, y = j + 0.5;
  const Rectangle support{x - reach, y - reach, x + reach, y + reach};
  const auto pixel = [](double at_px) { return static_cast<int>(std::floor(at_px)); };
  for (int row = pixel(support.y0); row <= pixel(support.y1); ++row)
    for (int column = pixel(support.x0); column <= pixel(support.x1); ++column)
      for (const Rectangle& place : problem.bright->in(column, row)) {
        BrightShares::Part part{{std::max(place.x0, support.x0), std::max(place.y0, support.y0),
                                 std::min(place.x1, support.x1), std::min(place.y1, support.y1)},
                                std::vector<double>(footprints.groups(), 0.0)};
        const Rectangle& where = part.where;
        if (!(where.x1 > where.x0) || !(where.y1 > where.y0)) continue;
        bool any = false;
        for (std::size_t g = 0; g < footprints.groups(); ++g) {
          part.share[g] = footprints.integral(g, i, where.x0 - x, where.y0 - y, where.x1 - x, where.y1 - y);
          any = any || part.share[g] > 0.0;
        }
        if (any) shares.parts.push_back(std::move(part));
      }
  for (const BrightShares::Part& part : shares.parts)
    for (std::size_t g = 0; g < part.share.size(); ++g)
      shares.left[g] = std::max(0.0, shares.left[g] - part.share[g]);
  return shares;
}

BrightWarp::BrightWarp(const PixelFootprint& footprint, const Rectangle& where, int i, int j)
    : footprint_(footprint), where_(where), x_(i + 0.5), y_(j + 0.5) {
  if (footprint.uniform()) return;
  const double width = (where.x1 - where.x0) / kCells, height = (where.y1 - where.y0) / kCells;
  double all = 0.0;
  for (int b = 0; b < kCells; ++b) {
    double row = 0.0;
    for (int a = 0; a < kCells; ++a) {
      const double x = where.x0 - x_ + a * width, y = where.y0 - y_ + b * height;
      cells_.push_back(row += std::max(0.0, footprint.integral(x, y, x + width, y + height)));
    }
    rows_.push_back(all += row);
  }
}

FocalPoint BrightWarp::at(Point2 u, std::uint64_t key) const {
  const auto between = [](double from, double to, double t) { return from + (to - from) * t; };
  if (rows_.empty() || !(rows_.back() > 0.0))
    return {between(where_.x0, where_.x1, u.x), between(where_.y0, where_.y1, u.y)};
  // Which cell of running sums a share of their last lies in, and where in that.
  const auto find = [](const double* sums, double share, double& within) {
    const double wanted = share * sums[kCells - 1];
    int k = 0;
    while (k + 1 < kCells && (sums[k] <= wanted || sums[k] <= (k > 0 ? sums[k - 1] : 0.0))) ++k;
    const double before = k > 0 ? sums[k - 1] : 0.0, own = sums[k] - before;
    within = own > 0.0 ? std::clamp((wanted - before) / own, 0.0, 1.0) : 0.5;
    return k;
  };
  double down = 0.0, across = 0.0;
  const int b = find(rows_.data(), u.y, down);
  const int a = find(cells_.data() + static_cast<std::ptrdiff_t>(b) * kCells, u.x, across);
  const double width = (where_.x1 - where_.x0) / kCells, height = (where_.y1 - where_.y0) / kCells;
  const double x0 = where_.x0 + a * width, y0 = where_.y0 + b * height;
  const auto density = [&](double x, double y) { return footprint_.density(x - x_, y - y_); };
  // Within a cell the density hardly differs; what it does is kept by thinning.
  double most = density(x0 + 0.5 * width, y0 + 0.5 * height);
  for (const double s : {0.0, 1.0})
    for (const double t : {0.0, 1.0}) most = std::max(most, density(x0 + s * width, y0 + t * height));
  constexpr double kRoom = 1.1;
  constexpr std::uint64_t kMostTries = 32;
  FocalPoint point{x0 + across * width, y0 + down * height};
  for (std::uint64_t k = 1; k < kMostTries; ++k) {
    if (unit_double(hash(key, k, kThinning)) * kRoom * most <= density(point.x_px, point.y_px)) break;
    point = {x0 + width * unit_double(hash(key, k, kThinning + 1)),
             y0 + height * unit_double(hash(key, k, kThinning + 2))};
  }
  return point;
}

}  // namespace ifov::sampling
