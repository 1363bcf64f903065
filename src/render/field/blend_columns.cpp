#include "render/field/blend_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/surface_point.h"
#include "sampling/intervals/bounded_error.h"
#include "sampling/tile.h"
#include "scene/scene.h"

namespace ifov::render {

BlendColumns::BlendColumns(const scene::Scene& scene, const scene::TruthMaterials& truth, int channels,
                           bool all)
    : scene_(scene), channels_(channels) {
  std::set<std::uint32_t> mixed;
  for (const scene::SurfaceAssignment& assignment : scene.assignments) {
    mixes_.push_back(assignment.mixes_materials());
    if (!mixes_.back()) continue;
    for (const std::uint32_t state : assignment.states)
      mixed.insert(truth.of_material[scene.states[state].material]);
    for (const auto& pattern : assignment.patterns) {
      if (!pattern->mixes_materials()) continue;
      const std::vector<std::uint32_t> brought = pattern->mixed_materials();
      for (const std::uint32_t material : brought) mixed.insert(truth.of_material[material]);
      if (brought.empty()) mixed.insert(truth.of_material.begin(), truth.of_material.end());
    }
  }
  if (all) mixed.insert(truth.of_material.begin(), truth.of_material.end());
  if (mixed.empty()) return;
  materials_.assign(mixed.begin(), mixed.end());
  for (const std::uint32_t material : truth.of_material)
    column_of_material_.push_back(static_cast<std::uint32_t>(
        std::lower_bound(materials_.begin(), materials_.end(), material) - materials_.begin()));
}

void BlendColumns::write_shares(const geometry::SurfacePoint& hit, float* columns, bool all) const {
  float* shares = columns + channels_;
  std::fill(shares, shares + count(), 0.0f);
  if (!all && (!hit.hit() || !mixes(hit.material))) return;
  if (!hit.hit()) {
    shares[column_of_material_[scene_.surroundings.material]] = 1.0f;
    return;
  }
  const scene::ResolvedSurface surface = scene_.resolve_without_temperature(hit);
  if (!mixes(hit.material)) {
    shares[column_of_material_[surface.constituents[0].material]] = 1.0f;
    return;
  }
  for (const scene::Constituent& c : surface)
    shares[column_of_material_[c.material]] += static_cast<float>(c.weight);
}

void BlendColumns::settle(const sampling::BoundedError& joint, sampling::TileResult& tile) const {
  if (tile.columns == channels_) return;
  const auto pixels = static_cast<std::uint32_t>(tile.tile.count());
  const auto columns = static_cast<std::size_t>(tile.columns), channels = static_cast<std::size_t>(channels_);

  std::vector<sampling::Abundance> abundances;
  std::size_t next = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    std::map<std::uint32_t, sampling::Abundance> of_pixel;
    for (; next < tile.abundances.size() && tile.abundances[next].pixel == pixel; ++next)
      if (tile.abundances[next].material != kNoMaterial)
        of_pixel[tile.abundances[next].material] = tile.abundances[next];
    for (std::size_t k = 0; k < materials_.size(); ++k) {
      const std::size_t at = pixel * columns + channels + k;
      const float share = tile.mean[at];
      const auto whole = tile.has_errors() ? static_cast<float>(tile.joined(at, joint)) : 1.0f;
      const float half_width = std::isnan(whole) ? 1.0f : whole;
      if (share <= 0.0f) continue;
      const auto [entry, is_new] =
          of_pixel.try_emplace(materials_[k], sampling::Abundance{pixel, materials_[k], share, half_width});
      if (is_new) continue;
      entry->second.fraction += share;
      entry->second.half_width = std::min(1.0f, std::hypot(entry->second.half_width, half_width));
    }
    for (const auto& entry : of_pixel) abundances.push_back(entry.second);
  }
  tile.abundances = std::move(abundances);

  const auto keep_channels = [&](std::vector<float>& values) {
    if (values.empty()) return;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(pixel * columns), channels,
                  values.begin() + static_cast<std::ptrdiff_t>(pixel * channels));
    values.resize(pixels * channels);
  };
  for (std::vector<float>* values :
       {&tile.mean, &tile.variance_geometry, &tile.variance_path, &tile.half_width, &tile.bound})
    keep_channels(*values);
  tile.columns = channels_;
}

}  // namespace ifov::render
