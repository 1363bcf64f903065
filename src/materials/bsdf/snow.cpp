#include "materials/bsdf/snow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "materials/indices/ice.h"

namespace ifov::materials {

using std::numbers::pi;

namespace {

/// Absorption length over grain diameter, (16/9) x 9.2: 9.2 is the absorption enhancement by the grains' shape over one
/// less the asymmetry of scattering (the snow products of Sentinel-3 by the same author).
constexpr double kLengthByGrain = 16.36;

double of_direction(double cosine) { return 3.0 / 7.0 * (1.0 + 2.0 * cosine); }

double fitted(double cos_in, double cos_out, double cos_phase) {
  const double scattering_deg = std::acos(-cos_phase) * 180.0 / pi;
  const double phase = 11.1 * std::exp(-0.087 * scattering_deg) + 1.1 * std::exp(-0.014 * scattering_deg);
  return (1.247 + 1.186 * (cos_in + cos_out) + 5.157 * cos_in * cos_out + phase) / (4.0 * (cos_in + cos_out));
}

/// s of white_r0(), by the root of the cosine.
class Whitening {
 public:
  Whitening() {
    std::array<double, kAngles> roots, weight;
    for (std::size_t a = 0; a < kAngles; ++a) {
      roots[a] = (static_cast<double>(a) + 0.5) / kAngles;
      weight[a] = 4.0 * roots[a] * roots[a] * roots[a] / kAngles;  // 2 cos d cos, of cos = root^2
    }
    std::vector<double> kernel(kAngles * kAngles);
    for (std::size_t a = 0; a < kAngles; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        kernel[a * kAngles + b] = kernel[b * kAngles + a] = mean_over_azimuth(roots[a], roots[b]);
    // s(a) x sum over b of R0(a, b) s(b) weight(b) = whole(a), by iteration.
    std::array<double, kAngles> factor;
    factor.fill(1.0);
    for (int iteration = 0; iteration < 40; ++iteration) {
      const std::array<double, kAngles> last = factor;
      for (std::size_t a = 0; a < kAngles; ++a) {
        double sum = 0.0;
        for (std::size_t b = 0; b < kAngles; ++b) sum += kernel[a * kAngles + b] * last[b] * weight[b];
        factor[a] = std::sqrt(last[a] * whole(roots[a]) / sum);
      }
    }
    for (std::size_t k = 0; k < kAngles; ++k) {
      const double root = kFirst + (1.0 - kFirst) * static_cast<double>(k) / (kAngles - 1);
      double sum = 0.0;
      for (std::size_t b = 0; b < kAngles; ++b)
        sum += mean_over_azimuth(root, roots[b]) * factor[b] * weight[b];
      factor_[k] = whole(root) / sum;
    }
  }

  /// Of a cosine of at least kLeastCosine.
  double at(double cosine) const {
    const double position =
        std::clamp((std::sqrt(cosine) - kFirst) / (1.0 - kFirst), 0.0, 1.0) * (kAngles - 1);
    const auto below = std::min(static_cast<std::size_t>(position), kAngles - 2);
    return factor_[below] + (position - static_cast<double>(below)) * (factor_[below + 1] - factor_[below]);
  }

 private:
  static constexpr std::size_t kAngles = 64;
  static constexpr int kAzimuths = 64;
  static inline const double kFirst = std::sqrt(ReflectionAngles::kLeastCosine);

  static double cosine_of(double root) { return std::max(ReflectionAngles::kLeastCosine, root * root); }
  /// What is to come back: all, less what directional_hemispherical() is too high by for so sharp a forward peak.
  static double whole(double root) { return 1.0 - 1e-4 / cosine_of(root); }
  static double mean_over_azimuth(double root_in, double root_out) {
    const double in = cosine_of(root_in), out = cosine_of(root_out);
    const double sines = std::sqrt((1.0 - in * in) * (1.0 - out * out));
    double sum = 0.0;
    for (int k = 0; k < kAzimuths; ++k)
      sum += fitted(in, out, std::clamp(in * out + sines * std::cos(pi * (k + 0.5) / kAzimuths), -1.0, 1.0));
    return sum / kAzimuths;
  }

  std::array<double, kAngles> factor_;
};

}  // namespace

const BsdfModel Snow::kModel{
    "snow",
    "deep snow by the size of its grains (Kokhanovsky et al. 2018); the reflectance is a factor, 1 for snow "
    "that is nothing else",
    {{"grain", "effective diameter of the grains", BsdfParameter::Form::length, 0.02, 5.0},
     {"soot", "mass of soot, ng in a gram of snow", BsdfParameter::Form::number, 0.0, 1e5, "0"}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<Snow>(inputs.reflectance, inputs.number("grain"), 1e-9 * inputs.number("soot"));
    },
    true};

Snow::Snow(radiometry::Spectrum reflectance, double grain_m, double soot)
    : spectra_{std::move(reflectance), snow_albedo(grain_m, soot)} {}

double Snow::holds_to_um() const {
  constexpr double kGrain_m = 0.5e-3, kHolds_um = 1.3, kClear_um = 0.5;
  const radiometry::Spectrum known = snow_albedo(kGrain_m, 0.0);
  double least = known.at(kHolds_um);
  for (std::size_t k = 0; k < known.values().size(); ++k)
    if (known.wavelength_um()[k] > kClear_um && known.wavelength_um()[k] < kHolds_um)
      least = std::min(least, known.values()[k]);
  const radiometry::Spectrum& albedo = spectra_[1];
  for (std::size_t k = 1; k < albedo.values().size(); ++k) {
    const double low = albedo.values()[k], high = albedo.values()[k - 1];
    if (albedo.wavelength_um()[k] < kClear_um || low >= least) continue;
    const double from = albedo.wavelength_um()[k - 1], to = albedo.wavelength_um()[k];
    return high <= least ? from : from + (to - from) * (high - least) / (high - low);
  }
  return std::numeric_limits<double>::infinity();
}

double Snow::fitted_r0(const ReflectionAngles& a) { return fitted(a.cos_in, a.cos_out, a.cos_phase); }

double Snow::white_r0(const ReflectionAngles& a) {
  static const Whitening whitening;
  return fitted_r0(a) * whitening.at(a.cos_in) * whitening.at(a.cos_out);
}

void Snow::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                    float* bsdf) const {
  const ReflectionAngles a(event);
  const double r0 = white_r0(a);
  const float level = static_cast<float>(r0 * std::numbers::inv_pi);
  const float exponent = static_cast<float>(of_direction(a.cos_in) * of_direction(a.cos_out) / r0);
  const float* __restrict reflectance = parameters[0];
  const float* __restrict albedo = parameters[1];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] = reflectance[n] * level * std::pow(albedo[n], exponent);
}

radiometry::Spectrum snow_albedo(double grain_m, double soot) {
  constexpr double kSootIndex = 0.47, kSootShape = 0.9, kIceShape = 1.6;
  constexpr double kIceDensity = 917.0, kSootDensity = 1270.0;
  const double k_soot = kSootIndex * kSootShape / kIceShape * soot * kIceDensity / kSootDensity;
  const radiometry::Spectrum& ice = ice_extinction_index();
  std::vector<double> wavelength_um(ice.wavelength_um().begin(), ice.wavelength_um().end()), albedo;
  for (const double um : wavelength_um)
    albedo.push_back(
        std::exp(-std::sqrt(4.0 * pi * kLengthByGrain * grain_m * (ice.at(um) + k_soot) / (um * 1e-6))));
  return {std::move(wavelength_um), std::move(albedo), radiometry::OutsideRange::error, "albedo of snow"};
}

}  // namespace ifov::materials
