#include "sampling/tile.h"

#include <cmath>

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
  border_share.clear();
  position_m.clear();
  halo_samples = seed_samples = probe_samples = 0;
  rays = {};
  memory.clear();
}

float TileResult::share_of_borders(std::size_t pixel) const {
  if (!border_share.empty()) return border_share[pixel];
  if (variance_geometry.empty()) return 1.0f;
  const auto count = static_cast<std::size_t>(columns);
  float share = 0.0f;
  for (std::size_t i = pixel * count; i < (pixel + 1) * count; ++i) {
    const float geometry = variance_geometry[i], sum = geometry + variance_path[i];
    if (!std::isfinite(sum)) return 1.0f;
    if (sum > 0.0f) share = std::max(share, geometry / sum);
  }
  return share;
}

void TileResult::drop_variances() {
  if (variance_geometry.empty()) return;
  std::vector<float> shares(samples.size());
  for (std::size_t p = 0; p < shares.size(); ++p) shares[p] = share_of_borders(p);
  border_share = std::move(shares);
  variance_geometry = {};
  variance_path = {};
}

}  // namespace ifov::sampling
