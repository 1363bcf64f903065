#include "scene/map_patterns.h"

#include <algorithm>
#include <limits>

#include "geometry/surface_point.h"

namespace ifov::scene {

namespace {

materials::MapPosition map_position_of(const geometry::SurfacePoint& point) {
  return {point.position_m.x, point.position_m.y, point.u, point.v};
}

}  // namespace

MixturePattern::MixturePattern(std::shared_ptr<const materials::MixtureMap> map, std::vector<Part> parts)
    : map_(std::move(map)), parts_(std::move(parts)) {}

bool MixturePattern::mixes_materials() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& p) { return p.material != parts_[0].material; });
}

std::vector<std::uint32_t> MixturePattern::mixed_materials() const {
  std::vector<std::uint32_t> materials;
  for (const Part& part : parts_) materials.push_back(part.material);
  return materials;
}

void MixturePattern::apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const {
  static_assert(materials::MixtureMap::kMost <= ResolvedSurface::kMost);
  const materials::MapPosition position = map_position_of(point);
  surface.count = 0;
  for (const materials::MixtureMap::Part& found : map_->at(position)) {
    const Part& part = parts_[found.index];
    surface.constituents[surface.count++] = {part.state, part.material, static_cast<double>(found.share),
                                             part.temperature ? part.temperature->at_k(position) : 0.0};
  }
}

std::optional<TemperatureRange> MixturePattern::temperatures() const {
  TemperatureRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (const Part& part : parts_) {
    if (!part.temperature) continue;
    range.coldest_k = std::min(range.coldest_k, part.temperature->minimum_k());
    range.hottest_k = std::max(range.hottest_k, part.temperature->maximum_k());
  }
  if (range.hottest_k > 0.0) return range;
  return std::nullopt;
}

void MixturePattern::add_maps(std::vector<const materials::NumberedMap*>& maps) const {
  maps.push_back(map_.get());
  for (const Part& part : parts_)
    if (part.temperature) maps.push_back(part.temperature.get());
}

TexturePattern::TexturePattern(std::shared_ptr<const materials::TextureMap> texture, std::uint32_t state,
                               std::vector<Curve> curves)
    : texture_(std::move(texture)), state_(state), curves_(std::move(curves)) {}

void TexturePattern::add_maps(std::vector<const materials::NumberedMap*>& maps) const {
  for (const materials::TextureMap::Image& image : texture_->images()) maps.push_back(&image);
}

void TexturePattern::apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const {
  const std::size_t before = surface.count;
  for (std::size_t k = 0; k < before; ++k) {
    Constituent& found = surface.constituents[k];
    if (found.state != state_) continue;
    const materials::CurveMix mix = texture_->at(map_position_of(point));
    const Constituent whole = found;
    const auto part = [&](std::uint32_t curve, double share) {
      return Constituent{curves_[curve].state, curves_[curve].material, whole.weight * share,
                         whole.mapped_temperature_k};
    };
    // Shares too small for a weight above 0 in single precision are none.
    constexpr double kLeast = 1e-6;
    const bool both = mix.second_share > kLeast && mix.second_share < 1.0 - kLeast &&
                      surface.count < ResolvedSurface::kMost;
    if (!both) {
      found = part(mix.second_share > 0.5 ? mix.second : mix.first, 1.0);
      continue;
    }
    found = part(mix.first, 1.0 - mix.second_share);
    surface.constituents[surface.count++] = part(mix.second, mix.second_share);
  }
}

ReliefPattern::ReliefPattern(std::shared_ptr<const materials::ReliefMap> map, std::uint32_t material)
    : map_(std::move(map)), material_(material) {}

void ReliefPattern::apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const {
  const Constituent* most = surface.begin();
  for (const Constituent& c : surface)
    if (c.weight > most->weight) most = &c;
  if (most->material != material_) return;
  const math::Normal3 tilted = map_->tilted(surface.shading_normal, map_position_of(point));
  if (math::dot(tilted, point.geometric_normal.as_vector()) > 0.0) surface.shading_normal = tilted;
}

}  // namespace ifov::scene
