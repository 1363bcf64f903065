#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "atmosphere/sensor/sky_over_ground.h"
#include "math/vec3.h"
#include "radiometry/spectrum_block.h"

namespace ifov::atmosphere {
class GroundAtNodes;
class SensorAtmosphere;
}  // namespace ifov::atmosphere
namespace ifov::materials {
struct Material;
}
namespace ifov::radiometry {
struct PolarizationFrame;
class SpectralNodes;
}  // namespace ifov::radiometry

namespace ifov::transport {

/// The light that rays meet which leave the scene below the horizon, where the ground there reflects by direction: what it makes of
/// the Sun, worked out for each ray, of the sky, linear between directions of a table that is made as rays ask for it, and what it
/// emits. Serves threads.
class SurroundingsLight {
 public:
  struct Lit {
    const radiometry::SpectralNodes& nodes;
    math::Vec3 towards_sun;                   ///< azimuths count from it
    bool polarized;                           ///< Q and U are asked for
    const atmosphere::SensorAtmosphere* air;  ///< null, or without directional ground: a uniform sky
    std::vector<float> sun, sky;              ///< irradiance that faces the Sun; radiance of a uniform sky
    std::vector<float> black;                 ///< Planck's radiance of the ground; empty: it emits nothing
    std::vector<double> even;                 ///< what of that it sends into the air in the mean
  };
  /// Null where the material is Lambertian, or no ground. Keeps references to the air and the nodes.
  static std::unique_ptr<const SurroundingsLight> of(const materials::Material& material, Lit lit);
  ~SurroundingsLight();

  enum class Part { emitted, sun, sky };
  /// Adds a part of what comes from a direction (unit, below the horizon) to rows of I, Q and U about a frame of that light;
  /// without a frame to I alone. What is emitted is unpolarized.
  void add(Part part, math::Vec3 direction, const radiometry::PolarizationFrame* frame,
           const std::array<float*, 3>& to) const;
  void add_all(math::Vec3 direction, const radiometry::PolarizationFrame* frame,
               const std::array<float*, 3>& to) const;

 private:
  SurroundingsLight(std::shared_ptr<const atmosphere::GroundAtNodes> ground, bool both_sides, Lit lit);
  struct Towards;
  Towards towards(math::Vec3 direction) const;
  void add_emitted(double mu, float* to) const;
  void add_sun(const Towards& way, const radiometry::PolarizationFrame* frame,
               const std::array<float*, 3>& to) const;
  void add_sky(const Towards& way, const radiometry::PolarizationFrame* frame,
               const std::array<float*, 3>& to) const;
  const float* row(std::size_t zenith, std::size_t azimuth) const;

  Lit lit_;
  std::shared_ptr<const atmosphere::GroundAtNodes> ground_;
  std::size_t components_ = 1;
  std::optional<atmosphere::SkyOverGround> sky_;  ///< none: the sky is uniform
  bool both_sides_;                               ///< of the Sun's plane differ
  std::vector<double> zenith_rad_, azimuth_rad_;  ///< of light that leaves; from the Sun's, counterclockwise
  mutable radiometry::SpectrumBlock rows_;        ///< [zenith][azimuth][component]
  std::unique_ptr<std::once_flag[]> made_;
};

}  // namespace ifov::transport
