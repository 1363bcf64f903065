#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "render/mapped/map_standouts.h"
#include "sampling/field.h"

namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Where the classes of maps, the holes of surfaces and what stands out in other maps lie on the focal plane. A map knows its content:
/// what is smaller than the rays of a pixel are apart need not be met by chance. An object serves one thread.
class MapDetail {
 public:
  /// Keeps references to both, which must outlive this.
  MapDetail(const scene::Scene& scene, const sensor::Camera& camera);

  /// See sampling::Field::known_detail. Adds the rays that find out where pixels look to `rays`.
  void find(const sampling::FieldRect& pixels, sampling::KnownDetail& detail, std::uint64_t& rays);

 private:
  void find_in_pixel(std::span<const geometry::SurfacePoint> corners, std::size_t pixel,
                     sampling::FocalPoint origin, sampling::KnownDetail& detail);

  const scene::Scene& scene_;
  const sensor::Camera& camera_;
  const MapStandouts standouts_;
  bool any_ = false;                         // some surface assignment has a map of classes, or holes
  std::vector<std::uint16_t> classes_;       // of the cells in a pixel's window; kOutside beside the pixel
  std::vector<std::uint32_t> queue_, part_;  // cells of one part
};

}  // namespace ifov::render
