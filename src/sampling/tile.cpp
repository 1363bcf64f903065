#include "sampling/tile.h"

namespace ifov::sampling {

void TileResult::reset(PixelRect tile_pixels, int column_count, bool with_errors) {
  tile = tile_pixels;
  columns = column_count;
  const std::size_t pixels = static_cast<std::size_t>(tile.count());
  const std::size_t cells = pixels * static_cast<std::size_t>(columns);
  mean.assign(cells, 0.0f);
  const std::size_t error_cells = with_errors ? cells : 0;
  variance_geometry.assign(error_cells, 0.0f);
  variance_path.assign(error_cells, 0.0f);
  half_width.assign(error_cells, 0.0f);
  samples.assign(pixels, 0);
  label_rays.assign(pixels, 0);
  radiance_evaluations.assign(pixels, 0);
  reasons.assign(pixels, bit(Reason::unjudged));
  worst_ratio.assign(pixels, 0.0f);
  missable_fraction.assign(pixels, 1.0f);
  abundances.clear();
  halo_samples = seed_samples = probe_samples = 0;
  rays = {};
  memory.clear();
}

}  // namespace ifov::sampling
