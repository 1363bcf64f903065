#include "atmosphere/particles/cloud_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atmosphere/particles/phase_function_table.h"
#include "radiometry/refractive_index.h"

namespace ifov::atmosphere {
namespace {

MieParticles spheres_of(const char* substance, double effective_radius_um, double effective_variance) {
  const radiometry::RefractiveIndex& index = *radiometry::whole_refractive_index(substance);
  return {gamma_by_effective_radius(effective_radius_um, effective_variance), index.n, index.k};
}

constexpr double kVisible_um = 0.65, kRoughAsymmetry = 0.75, kSurfaceReflects = 0.06;

// Steps of `diffracted` in ln z, from where it is 1 to where rings are no more.
constexpr double kFirstZ = 0.05, kLastZ = 300.0;
constexpr std::size_t kSteps = 400;

/// A disc's light over that straight ahead (Airy).
double airy(double z) {
  if (z < 1e-3) return 1.0;
  const double amplitude = 2.0 * std::cyl_bessel_j(1.0, z) / z;
  return amplitude * amplitude;
}

class Droplets : public MieParticles {
 public:
  using MieParticles::MieParticles;
  ParticleError cloud_error(double wavelength_um) const override { return droplet_error(wavelength_um); }
};

/// From 0 at 0.8 um, up to where extinction hardly changes and absorption is next to none, to 1 from 2 um on.
double away_from_visible(double um) {
  constexpr double kNear = 0.8, kFar = 2.0;
  return std::clamp((um - kNear) / (kFar - kNear), 0.0, 1.0);
}
/// Up to here particles absorb a thousandth, and the mean over a wide band hangs on its edge.
constexpr double kClear_um = 1.25;

double scattered(const AerosolProperties& properties) {
  return std::clamp(1.0 - properties.absorption / properties.extinction, 0.0, 1.0);
}

}  // namespace

std::shared_ptr<const MieParticles> droplets(double effective_radius_um, double effective_variance) {
  const radiometry::RefractiveIndex& water = *radiometry::whole_refractive_index("water");
  return std::make_shared<const Droplets>(gamma_by_effective_radius(effective_radius_um, effective_variance),
                                          water.n, water.k);
}

ParticleError droplet_error(double wavelength_um) {
  return {0.05 * away_from_visible(wavelength_um), 0.06, wavelength_um < kClear_um ? 0.50 : 0.30, 0.10};
}

ParticleError crystal_error(double wavelength_um) {
  const double away = away_from_visible(wavelength_um);
  return {0.10 * away, 0.30 + 0.12 * away, wavelength_um < kClear_um ? 0.40 : 0.25, 0.30};
}

IceCrystals::IceCrystals(double effective_radius_um, double effective_variance)
    : spheres_(spheres_of("ice", effective_radius_um, effective_variance)) {
  excess_ = spheres_.properties(kVisible_um).asymmetry - kRoughAsymmetry;
  const SizeDistribution& sizes = spheres_.sizes();
  const double effective_um = sizes.effective_radius_um();
  double area = 0.0, length = 0.0;
  for (std::size_t i = 0; i < sizes.radius_um.size(); ++i) {
    area += sizes.number[i] * sizes.radius_um[i] * sizes.radius_um[i];
    length += sizes.number[i] * sizes.radius_um[i];
  }
  mean_inverse_ = effective_um * length / area;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double z = kFirstZ * std::pow(kLastZ / kFirstZ, static_cast<double>(k) / kSteps);
    double sum = 0.0, ahead = 0.0;
    for (std::size_t i = 0; i < sizes.radius_um.size(); ++i) {
      const double weight = sizes.number[i] * std::pow(sizes.radius_um[i], 4);
      ahead += weight;
      sum += weight * airy(z * sizes.radius_um[i] / effective_um);
    }
    logarithm_.push_back(std::log(sum / ahead));
  }
}

double IceCrystals::size_parameter(double wavelength_um) const {
  return 2.0 * std::numbers::pi * spheres_.sizes().effective_radius_um() / wavelength_um;
}

double IceCrystals::diffracted(double z) const {
  if (z <= kFirstZ) return 1.0;
  // Of rings that run into each other, z^-3 is left.
  if (z >= kLastZ) return std::exp(logarithm_.back()) * std::pow(kLastZ / z, 3);
  const double at = std::log(z / kFirstZ) / std::log(kLastZ / kFirstZ) * kSteps;
  const std::size_t k = std::min(static_cast<std::size_t>(at), kSteps - 1);
  return std::exp(std::lerp(logarithm_[k], logarithm_[k + 1], at - static_cast<double>(k)));
}

IceCrystals::Parts IceCrystals::parts(const AerosolProperties& of_spheres, double wavelength_um) const {
  constexpr double kMost = 0.98;
  const double albedo = scattered(of_spheres);
  const double passed =
      std::clamp((2.0 * albedo - 1.0 - kSurfaceReflects) / (1.0 - kSurfaceReflects), 0.0, 1.0);
  const double asymmetry = of_spheres.asymmetry - excess_ * passed;
  Parts parts;
  parts.diffracted = albedo > 0.0 ? std::min(0.5 / albedo, 1.0) : 1.0;
  // 1 - mean cosine of a disc's light is 1 / (2 x): of its tail 4 / (pi z^3), about which its rings are, by the integral over
  // (1 - cos) ((1 + cos) / 2)^2.
  parts.of_diffracted = std::max(0.0, 1.0 - 0.5 * mean_inverse_ / size_parameter(wavelength_um));
  const double rest = 1.0 - parts.diffracted;
  parts.of_rest = rest > 1e-3
                      ? std::clamp((asymmetry - parts.diffracted * parts.of_diffracted) / rest, -kMost, kMost)
                      : 0.0;
  return parts;
}

AerosolProperties IceCrystals::properties(double wavelength_um) const {
  AerosolProperties properties = spheres_.properties(wavelength_um);
  properties.asymmetry = parts(properties, wavelength_um).asymmetry();
  return properties;
}

PhaseFunction IceCrystals::phase_function(double wavelength_um) const {
  const Parts parts = this->parts(spheres_.properties(wavelength_um), wavelength_um);
  const std::shared_ptr<const PhaseAngles> angles = mie_angles();
  const double x = size_parameter(wavelength_um);
  constexpr double kLeast = -60.0;
  std::vector<double> logarithms;
  for (const double angle : angles->angle_rad) {
    const double forward = 0.5 * (1.0 + std::cos(angle));
    logarithms.push_back(
        std::max(kLeast, std::log(std::max(1e-300, diffracted(x * std::sin(angle)) * forward * forward))));
  }
  const PhaseFunction of_discs(angles, logarithms);
  const double g = parts.of_rest;
  for (std::size_t k = 0; k < logarithms.size(); ++k) {
    const double rest = (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * std::cos(angles->angle_rad[k]), 1.5);
    logarithms[k] = std::log(parts.diffracted * std::exp(of_discs.logarithms()[k]) +
                             (1.0 - parts.diffracted) * rest + 1e-30);
  }
  return {angles, std::move(logarithms),
          std::make_shared<const PolarizationRatios>(PolarizationRatios::none(angles->angle_rad))};
}

double mass_extinction_m2_g(const MieParticles& spheres, double density_g_m3) {
  constexpr double kPerMetre = 1e6;
  return kPerMetre * spheres.extinction_per_volume(Particles::kReference_um) / density_g_m3;
}

}  // namespace ifov::atmosphere
