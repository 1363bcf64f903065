#include "materials/bsdf/hapke.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace ifov::materials {

using std::numbers::inv_pi;
using std::numbers::pi;

const BsdfModel Hapke::kModel{
    "hapke",
    "soil and regolith, a powder of grains (Hapke 1981, 1984); the reflectance is w, a grain's albedo",
    {{"b0", "height of the opposition surge", BsdfParameter::Form::number, 0.0, 1.0, "0"},
     {"h", "its width: half its height at a phase angle of 2 atan h", BsdfParameter::Form::number, 0.01, 1.0,
      "0.05"},
     {"b", "weight of cos g in a grain's phase function, g the phase angle; above 0 more light goes back",
      BsdfParameter::Form::number, -1.5, 1.5, "0"},
     {"c", "weight of (3 cos^2 g - 1)/2", BsdfParameter::Form::number, -1.0, 1.5, "0"},
     {"lobe", "asymmetry of the two lobes of Henyey and Greenstein that b and c add to; 0: none",
      BsdfParameter::Form::number, 0.0, 0.7, "0"},
     {"backward", "1: all in the lobe that goes back, -1: all in the one that goes on",
      BsdfParameter::Form::number, -1.0, 1.0, "0"},
     {"roughness", "theta-bar: mean slope angle of the relief that is not resolved",
      BsdfParameter::Form::angle, 0.0, 45.0, "\"0 deg\""}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      HapkeParameters p;
      p.b0 = inputs.number("b0");
      p.h = inputs.number("h");
      p.b = inputs.number("b");
      p.c = inputs.number("c");
      p.lobe = inputs.number("lobe");
      p.backward = inputs.number("backward");
      p.roughness_rad = inputs.number("roughness");
      return std::make_shared<Hapke>(inputs.reflectance, p);
    }};

Hapke::Hapke(radiometry::Spectrum albedo, const HapkeParameters& parameters)
    : albedo_{std::move(albedo)},
      p_{parameters},
      tan_slope_{std::tan(parameters.roughness_rad)},
      mean_cosine_{1.0 / std::sqrt(1.0 + pi * tan_slope_ * tan_slope_)} {
  constexpr int kSteps = 360;
  double least = phase_function(1.0), at = 0.0;
  for (int k = 1; k <= kSteps; ++k) {
    const double phase = pi * k / kSteps, value = phase_function(std::cos(phase));
    if (value < least) {
      least = value;
      at = phase;
    }
  }
  if (least < -1e-6)
    throw InputError(format(
        "hapke: the phase function would be {:.3g}, below 0, at a phase angle of {:.0f} deg; with b = {:g} "
        "and c = {:g} there is more taken away than there is",
        least, at * 180.0 / pi, p_.b, p_.c));
}

double Hapke::phase_function(double cos_phase) const {
  const auto lobe = [&](double asymmetry) {
    const double d = 1.0 + asymmetry * asymmetry - 2.0 * asymmetry * cos_phase;
    return (1.0 - asymmetry * asymmetry) / (d * std::sqrt(d));
  };
  return 0.5 * (1.0 + p_.backward) * lobe(p_.lobe) + 0.5 * (1.0 - p_.backward) * lobe(-p_.lobe) +
         p_.b * cos_phase + 0.5 * p_.c * (3.0 * cos_phase * cos_phase - 1.0);
}

Hapke::Relief Hapke::relief(const ReflectionAngles& a) const {
  if (!(tan_slope_ > 0.0)) return {a.cos_in, a.cos_out, 1.0};
  // Hapke treats light that is higher than the viewer and light that is lower apart, by the same expressions with the two
  // directions exchanged: one is the high direction, one the low.
  struct Direction {
    double cosine, slope, e1, e2, eta;
  };
  const auto direction = [&](double cosine, double tangent) {
    const double x = 1.0 / std::max(1e-6, tan_slope_ * tangent);  // cot of both angles
    Direction d{cosine, cosine * tangent * tan_slope_, std::exp(-2.0 * inv_pi * x), std::exp(-inv_pi * x * x),
                0.0};
    d.eta = mean_cosine_ * (cosine + d.slope * d.e2 / (2.0 - d.e1));
    return d;
  };
  const bool is_light_high = a.cos_in >= a.cos_out;
  const Direction in = direction(a.cos_in, a.tan_in), out = direction(a.cos_out, a.tan_out);
  const Direction &high = is_light_high ? in : out, &low = is_light_high ? out : in;

  const double azimuth = std::acos(a.cos_azimuth), half_sine2 = 0.5 * (1.0 - a.cos_azimuth);
  const double seen = 2.0 - low.e1 - azimuth * inv_pi * high.e1;
  const double cos_high =
      mean_cosine_ * (high.cosine + high.slope * (a.cos_azimuth * low.e2 + half_sine2 * high.e2) / seen);
  const double cos_low = mean_cosine_ * (low.cosine + low.slope * (low.e2 - half_sine2 * high.e2) / seen);
  // Share of shadows that lie where the viewer does not look anyway: all where it has the light in the back.
  const double hidden = std::exp(-2.0 * std::sqrt(half_sine2 / std::max(1e-12, 1.0 - half_sine2)));
  const double factor = cos_high * cos_low / (high.eta * low.eta) * mean_cosine_ /
                        (1.0 - hidden + hidden * mean_cosine_ * high.cosine / high.eta);
  return {is_light_high ? cos_high : cos_low, is_light_high ? cos_low : cos_high, factor};
}

void Hapke::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                     float* bsdf) const {
  const ReflectionAngles a(event);
  const Relief on = relief(a);
  const double tan_half = std::sqrt((1.0 - a.cos_phase) / std::max(1e-12, 1.0 + a.cos_phase));
  const double surge = p_.b0 / (1.0 + tan_half / p_.h);
  const float once = static_cast<float>((1.0 + surge) * phase_function(a.cos_phase) - 1.0);
  const float level = static_cast<float>(on.factor * 0.25 * inv_pi / (on.cos_in + on.cos_out));
  const float in2 = static_cast<float>(2.0 * on.cos_in), out2 = static_cast<float>(2.0 * on.cos_out);
  const float many = (1.0f + in2) * (1.0f + out2);
  const float* __restrict w = parameters[0];
  for (std::size_t n = 0; n < count; ++n) {
    const float gamma = std::sqrt(std::max(0.0f, 1.0f - w[n]));
    bsdf[n] = level * w[n] * (once + many / ((1.0f + in2 * gamma) * (1.0f + out2 * gamma)));
  }
}

}  // namespace ifov::materials
