#pragma once

#include <span>
#include <vector>

#include "geometry/surface_piece.h"
#include "math/vec3.h"
#include "sampling/tile.h"

namespace ifov::geometry {
class World;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::transport {
class SunMirrors;
}

namespace ifov::render {

struct RenderJob;

/// Where to look for objects that the detection lattice could miss: the image of the pilot point of every compact
/// object that is smaller than a pixel in some direction, by pixel. Objects that are longer than a pixel but thinner
/// get a point for each part of their length; so do the long thin faces of meshes, which may be strips that no object tells of,
/// and the shadows of them all. Where these are thin beside the Sun's disc no ray tells of them, and places in them are told. So do the small pieces of what outshines the scene, those of copies and of single faces too, and the Sun.
class PilotRays {
 public:
  /// `materials`: number of the scene's surface assignments; `towards_sun`: directions to points of its disc, none without
  /// sunlight; `shining`: surface assignments that outshine the scene, empty where none does.
  /// `glare`: directions in which the sensor would see the Sun, itself or its images in flat mirrors.
  PilotRays(const geometry::World& world, std::size_t materials, const sensor::Camera& camera,
            std::span<const math::Vec3> towards_sun, const geometry::WantedMaterials& shining,
            double margin_px, std::span<const math::Vec3> glare = {});

  /// Such directions: of the Sun, and by way of flat mirrors where there are any.
  static std::vector<math::Vec3> sun_and_its_images(math::Vec3 sun, const transport::SunMirrors* mirrors);

  struct Near {
    std::vector<sampling::FocalPoint> points;
    std::vector<std::uint32_t> objects;  ///< of each point; Field::kNoObject where it is long and thin
    std::vector<double>
        radii_px;  ///< of a disc about each that holds what it is for, or the part that is nearest
    std::vector<sampling::ThinShadow> thin_shadows;
  };
  /// What lies so far outside a tile may matter to it.
  static double margin_px(const RenderJob& job);
  /// Points within `margin_px` of a tile, in order of pixel and object.
  Near near(sampling::PixelRect tile, double margin_px) const;
  std::size_t count() const { return points_.size(); }

 private:
  struct Target {
    sampling::FocalPoint point;
    std::uint32_t object;
    double radius_px;
    float thin_share = 0.0f;  ///< not 0: of a thin shadow, and nothing to be met
  };
  std::vector<Target> points_;             // sorted by row, then object
  std::vector<std::size_t> first_of_row_;  // rows from lowest_row_
  int lowest_row_ = 0;
};

}  // namespace ifov::render
