#include "materials/bsdf/oren_nayar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ifov::materials {

using std::numbers::pi;

const BsdfModel OrenNayar::kModel{
    "oren_nayar",
    "rough and matt: Lambertian facets in V-shaped grooves, brighter where the view is near the light",
    {{"slope", "standard deviation of the facets' slope", BsdfParameter::Form::angle, 0.0, 60.0}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<OrenNayar>(inputs.reflectance, inputs.number("slope"));
    }};

OrenNayar::OrenNayar(radiometry::Spectrum reflectance, double slope_rad)
    : reflectance_{std::move(reflectance)} {
  const double s2 = slope_rad * slope_rad;
  c1_ = 1.0 - 0.5 * s2 / (s2 + 0.33);
  c2_ = 0.45 * s2 / (s2 + 0.09);
  c3_ = 0.125 * s2 / (s2 + 0.09);
  again_ = 0.17 * s2 / (s2 + 0.13);
}

std::array<double, 2> OrenNayar::terms(const BsdfEvent& event) const {
  const double out = std::clamp(event.outgoing_cosine(), 0.0, 1.0),
               in = std::clamp(event.incoming_cosine(), 0.0, 1.0);
  const double theta_out = std::acos(out), theta_in = std::acos(in);
  const double alpha = std::max(theta_out, theta_in), beta = std::min(theta_out, theta_in);
  // Of the azimuth between the two; where one of them stands upright it does not matter.
  const double sines = std::sin(theta_out) * std::sin(theta_in);
  const double cos_phi =
      sines > 1e-12 ? std::clamp((math::dot(event.outgoing, event.incoming) - out * in) / sines, -1.0, 1.0)
                    : 0.0;
  const double b = 2.0 * beta / pi;
  const double c2 = c2_ * (std::sin(alpha) - (cos_phi < 0.0 ? b * b * b : 0.0));
  const double ab = 4.0 * alpha * beta / (pi * pi);
  const double once = c1_ + cos_phi * c2 * std::tan(beta) +
                      (1.0 - std::abs(cos_phi)) * c3_ * ab * ab * std::tan(0.5 * (alpha + beta));
  return {once / pi, again_ * (1.0 - cos_phi * b * b) / pi};
}

void OrenNayar::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                         float* bsdf) const {
  const std::array<double, 2> both = terms(event);
  const float once = static_cast<float>(both[0]), again = static_cast<float>(both[1]);
  const float* __restrict reflectance = parameters[0];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] = reflectance[n] * (once + again * reflectance[n]);
}

}  // namespace ifov::materials
