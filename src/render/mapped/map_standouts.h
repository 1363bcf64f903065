#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "render/mapped/map_window.h"
#include "sampling/field.h"

namespace ifov::materials {
class NumberedMap;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Where the numbers of maps (temperatures, textures, mixtures, parameters, classes, holes) are lowest and highest in a pixel, where
/// its corners do not show it: a single cell may outshine all others, and rays meet it by chance.
class MapStandouts {
 public:
  /// Keeps references to both, which must outlive this.
  MapStandouts(const scene::Scene& scene, const sensor::Camera& camera);

  bool any() const { return any_; }
  /// Adds the points of a pixel whose corners, row by row, show these; `origin`: the first of them. Adds the rays that tell how maps lie
  /// of which no three corners do to `rays`.
  void find_in_pixel(std::span<const geometry::SurfacePoint> corners, sampling::FocalPoint origin,
                     std::vector<sampling::FocalPoint>& points, std::uint64_t& rays) const;

 private:
  std::optional<MapWindow> window_about(const geometry::SurfacePoint& corner, std::size_t k,
                                        sampling::FocalPoint origin, const materials::MapGrid& grid) const;

  const scene::Scene& scene_;
  const sensor::Camera& camera_;
  std::vector<std::vector<const materials::NumberedMap*>> maps_;  // by surface assignment
  bool any_ = false;
};

}  // namespace ifov::render
