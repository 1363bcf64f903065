#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "honesty/plain_footprint.h"
#include "honesty/plain_spectra.h"
#include "honesty/plain_surfaces.h"
#include "honesty/random_stream.h"
#include "math/ray.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::benchmarks {

/// What a scene's maker tells of what random paths cannot find. All in scene coordinates.
struct PlainHints {
  struct Ball {
    math::Point3 centre_m;
    double radius_m = 0.0;
  };
  std::vector<Ball> bright;  ///< what is unlike all about it and small: looked at more closely
  std::vector<Ball> lamps;   ///< spheres of the material "lamp", which nothing else is made of
  /// A lamp of the document's `light.sources`; nothing of how the program knows it is used.
  struct Source {
    enum class Form { ball, disk, spot };
    Ball ball;
    double radiance = 0.0;  ///< W m-2 sr-1 um-1 at all wavelengths, in the brightest direction
    Form form = Form::ball;
    math::Vec3 towards{0.0, 0.0, -1.0};
    double half_angle_rad = 0.0, edge_rad = 0.0;  ///< of a spot
    double towards_radiance(math::Vec3 outgoing) const;
  };
  std::vector<Source> sources;
  std::vector<Ball> mirrors;  ///< mirror spheres, seen from outside: their glints are looked for
  /// Balls that hold all mirrors: sunlight by way of them is traced from the Sun.
  std::vector<Ball> around_mirrors;
  double focus = 1.0;  ///< how many times the Sun's own irradiance they may throw somewhere
};

/// Means over replicates, by channel.
struct PlainMean {
  std::vector<double> mean, error;  ///< W m-2 sr-1 um-1; standard error
  std::vector<double> above;  ///< what may come on top: sunlight by way of mirrors that is seen in a mirror
  double paths = 0.0;
};

/// A tracer as plain as can be, to judge the program's by. It shares geometry, material curves and the BSDF of models that
/// are not separable (PlainSurfaces) with it and nothing else: points of the pixel's footprint in strata of their own, its own random numbers, one path each of its own
/// making, columns of a fine quadrature in place of spectral nodes.
///
/// At each surface that scatters: one point of the Sun's disc and one of each lamp (uniform over its area), then one
/// direction about the normal, or one that the surface's model draws, which finds the Sun too (balance heuristic); mirrors, panes
/// and media are followed, and rays to the Sun go through panes. Not in it: light of the Sun that a mirror or a boundary sends
/// round a corner to a surface that scatters (SunPhotons has it). Surfaces must have neither reliefs nor vertex normals, and
/// temperatures only where they are separable; light must be the scene's own Sun, uniform sky, surroundings and view path.
class PlainTracer {
 public:
  /// Keeps references to all but the hints.
  PlainTracer(const scene::Scene& scene, const PlainSpectra& spectra, const sensor::Camera& camera,
              const PlainFootprint& footprint, PlainHints hints);

  static constexpr int kReplicates = 32;
  /// The mean of pixel (x, y) by 32 replicates of side x side jittered points; as many again in small windows about
  /// lamps and glints where there are some in its footprint.
  PlainMean pixel(int x, int y, int side, std::uint64_t key) const;

 private:
  struct Window {
    double x_px = 0.0, y_px = 0.0, half_px = 0.0;
  };
  struct Light {
    std::vector<double> sum, above;
  };
  /// A path on its way.
  struct Way {
    math::Ray ray;
    std::vector<double> throughput;
    const std::vector<double>* medium = nullptr;  ///< what it absorbs, 1/m, by column
    bool only_deltas = true;                      ///< since the camera
    bool delta_before = true;                     ///< the surface before, or the camera itself
    bool bent = false;                            ///< one of the deltas since the camera has turned it
    double pdf =
        0.0;  ///< 1/sr, by which it came to its direction, where that may find the Sun; 0: it may not
  };
  void trace(math::Ray ray, double weight, RandomStream& random, Light& light) const;
  void escape(const Way& way, Light& light) const;
  /// What becomes of a path at a surface that is not separable; false where it ends.
  bool scatter(const geometry::SurfacePoint& hit, std::uint32_t material, RandomStream& random, Way& way,
               Light& light) const;
  void may_lack(const Way& way, std::uint32_t material, Light& light) const;
  void add_sun(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
               std::span<const double> throughput, RandomStream& random, std::span<double> sum) const;
  void add_lamps(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
                 std::span<const double> throughput, RandomStream& random, std::span<double> sum) const;
  void add_sources(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
                   std::span<const double> throughput, RandomStream& random, std::span<double> sum) const;
  /// What a source gives off that a path has met there; 0 of all else.
  double radiance_of_source(const geometry::SurfacePoint& hit, math::Vec3 outgoing) const;
  void add_sun(const geometry::SurfacePoint& hit, const materials::BsdfEvent& view, std::uint32_t material,
               std::span<const double> throughput, RandomStream& random, std::span<double> sum) const;
  bool blocked(math::Point3 from_m, math::Vec3 direction, double length_m) const;
  math::Vec3 sun_direction(RandomStream& random) const;
  double window_density(const std::vector<Window>& windows, double x_px, double y_px) const;

  const scene::Scene& scene_;
  const PlainSpectra& spectra_;
  PlainSurfaces surfaces_;
  const sensor::Camera& camera_;
  const PlainFootprint& footprint_;
  PlainHints hints_;
  std::vector<Window> windows_;
  std::uint32_t lamp_ = geometry::kNoMaterial;
  std::vector<double> lamp_radiance_;
};

/// The nearest surface along a ray.
geometry::SurfacePoint nearest(const scene::Scene& scene, const math::Ray& ray);

/// One of a surface's constituents, by chance as their shares are.
const scene::Constituent& pick_constituent(const scene::ResolvedSurface& surface, RandomStream& random);

/// About a unit vector: density cosine / pi.
math::Vec3 cosine_direction(math::Vec3 axis, RandomStream& random);

/// Uniform in a cone about a unit vector.
math::Vec3 cone_direction(math::Vec3 axis, double half_angle_rad, RandomStream& random);

math::Vec3 mirror_image(math::Vec3 direction, math::Vec3 normal);

}  // namespace ifov::benchmarks
