// Light of the ground around a scene in sky and path: ground that reflects alike, told as one that reflects by direction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "geometry/world/world_builder.h"
#include "materials/bsdf/lambertian.h"
#include "materials/bsdf/rpv.h"
#include "radiometry/polarization_frame.h"
#include "radiometry/solar_spectrum.h"
#include "scene/scene.h"
#include "transport/sky/ground_around.h"
#include "transport/sky/material_ground.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"
#include "transport/view_table.h"

namespace ifov::transport::test_ground_around {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using radiometry::StokesVector;

constexpr double kDegree = std::numbers::pi / 180.0, kSensor_km = 4.0;

/// By node: what a level surface takes of the sky, what the vertical path adds, and Stokes vectors of sky and path in directions.
struct Light {
  std::vector<double> sky, path;
  std::vector<StokesVector> seen;
};

Light light_over(double reflectance, double temperature_k, bool by_direction) {
  static const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
  static const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("blue", 0.45),
                                                         radiometry::Channel::monochromatic("thermal", 10.0)};
  scene::Scene scene;
  materials::Material material;
  material.reflectance = Spectrum::constant(reflectance);
  // Lambert's parameters.
  if (by_direction)
    material.bsdf = std::make_shared<const materials::Rpv>(Spectrum::constant(reflectance), 1.0, 0.0,
                                                           Spectrum::constant(1.0));
  else
    material.bsdf = materials::Lambertian::shared();
  scene.materials.push_back(material);
  scene.states.push_back({0, temperature_k});
  scene.surroundings = scene.states.front();
  scene::Sun sun;
  sun.direction = {std::sin(50.0 * kDegree), 0.0, std::cos(50.0 * kDegree)};
  sun.irradiance = radiometry::solar_irradiance_1au();
  scene.sun = sun;
  scene.world = geometry::WorldBuilder().build();

  atmosphere::SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = sun.irradiance;
  inputs.geometry.sun_zenith_rad = 50.0 * kDegree;
  inputs.geometry.sensor_altitude_km = kSensor_km;
  inputs.scattering.nodes_per_hemisphere = 6;
  inputs.lines_of_sight = atmosphere::LineOfSightGrid({-0.6, 0.5, 0.0, 0.55, 0.4}, column.levels(),
                                                      atmosphere::SensorAltitudes{kSensor_km, kSensor_km});
  inputs.polarized = true;
  if (by_direction) inputs.directional = material_ground(material, scene.sun->azimuth_rad());
  const atmosphere::SensorAtmosphere air(column, inputs);
  const SpectralScene spectral(scene, air, true);
  Light light;
  for (std::size_t n = 0; n < air.node_count(); ++n) {
    light.sky.push_back(static_cast<double>(spectral.sky_radiance()[n]));
    light.path.push_back(static_cast<double>(spectral.view_radiance()[n]));
  }
  std::vector<StokesVector> nodes(air.node_count());
  for (const Vec3 towards : {Vec3{0.1, 0.0, 1.0}, {-0.5, 0.4, 1.0}, {0.4, 0.5, 1.0}}) {
    const Vec3 direction = math::normalized(towards);
    spectral.sky_dome()->stokes(direction, nodes);
    light.seen.insert(light.seen.end(), nodes.begin(), nodes.end());
    spectral.polarized_path()->stokes(direction, 0.0, 1e3 * kSensor_km, nodes);
    light.seen.insert(light.seen.end(), nodes.begin(), nodes.end());
  }
  return light;
}

/// Of what the ground adds to black ground, the largest difference in its parts.
struct Differences {
  double radiance = 0.0, polarization = 0.0;
};
Differences between(const Light& found, const Light& wanted, const Light& black) {
  Differences worst;
  const auto compare = [](double a, double b, double none, double& into) {
    into = std::max(into, std::abs((a - b) / (b - none)));
  };
  for (std::size_t n = 0; n < black.sky.size(); ++n) {
    compare(found.sky[n], wanted.sky[n], black.sky[n], worst.radiance);
    compare(found.path[n], wanted.path[n], black.path[n], worst.radiance);
  }
  for (std::size_t k = 0; k < black.seen.size(); ++k) {
    compare(found.seen[k].i, wanted.seen[k].i, black.seen[k].i, worst.radiance);
    const double of_ground = wanted.seen[k].i - black.seen[k].i;
    worst.polarization =
        std::max({worst.polarization, std::abs(found.seen[k].q - wanted.seen[k].q) / of_ground,
                  std::abs(found.seen[k].u - wanted.seen[k].u) / of_ground});
  }
  return worst;
}

}  // namespace

TEST(GroundAround, AlikeInEveryDirectionIsAsLambertian) {
  const Light black = light_over(0.0, 0.0, false), wanted = light_over(0.6, 320.0, false);
  const Differences found = between(light_over(0.6, 320.0, true), wanted, black);
  EXPECT_LT(found.radiance, 2e-3);
  EXPECT_LT(found.polarization, 2e-4);
  // Planted: a hundredth more of what is reflected, and 0.7 K.
  EXPECT_GT(between(light_over(0.606, 320.0, true), wanted, black).radiance, 6e-3);
  EXPECT_GT(between(light_over(0.6, 320.7, true), wanted, black).radiance, 6e-3);
}

}  // namespace ifov::transport::test_ground_around
