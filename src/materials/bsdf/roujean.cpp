#include "materials/bsdf/roujean.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

using std::numbers::inv_pi;
using std::numbers::pi;

const BsdfModel Roujean::kModel{
    "roujean",
    "land by the kernels of Roujean et al. 1992, protrusions with shadows and a volume of facets; the "
    "reflectance is k0",
    {{"k1", "weight of the geometric kernel f1: protrusions and their shadows",
      BsdfParameter::Form::spectrum},
     {"k2", "weight of the volume kernel f2: leaves", BsdfParameter::Form::spectrum}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<Roujean>(inputs.reflectance, inputs.spectrum("k1"), inputs.spectrum("k2"));
    }};

Roujean::Roujean(radiometry::Spectrum level, radiometry::Spectrum geometric, radiometry::Spectrum volumetric)
    : spectra_{std::move(level), std::move(geometric), std::move(volumetric)} {}

std::array<double, 2> Roujean::kernels(const BsdfEvent& event) {
  const ReflectionAngles a(event);
  const double azimuth = std::acos(a.cos_azimuth), phase = std::acos(a.cos_phase);
  // Of walls that look everywhere: what is lit and seen of them, less the ground that is in shadow or hidden.
  const double walls =
      0.5 * inv_pi * ((pi - azimuth) * a.cos_azimuth + std::sin(azimuth)) * a.tan_in * a.tan_out;
  const double ground = inv_pi * (a.tan_in + a.tan_out + a.shadow_distance());
  const double volume =
      4.0 / (3.0 * pi) * ((0.5 * pi - phase) * a.cos_phase + std::sin(phase)) / (a.cos_in + a.cos_out) -
      1.0 / 3.0;
  return {walls - ground, volume};
}

void Roujean::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                       float* bsdf) const {
  const std::array<double, 2> both = kernels(event);
  const float geometric = static_cast<float>(both[0]), volume = static_cast<float>(both[1]);
  const float per_sr = static_cast<float>(inv_pi);
  const float* __restrict k0 = parameters[0];
  const float* __restrict k1 = parameters[1];
  const float* __restrict k2 = parameters[2];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = per_sr * std::max(0.0f, k0[n] + geometric * k1[n] + volume * k2[n]);
}

}  // namespace ifov::materials
