#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/unseen/shining_targets.h"
#include "sampling/field.h"
#include "transport/separate_images.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;
class MirrorImages;

/// Images of what shines by ways that MirrorImages does not seek: by several mirrors in turn, by reliefs, height fields
/// and the mirrors of a world that repeats, and where there are too many. Rays on a lattice of each pixel are followed from
/// mirror to mirror. Where the directions of three that came the same way may hold a thing between them, it is taken to
/// be there with the share of them that it fills. And light of such things that round mirrors throw on other surfaces, as
/// far as it can be bounded. That marks pixels; it never enters a radiance.
class UnseenImages {
 public:
  /// Null where there are no such ways. Keeps references.
  static std::unique_ptr<const UnseenImages> find(const transport::SpectralScene& scene,
                                                  const sensor::Camera& camera, const MirrorImages& images,
                                                  std::uint64_t seed);

  /// An image that fills so much of a pixel is met by paths.
  static constexpr double kMet_px2 = 1.0 / 16.0;
  /// As UnseenLight's: times what may be there, in the pixel or in the mean of its neighbourhood in the tile; less than a
  /// share of what was asked for is left alone.
  static constexpr double kCaution = 2.0, kNegligible = 0.1;

  /// Widens the half-widths of a finished tile that has channels alone; pixels that become wider than was asked for get
  /// Reason::unseen_light. Adds the rays. Nothing without a tolerance.
  void settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const;

 private:
  UnseenImages(const transport::SpectralScene& scene, const sensor::Camera& camera,
               const MirrorImages& images, std::uint64_t seed);
  /// A ray after so many mirrors.
  struct Leaving {
    bool any = false;
    math::Point3 at;
    double time_s = 0.0;
    math::Vec3 direction, outward;
    std::uint64_t way = 0;  ///< equal for rays that met the same mirrors in turn
    transport::SeparateImages::Mirror only =
        transport::SeparateImages::kNone;           ///< the mirror, if it is one alone
    double brightness = 0.0;                        ///< what is left of light, at most
    const Leaving* beside[2] = {nullptr, nullptr};  ///< that came the same way, across and along the lattice
  };
  static constexpr std::size_t kMostMirrors = 6;
  static constexpr int kAcross = 3;  ///< rays along a side of a pixel
  /// A surface that scatters, met first.
  struct Lit {
    math::Point3 at;
    double time_s = 0.0;
    math::Vec3 outward;
    std::size_t ray = 0;
    double brightness = 0.0;  ///< what it makes of light, at most
  };
  /// A round mirror, and by surface assignment whether all light of it that the mirror throws is sought by paths.
  struct Thrower {
    const geometry::SurfaceSurvey::Round* round;
    std::vector<bool> all_sought;
  };
  void list_throwers();
  /// Rays of the lattice of a tile, by mirrors met: [mirrors - 1][ray].
  std::vector<std::vector<Leaving>> follow(const std::vector<sampling::FocalPoint>& points,
                                           std::vector<Lit>& lit, sampling::RayCounts& counts) const;
  /// Adds what round mirrors may throw on a surface, by channel, times a weight.
  void add_thrown(const Lit& lit, double weight, ShiningTargets& moving, double* unseen,
                  sampling::RayCounts& counts) const;
  static void find_neighbours(std::vector<Leaving>& level, int columns);
  /// Adds what may be seen within a triangle of an area of the focal plane, by channel.
  void search(const Leaving* const (&corner)[3], double area_px2, ShiningTargets& moving, double* unseen,
              sampling::RayCounts& counts) const;
  void search(const Leaving* const (&corner)[3], double area_px2, std::span<const ShiningTarget> targets,
              double* unseen, sampling::RayCounts& counts) const;
  /// Whether nothing stands between a point and a ball.
  bool is_free(math::Point3 from, double time_s, math::Point3 centre_m, double radius_m,
               sampling::RayCounts& counts) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  const MirrorImages& images_;
  std::size_t channels_;
  bool complete_;                       ///< all that shines is known
  std::vector<ShiningTarget> targets_;  // of what stands still
  MovingParts moving_;
  std::vector<Thrower> throwers_;
  double shift_x_, shift_y_;  // of the lattice, px
};

}  // namespace ifov::render
