#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "materials/draped_map.h"
#include "materials/mixture_map.h"
#include "materials/relief_map.h"
#include "materials/texture_map.h"
#include "scene/scene.h"

namespace ifov::scene {

/// Puts the parts of a mixture map side by side, in place of what was there.
class MixturePattern final : public Pattern {
 public:
  struct Part {
    std::uint32_t state = 0, material = 0;
    std::shared_ptr<const materials::TemperatureMap> temperature;  ///< may be null
  };
  /// `parts` by the map's part index.
  MixturePattern(std::shared_ptr<const materials::MixtureMap> map, std::vector<Part> parts);
  void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const override;
  bool mixes_materials() const override;
  std::vector<std::uint32_t> mixed_materials() const override;
  std::optional<TemperatureRange> temperatures() const override;
  void add_maps(std::vector<const materials::NumberedMap*>& maps) const override;

 private:
  std::shared_ptr<const materials::MixtureMap> map_;
  std::vector<Part> parts_;
};

/// Replaces a state by those of the curves that a texture picks. Where there is no room for two curves, the one with
/// the larger share stands.
class TexturePattern final : public Pattern {
 public:
  struct Curve {
    std::uint32_t state = 0, material = 0;
  };
  /// `state` is replaced; `curves` by the texture's curve number.
  TexturePattern(std::shared_ptr<const materials::TextureMap> texture, std::uint32_t state,
                 std::vector<Curve> curves);
  void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const override;
  void add_maps(std::vector<const materials::NumberedMap*>& maps) const override;

 private:
  std::shared_ptr<const materials::TextureMap> texture_;
  std::uint32_t state_;
  std::vector<Curve> curves_;
};

/// Tilts the shading normal where most of the surface is of one material.
class ReliefPattern final : public Pattern {
 public:
  ReliefPattern(std::shared_ptr<const materials::ReliefMap> map, std::uint32_t material);
  void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const override;
  bool bends_normals() const override { return true; }

 private:
  std::shared_ptr<const materials::ReliefMap> map_;
  std::uint32_t material_;
};

}  // namespace ifov::scene
