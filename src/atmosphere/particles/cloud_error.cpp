#include "atmosphere/particles/cloud_error.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/particles/particles.h"

namespace ifov::atmosphere {
namespace {

/// Of a cloud alone.
struct Cloud {
  double depth, albedo, asymmetry;
  TwoStreams light() const { return two_streams(depth, albedo, asymmetry); }
  Cloud with(double extinction, double backward, double absorbed) const {
    return {depth * (1.0 + extinction), std::clamp(1.0 - (1.0 - albedo) * (1.0 + absorbed), 0.0, 1.0),
            std::clamp(1.0 - (1.0 - asymmetry) * (1.0 + backward), -1.0, 1.0)};
  }
};

/// Larger changes of both ways, each cause for itself, added: of unknown sign.
TwoStreams changes(const Cloud& cloud, const ParticleError& error) {
  const TwoStreams light = cloud.light();
  TwoStreams sum{0.0, 0.0};
  const auto add = [&](double extinction, double backward, double absorbed) {
    TwoStreams most{0.0, 0.0};
    for (const double sign : {-1.0, 1.0}) {
      const TwoStreams other = cloud.with(sign * extinction, sign * backward, sign * absorbed).light();
      most.reflected = std::max(most.reflected, std::abs(other.reflected - light.reflected));
      most.transmitted = std::max(most.transmitted, std::abs(other.transmitted - light.transmitted));
    }
    sum.reflected += most.reflected;
    sum.transmitted += most.transmitted;
  };
  add(error.extinction, 0.0, 0.0);
  add(0.0, error.backward, 0.0);
  add(0.0, 0.0, error.absorbed);
  return sum;
}

}  // namespace

TwoStreams two_streams(double depth, double albedo, double asymmetry) {
  const double peak = asymmetry * asymmetry;
  const double t = (1.0 - albedo * peak) * depth, w = albedo * (1.0 - peak) / (1.0 - albedo * peak),
               g = asymmetry / (1.0 + asymmetry);
  const double first = 2.0 - w * (1.0 + g), second = w * (1.0 - g);
  const double k = std::sqrt(std::max(0.0, first * first - second * second));
  if (k * t < 1e-4) return {second * t / (1.0 + first * t), 1.0 / (1.0 + first * t)};
  const double back = second / (first + k), once = std::exp(-k * t),
               denominator = 1.0 - back * back * once * once;
  return {back * (1.0 - once * once) / denominator, (1.0 - back * back) * once / denominator};
}

CloudError cloud_error(const AerosolColumn& aerosol, double wavelength_um, double other) {
  constexpr double kDiffuse = 1.66;  // mean length of diffuse light's way through a layer (Elsasser)
  CloudError error;
  for (std::size_t r = aerosol.first_cloud(); r < aerosol.regions(); ++r) {
    const AerosolProperties properties = aerosol.properties(r, wavelength_um);
    const Cloud cloud{aerosol.thickness_550(r, 0.0, kTopOfAtmosphereKm) * properties.extinction,
                      std::clamp(1.0 - properties.absorption / properties.extinction, 0.0, 1.0),
                      properties.asymmetry};
    if (!(cloud.depth > 0.0)) continue;
    const ParticleError of = aerosol.particles(r).cloud_error(wavelength_um);
    // Slanting light from above knows absorption better than two diffuse streams do.
    constexpr double kSlant = 1.3;
    const TwoStreams light = cloud.light();
    TwoStreams change = changes(cloud, of);
    change.reflected *= kSlant;
    // Thin clouds scatter once, and send back half of that times 1 - g.
    const double once = 0.5 * cloud.albedo * (1.0 - cloud.asymmetry) * -std::expm1(-2.0 * cloud.depth);
    const double all = light.reflected + other;
    error.extinction += of.extinction * cloud.depth;
    error.absorbed = std::max(error.absorbed, of.absorbed + of.extinction);
    error.reflected += change.reflected;
    if (all > 0.0)
      error.above += (change.reflected + of.by_direction * std::min(once, light.reflected)) / all;
    error.all_below += change.transmitted / std::max(1e-6, light.transmitted);
    const double diffuse =
        std::max(0.0, light.transmitted - std::exp(-kDiffuse * cloud.depth)) + other * light.transmitted;
    error.below +=
        (change.transmitted + of.by_direction * std::min(once, light.reflected)) / std::max(1e-6, diffuse);
  }
  constexpr double kMost = 1.0;
  error.above = std::min(kMost, error.above);
  error.below = std::min(kMost, error.below);
  error.all_below = std::min(kMost, error.all_below);
  error.reflected = std::min(kMost, error.reflected);
  return error;
}

double haze_error(const AerosolColumn& aerosol, double wavelength_um) {
  double sum = 0.0, scattering = 0.0;
  for (std::size_t r = 0; r < aerosol.first_cloud(); ++r) {
    const AerosolProperties here = aerosol.properties(r, wavelength_um);
    const double scattered =
        aerosol.thickness_550(r, 0.0, kTopOfAtmosphereKm) * (here.extinction - here.absorption);
    scattering += scattered;
    if (scattered > 0.0) sum += scattered * aerosol.particles(r).scattering_error(wavelength_um);
  }
  return scattering > 0.0 ? sum / scattering : 0.0;
}

}  // namespace ifov::atmosphere
