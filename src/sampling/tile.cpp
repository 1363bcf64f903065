#include "sampling/tile.h"

#include <cmath>
#include <vector>

#include "core/format.h"
#include "sampling/footprint_groups.h"
#include "sampling/intervals/bounded_error.h"
#include "sampling/tile_arrays.h"

namespace ifov::sampling {

ColumnFootprints TileProblem::footprints(const Field& field) const {
  std::vector<int> channels;
  for (int c = 0; groups != nullptr && c < field.columns(); ++c) channels.push_back(field.channel_of(c));
  return {*footprint, groups, channels};
}

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
  bound.clear();
  samples.assign(pixels, 0);
  label_rays.assign(pixels, 0);
  radiance_evaluations.assign(pixels, 0);
  reasons.assign(pixels, bit(Reason::unjudged));
  worst_ratio.assign(pixels, 0.0f);
  missable_fraction.assign(pixels, 1.0f);
  abundances.clear();
  column_errors.clear();
  border_share.clear();
  layers.clear();
  halo_samples = pilot_samples = probe_samples = 0;
  rays = {};
  memory.clear();
}

void TileResult::add_bound(std::size_t at, double more) {
  if (!(more > 0.0)) return;
  if (bound.empty()) bound.assign(half_width.size(), 0.0f);
  bound[at] += static_cast<float>(more);
}

double TileResult::joined(std::size_t at, const BoundedError& joint) const {
  const double random = static_cast<double>(half_width[at]);
  return bound.empty() ? random : joint.half_width(random, static_cast<double>(bound[at]));
}

void TileResult::join_bounds(const BoundedError& joint) {
  for (std::size_t at = 0; at < bound.size(); ++at) half_width[at] = static_cast<float>(joined(at, joint));
  bound.clear();
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

const TileLayer* TileResult::layer(std::string_view name) const {
  const auto found =
      std::find_if(layers.begin(), layers.end(), [&](const TileLayer& layer) { return layer.name == name; });
  return found == layers.end() ? nullptr : &*found;
}

std::string TileResult::fault() const {
  const auto pixels = static_cast<std::size_t>(std::max(tile.count(), 0)),
             cells = pixels * static_cast<std::size_t>(std::max(columns, 0));
  std::string text;
  const auto demand = [&](std::string_view name, std::size_t is, std::size_t wanted) {
    if (text.empty() && is != wanted) text = format("{} has {} elements, not {}", name, is, wanted);
  };
  visit_arrays(*this, [&](const TileArray& array, const auto& values) {
    using Extent = TileArray::Extent;
    if (array.extent == Extent::any) return;
    const bool of_cells = array.extent == Extent::cells || array.extent == Extent::cells_or_none,
               may_lack = array.extent == Extent::cells_or_none || array.extent == Extent::pixels_or_none;
    if (!may_lack || !values.empty()) demand(array.name, values.size(), of_cells ? cells : pixels);
  });
  for (const TileLayer& layer : layers)
    demand(layer.name, layer.bytes.size(), pixels * layer.bands * layer.value_bytes);
  return text;
}

std::uint64_t TileResult::bytes() const {
  std::uint64_t sum = 0;
  visit_arrays(*this,
               [&](const TileArray&, const auto& values) { sum += sizeof(values[0]) * values.size(); });
  for (const TileLayer& layer : layers) sum += layer.bytes.size();
  return sum;
}

}  // namespace ifov::sampling
