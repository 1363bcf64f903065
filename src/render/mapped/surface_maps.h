#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/mapped_surface.h"

namespace ifov::geometry {
struct SurfacePoint;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class PartColumns;

/// What maps and patterns say of the surfaces that a camera sees (sampling::MappedSurface). An object serves one thread.
class SurfaceMaps {
 public:
  /// Writes shares of materials into the columns of a value; empty: there are none.
  using Shares = std::function<void(const geometry::SurfacePoint& at, float* columns)>;

  /// Keeps references to scene, camera and the columns of parts; they must outlive this, and this what it makes.
  SurfaceMaps(const transport::SpectralScene& scene, const sensor::Camera& camera, const PartColumns& parts,
              Shares shares);
  ~SurfaceMaps();

  /// Whether any surface assignment differs from place to place.
  bool any() const { return any_; }
  bool differs(std::size_t assignment) const { return differs_[assignment] != 0; }

  /// Of the surface of the first of three hits. The others were met a little to the right of it and below it on the focal plane,
  /// or are of something else: they tell how texture coordinates go on. `stride`: of rows of values.
  std::unique_ptr<sampling::MappedSurface> about(std::span<const geometry::SurfacePoint> hits,
                                                 std::size_t stride) const;

 private:
  class Surface;
  struct Work;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  const PartColumns& parts_;
  Shares shares_;
  std::vector<char> differs_;  // by surface assignment
  bool any_ = false;
  std::unique_ptr<Work> work_;
};

}  // namespace ifov::render
