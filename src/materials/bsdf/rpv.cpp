#include "materials/bsdf/rpv.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

const BsdfModel Rpv::kModel{
    "rpv",
    "vegetation and soil from afar (Rahman, Pinty and Verstraete 1993); the reflectance is the level rho0",
    {{"k", "below 1 a bowl, brighter to the sides; above 1 a bell", BsdfParameter::Form::number, 0.0, 2.0},
     {"asymmetry", "Theta: below 0 more light goes back to where it came from, above 0 onwards",
      BsdfParameter::Form::number, -0.9, 0.9},
     {"rho_c",
      "the lower, the brighter the hot spot; without it, the reflectance",
      BsdfParameter::Form::spectrum,
      0.0,
      1.0,
      {},
      true}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<Rpv>(
          inputs.reflectance, inputs.number("k"), inputs.number("asymmetry"),
          inputs.has("rho_c") ? std::optional(inputs.spectrum("rho_c")) : std::nullopt);
    }};

Rpv::Rpv(radiometry::Spectrum rho0, double k, double asymmetry, std::optional<radiometry::Spectrum> hot_spot)
    : spectra_{std::move(rho0)}, k_(k), asymmetry_(asymmetry) {
  if (hot_spot) spectra_.push_back(*std::move(hot_spot));
}

void Rpv::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                   float* bsdf) const {
  const ReflectionAngles a(event);
  const double g = asymmetry_;
  // Light that goes straight back has been turned by 180 deg: the phase angle is 0, and the scattering angle's cosine -1.
  const double turned = 1.0 + g * g + 2.0 * g * a.cos_phase;
  const double level = std::pow(a.cos_in * a.cos_out * (a.cos_in + a.cos_out), k_ - 1.0) * (1.0 - g * g) /
                       (turned * std::sqrt(turned)) * std::numbers::inv_pi;
  const float factor = static_cast<float>(level), hot = static_cast<float>(1.0 / (1.0 + a.shadow_distance()));
  const float* __restrict rho0 = parameters[0];
  const float* __restrict rho_c = parameters[spectra_.size() - 1];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] = rho0[n] * factor * (1.0f + (1.0f - rho_c[n]) * hot);
}

}  // namespace ifov::materials
