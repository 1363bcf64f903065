#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "sensor/along_track.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

constexpr double kCellsOverDetail = 8.0;
constexpr int kFewestCellsPerPixel = 16;
constexpr int kMostCells = 1024;
constexpr double kMostFill = 16.0;  // sides of four pitches

/// What lies straight between values is wider than what they are of, by a variance of a sixth of a cell along each axis: a twelfth of the
/// second differences less makes it as wide.
std::vector<double> sharpened(const std::vector<double>& density, int cells) {
  const auto n = static_cast<std::size_t>(cells);
  std::vector<double> sharp(density.size());
  const auto bend = [](double before, double here, double after) { return before - 2.0 * here + after; };
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = [&](std::size_t x, std::size_t y) { return x < n && y < n ? density[y * n + x] : 0.0; };
      const double here = density[j * n + i], across = bend(at(i - 1, j), here, at(i + 1, j)),
                   down = bend(at(i, j - 1), here, at(i, j + 1));
      sharp[j * n + i] = std::max(0.0, here - (across + down) / 12.0);
    }
  return sharp;
}

double side_of(double fill_factor) {
  if (!(fill_factor > 0.0) || !(fill_factor <= kMostFill))
    throw InputError(
        format("a fill factor of {}; expected more than 0 and at most {}", fill_factor, kMostFill));
  return std::sqrt(fill_factor);
}

struct Cells {
  double half_width_px, side_px;
  int count;  // along a side
  double centre_px(int cell) const { return (cell + 0.5) * side_px - half_width_px; }
};

Cells cells_for(const Psf& psf, double side_px, double half_width_px) {
  const double cells_per_pixel =
      std::max<double>(kFewestCellsPerPixel, kCellsOverDetail / std::min(psf.detail_px(), side_px));
  const int count = static_cast<int>(
      std::clamp(std::ceil(2.0 * half_width_px * cells_per_pixel), 1.0, static_cast<double>(kMostCells)));
  return {half_width_px, 2.0 * half_width_px / count, count};
}

/// Along one axis values cost little: what is straight between them is within 1e-4 of a Gaussian as far out as it is kept.
constexpr int kFiner = 24;

/// What the PSF leaves of a density along an axis, which `below` integrates.
template <class Below>
std::vector<double> blurred(const Psf& psf, const Cells& cells, bool along_x, const Below& below) {
  const double far_px = psf.half_width_px();
  const int n = kFiner * cells.count;
  const double step = cells.side_px / kFiner;
  // Energy of the PSF by how far it goes, in steps.
  const int reach = std::min(n - 1, static_cast<int>(std::ceil(far_px / step)) + 1);
  std::vector<double> spread(static_cast<std::size_t>(2 * reach + 1)), shares(static_cast<std::size_t>(n)),
      density(static_cast<std::size_t>(n), 0.0);
  for (int m = -reach; m <= reach; ++m) {
    const double a = (m - 0.5) * step, b = (m + 0.5) * step;
    spread[static_cast<std::size_t>(m + reach)] =
        std::max(0.0, along_x ? psf.energy(a, -far_px, b, far_px) : psf.energy(-far_px, a, far_px, b));
  }
  for (int k = 0; k < n; ++k) {
    const double from = k * step - cells.half_width_px;
    shares[static_cast<std::size_t>(k)] = below(from + step) - below(from);
  }
  for (int k = 0; k < n; ++k) {
    if (!(shares[static_cast<std::size_t>(k)] > 0.0)) continue;
    for (int j = std::max(0, k - reach); j <= std::min(n - 1, k + reach); ++j)
      density[static_cast<std::size_t>(j)] +=
          shares[static_cast<std::size_t>(k)] * spread[static_cast<std::size_t>(j - k + reach)];
  }
  return density;
}

/// Below a place, of what is even over `side_px`.
auto even(double side_px) {
  return [side_px](double at) { return std::clamp(at / side_px + 0.5, 0.0, 1.0); };
}

}  // namespace

sampling::PixelFootprint make_footprint(const Psf* psf, double fill_factor) {
  const double side_px = side_of(fill_factor);
  if (psf == nullptr) return sampling::PixelFootprint::box(side_px);

  const Cells cells = cells_for(*psf, side_px, psf->half_width_px() + 0.5 * side_px);
  if (psf->separable()) {
    // Exact, where values of a convolution of steps would not be.
    const auto along = [&](bool along_x) {
      const double far_px = psf->half_width_px();
      std::vector<double> density;
      for (int k = 0; k < kFiner * cells.count; ++k) {
        const double middle = (k + 0.5) * cells.side_px / kFiner - cells.half_width_px,
                     a = middle - 0.5 * side_px, b = middle + 0.5 * side_px;
        density.push_back(
            std::max(0.0, along_x ? psf->energy(a, -far_px, b, far_px) : psf->energy(-far_px, a, far_px, b)));
      }
      return density;
    };
    return sampling::PixelFootprint::product(cells.half_width_px, cells.side_px, along(true), along(false));
  }

  std::vector<double> density;
  density.reserve(static_cast<std::size_t>(cells.count) * static_cast<std::size_t>(cells.count));
  for (int j = 0; j < cells.count; ++j)
    for (int i = 0; i < cells.count; ++i) {
      const double x = cells.centre_px(i), y = cells.centre_px(j);
      const double energy =
          psf->energy(x - 0.5 * side_px, y - 0.5 * side_px, x + 0.5 * side_px, y + 0.5 * side_px);
      density.push_back(std::max(0.0, energy) / fill_factor);
    }
  return sampling::PixelFootprint::tabulated(cells.half_width_px, cells.count,
                                             sharpened(density, cells.count));
}

namespace {

/// A table of what is spread over by a density along the track (y), or along x where the elements are swept, and by the PSF.
sampling::PixelFootprint spread(const Psf& psf, double side_px, const sampling::PixelFootprint& striped) {
  const double half_width_px = psf.half_width_px() + striped.half_width_px();
  const Cells of_table = cells_for(psf, side_px, half_width_px);
  if (psf.separable()) {
    const auto along = [&](double at) {
      return striped.along_x() ? striped.integral(-half_width_px, -half_width_px, at, half_width_px)
                               : striped.integral(-half_width_px, -half_width_px, half_width_px, at);
    };
    const bool turned = striped.along_x();
    std::vector<double> moved = blurred(psf, of_table, turned, along),
                        across = blurred(psf, of_table, !turned, even(side_px));
    if (turned) std::swap(moved, across);
    return sampling::PixelFootprint::product(half_width_px, of_table.side_px, std::move(across),
                                             std::move(moved));
  }
  const int cells = of_table.count;
  const double cell_px = of_table.side_px;
  const auto n = static_cast<std::size_t>(cells);
  const bool along_x = striped.along_x();
  // Along the pieces as shares of rows, each spread by the PSF to rows 0, 1, 2, ... away, either way.
  std::vector<double> share(n), spread(2 * n - 1), density(n * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const double from = static_cast<double>(k) * cell_px - half_width_px, to = from + cell_px;
    share[k] = along_x ? striped.integral(from, -half_width_px, to, half_width_px)
                       : striped.integral(-half_width_px, from, half_width_px, to);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double across = (static_cast<double>(i) + 0.5) * cell_px - half_width_px;
    const double a0 = across - 0.5 * side_px, a1 = across + 0.5 * side_px;
    for (std::size_t m = 0; m < spread.size(); ++m) {
      const double along = (static_cast<double>(m) - (cells - 1.0)) * cell_px;
      const double b0 = along - 0.5 * cell_px, b1 = along + 0.5 * cell_px;
      spread[m] = std::max(0.0, along_x ? psf.energy(b0, a0, b1, a1) : psf.energy(a0, b0, a1, b1));
    }
    for (std::size_t k = 0; k < n; ++k)
      if (share[k] > 0.0)
        for (std::size_t j = 0; j < n; ++j)
          density[along_x ? i * n + j : j * n + i] += share[k] * spread[j + n - 1 - k];
  }
  return sampling::PixelFootprint::tabulated(half_width_px, cells, sharpened(density, cells));
}

}  // namespace

sampling::PixelFootprint make_footprint(const Psf* psf, double fill_factor, const AlongTrack& along) {
  if (along.square(fill_factor)) return make_footprint(psf, fill_factor);
  const double side_px = side_of(fill_factor);
  const auto striped = sampling::PixelFootprint::striped(side_px, along.pieces());
  return psf == nullptr ? striped : spread(*psf, side_px, striped);
}

sampling::PixelFootprint make_swept_footprint(const Psf* psf, double fill_factor, const AlongTrack& along) {
  if (along.square(fill_factor)) return make_footprint(psf, fill_factor);
  const double side_px = side_of(fill_factor);
  const auto striped = sampling::PixelFootprint::striped_along_x(side_px, along.pieces());
  return psf == nullptr ? striped : spread(*psf, side_px, striped);
}

}  // namespace ifov::sensor
