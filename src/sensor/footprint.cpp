#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

constexpr double kCellsOverDetail = 8.0;
constexpr int kFewestCellsPerPixel = 16;
constexpr int kMostCells = 1024;

}  // namespace

sampling::PixelFootprint make_footprint(const Psf* psf, double fill_factor) {
  if (!(fill_factor > 0.0) || !(fill_factor <= 1.0))
    throw InputError(format("a fill factor of {}; expected more than 0 and at most 1", fill_factor));
  const double side_px = std::sqrt(fill_factor);
  if (psf == nullptr) return sampling::PixelFootprint::box(side_px);

  const double half_width_px = psf->half_width_px() + 0.5 * side_px;
  const double cells_per_pixel =
      std::max<double>(kFewestCellsPerPixel, kCellsOverDetail / std::min(psf->detail_px(), side_px));
  const int cells = static_cast<int>(
      std::clamp(std::ceil(2.0 * half_width_px * cells_per_pixel), 1.0, static_cast<double>(kMostCells)));
  const double cell_px = 2.0 * half_width_px / cells;

  std::vector<double> density;
  density.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) * cell_px - half_width_px, y = (j + 0.5) * cell_px - half_width_px;
      const double energy =
          psf->energy(x - 0.5 * side_px, y - 0.5 * side_px, x + 0.5 * side_px, y + 0.5 * side_px);
      density.push_back(std::max(0.0, energy) / fill_factor);
    }
  return sampling::PixelFootprint::tabulated(half_width_px, cells, std::move(density));
}

}  // namespace ifov::sensor
