#include "sensor/psf_wings.h"

#include <algorithm>
#include <cmath>

#include "sensor/energy_table.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

constexpr double kFinest_px = 1.0 / 80.0, kCoarsest_px = 1.0 / 32.0;
constexpr double kStepsOverDetail = 4.0;
constexpr double kNothing = 1e-13;    // what rounding leaves of a share of 0
constexpr double kNoDensity = 1e-15;  // likewise, per px^2
constexpr int kDetectorSteps = 8;     // along a side of the sensitive square

/// Energy of the density over small cells of [-half, half]^2, as sums that rectangles are taken from.
EnergyTable near_energy(const Psf& psf, double half_px, double step_px, bool smooth, double& total) {
  const int cells = 2 * static_cast<int>(std::ceil(half_px / step_px));
  const double side = 2.0 * half_px / cells;
  std::vector<double> energy(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  const bool mirrored = psf.mirrored();
  for (int j = 0; j < (mirrored ? cells / 2 : cells); ++j)
    for (int i = 0; i < (mirrored ? cells / 2 : cells); ++i) {
      const double e =
          side * side * psf.cut_density((i + 0.5) * side - half_px, (j + 0.5) * side - half_px, smooth);
      for (const int row : {j, mirrored ? cells - 1 - j : j})
        for (const int column : {i, mirrored ? cells - 1 - i : i})
          energy[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells) +
                 static_cast<std::size_t>(column)] = e;
    }
  total = 0.0;
  for (const double e : energy) total += e;
  if (!(total > 0.0)) energy[0] = 1.0;  // the cut lies beyond; multiplied by 0 later
  return {cells, cells, side, energy};
}

}  // namespace

PsfWings::PsfWings(const Psf& psf, double fill_factor, sampling::Point2 shift_px)
    : PsfWings(psf, sampling::Point2{std::sqrt(fill_factor), std::sqrt(fill_factor)}, shift_px) {}

PsfWings::PsfWings(const Psf& psf, sampling::Point2 sides_px, sampling::Point2 shift_px)
    : kept_(psf.kept()), sides_(sides_px), round_(psf.round()), shift_(shift_px) {
  tabulate_radius(psf);
  const double sx = shift_px.x, sy = shift_px.y;
  const double half_px =
      0.25 * kHalfCells + 0.5 * std::max(sides_.x, sides_.y) + std::max(std::abs(sx), std::abs(sy));
  const double wanted_px = psf.detail_px() / kStepsOverDetail;
  const bool smooth = wanted_px < kFinest_px;
  double total = 0.0;
  const EnergyTable near =
      near_energy(psf, half_px, smooth ? kCoarsest_px : std::min(wanted_px, kCoarsest_px), smooth, total);
  near_.assign(static_cast<std::size_t>(kHalfCells) * kHalfCells, 0.0);
  for (int row = 0; row < kHalfCells; ++row)
    for (int column = 0; column < kHalfCells; ++column) {
      const double x = 0.5 * (column - kHalfCells / 2) - 0.5 - sx,
                   y = 0.5 * (row - kHalfCells / 2) - 0.5 - sy;
      double sum = 0.0;
      for (int b = 0; b < kDetectorSteps; ++b)
        for (int a = 0; a < kDetectorSteps; ++a) {
          const double u = ((a + 0.5) / kDetectorSteps - 0.5) * sides_.x,
                       v = ((b + 0.5) / kDetectorSteps - 0.5) * sides_.y;
          sum += near.within(x + u, y + v, x + u + 0.5, y + v + 0.5);
        }
      const double share = total * sum / (kDetectorSteps * kDetectorSteps);
      near_[static_cast<std::size_t>(row * kHalfCells + column)] = share > kNothing ? share : 0.0;
    }
  points_.resize(static_cast<std::size_t>(kPoints) * kPoints);
  for (int row = 0; row < kPoints; ++row)
    for (int column = 0; column < kPoints; ++column) {
      const double x = static_cast<double>(column - kPoints / 2) / kPointSteps - sx - 0.5 * sides_.x,
                   y = static_cast<double>(row - kPoints / 2) / kPointSteps - sy - 0.5 * sides_.y;
      const double share = total * near.within(x, y, x + sides_.x, y + sides_.y);
      points_[static_cast<std::size_t>(row * kPoints + column)] =
          share > kNothing ? share / (sides_.x * sides_.y) : 0.0;
    }

  // Points along a pixel's side; the mean of rings alone would have no spikes.
  const bool mirrored = psf.mirrored(), rings_average = mirrored && psf.detail_px() < 0.5;
  const int sub = mirrored ? 4 : std::clamp(static_cast<int>(std::ceil(2.0 / psf.detail_px())), 4, 8);
  const auto on_pixel = [&](int x, int y) {
    double sum = 0.0;
    for (int b = 0; b < sub; ++b)
      for (int a = 0; a < sub; ++a)
        sum += psf.cut_density(x + (a + 0.5) / sub - 0.5 - sx, y + (b + 0.5) / sub - 0.5 - sy, rings_average);
    return sum / (sub * sub);
  };
  // Alike in all eighths where it is round and stands in the middle, else in quarters.
  const bool alike = mirrored && sx == 0.0 && sy == 0.0;
  std::vector<double> quarter(static_cast<std::size_t>(kReach + 1) * (kReach + 1));
  for (int y = 0; alike && y <= kReach; ++y)
    for (int x = 0; x <= (round_ ? y : kReach); ++x) {
      const double own = on_pixel(x, y);
      quarter[static_cast<std::size_t>(y * (kReach + 1) + x)] = own;
      if (round_) quarter[static_cast<std::size_t>(x * (kReach + 1) + y)] = own;
    }
  constexpr std::size_t kStride = 2 * kReach + 1;
  summed_.assign(kStride * kStride, 0.0);
  for (int y = -kReach; y < kReach; ++y)
    for (int x = -kReach; x < kReach; ++x) {
      const std::size_t at =
          static_cast<std::size_t>(y + kReach) * kStride + static_cast<std::size_t>(x + kReach);
      const double own = alike ? quarter[static_cast<std::size_t>(std::abs(y) * (kReach + 1) + std::abs(x))]
                               : on_pixel(x, y);
      summed_[at + kStride + 1] = own + summed_[at + kStride] + summed_[at + 1] - summed_[at];
    }
}

double PsfWings::square(int x0, int y0, int side) const {
  const int x = x0 + kReach, y = y0 + kReach;
  return summed(x + side, y + side) - summed(x, y + side) - summed(x + side, y) + summed(x, y);
}

void PsfWings::tabulate_radius(const Psf& psf) {
  constexpr double kStepsOverRing = 32.0, kFinestRadial_px = 1.0 / 512.0;
  const double wanted_px = 2.0 * psf.detail_px() / kStepsOverRing;
  const bool smooth = wanted_px < kFinestRadial_px || !psf.round();
  radial_step_px_ = std::clamp(wanted_px, kFinestRadial_px, 1.0 / 32.0);
  const auto count = static_cast<std::size_t>((kRadialTo_px - kRadialFrom_px) / radial_step_px_) + 2;
  radial_.resize(count);
  for (std::size_t k = count; k-- > 0;) {
    Radial& here = radial_[k];
    here.density = psf.cut_density(kRadialFrom_px + static_cast<double>(k) * radial_step_px_, 0.0, smooth);
    if (k + 1 == count) continue;
    const Radial& next = radial_[k + 1];
    // Of a density that is straight between the places.
    const double h = radial_step_px_;
    here.once = next.once - 0.5 * h * (here.density + next.density);
    here.twice = next.twice - h * next.once + h * h * (here.density + 2.0 * next.density) / 6.0;
  }
}

double PsfWings::twice_integrated(double r_px) const {
  const double place =
      std::clamp((r_px - kRadialFrom_px) / radial_step_px_, 0.0, static_cast<double>(radial_.size()) - 1.001);
  const auto k = static_cast<std::size_t>(place);
  const double t = (place - static_cast<double>(k)) * radial_step_px_;
  const Radial& here = radial_[k];
  const double rise = (radial_[k + 1].density - here.density) / radial_step_px_;
  return here.twice + t * (here.once + t * (here.density / 2.0 + t * rise / 6.0));
}

/// Of spikes and what else does not go by the distance alone: from the means over the four pixels about the place. The response is narrower than
/// what lies between them, by less than they differ.
PsfWings::Density PsfWings::between_pixels(double dx_px, double dy_px) const {
  constexpr double kBent = 0.03;
  const double column = std::floor(dx_px), row = std::floor(dy_px);
  const double u = dx_px - column, v = dy_px - row;
  double sum = 0.0, low = INFINITY, high = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner % 2, below = corner / 2;
    const double known = square(static_cast<int>(column) + right, static_cast<int>(row) + below, 1);
    sum += (right != 0 ? u : 1.0 - u) * (below != 0 ? v : 1.0 - v) * known;
    low = std::min(low, known);
    high = std::max(high, known);
  }
  return sum > kNoDensity ? Density{sum, 0.5 * (high - low) + kBent * sum} : Density{0.0, 0.0};
}

PsfWings::Density PsfWings::density(double dx_px, double dy_px) const {
  constexpr double kNearest_px = 0.25 * kHalfCells, kBent = 0.03;
  if (std::abs(dx_px) < kNearest_px && std::abs(dy_px) < kNearest_px) {
    const double column = std::floor(dx_px * kPointSteps), row = std::floor(dy_px * kPointSteps);
    const double u = dx_px * kPointSteps - column, v = dy_px * kPointSteps - row;
    double sum = 0.0, low = INFINITY, high = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
      const int i = static_cast<int>(column) + corner % 2, j = static_cast<int>(row) + corner / 2;
      const double known = points_[static_cast<std::size_t>((j + kPoints / 2) * kPoints + i + kPoints / 2)];
      sum += (corner % 2 != 0 ? u : 1.0 - u) * (corner / 2 != 0 ? v : 1.0 - v) * known;
      low = std::min(low, known);
      high = std::max(high, known);
    }
    // What lies between the places, and where in a cell of the energy's table the cut does, is less than what the corners
    // differ by.
    return {sum, 0.5 * (high - low) + kBent * sum};
  }
  const double x = dx_px - shift_.x, y = dy_px - shift_.y, r = std::hypot(x, y);
  constexpr double kFarthest_px = kRadialTo_px - 2.0;
  if (r > kFarthest_px) {
    const double scale = kFarthest_px / r;
    const auto [there, unsure] = density(shift_.x + x * scale, shift_.y + y * scale);
    return {there * scale * scale * scale, unsure * scale * scale * scale};
  }
  if (!round_) return between_pixels(dx_px, dy_px);
  // So far out rings are straight over a pixel: of its square what counts is how wide it is across them.
  constexpr double kNarrow = 0.05;
  const double a = sides_.x * std::max(kNarrow, std::abs(x) / r),
               b = sides_.y * std::max(kNarrow, std::abs(y) / r);
  const double share = (twice_integrated(r + 0.5 * (a + b)) - twice_integrated(r + 0.5 * (a - b)) -
                        twice_integrated(r - 0.5 * (a - b)) + twice_integrated(r - 0.5 * (a + b))) /
                       (a * b);
  return share > kNoDensity ? Density{share, kBent * share} : Density{0.0, 0.0};
}

}  // namespace ifov::sensor
