#include "materials/bsdf/reflection_angles.h"

#include <algorithm>
#include <cmath>

namespace ifov::materials {
namespace {

double sine(double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); }

}  // namespace

ReflectionAngles::ReflectionAngles(const BsdfEvent& event) {
  const double in = std::clamp(event.incoming_cosine(), 0.0, 1.0),
               out = std::clamp(event.outgoing_cosine(), 0.0, 1.0);
  // Where one of them stands upright the azimuth does not matter.
  const double sines = sine(in) * sine(out);
  const double upright = event.side == Side::reflected ? in * out : -in * out;
  cos_azimuth = sines > 1e-12
                    ? std::clamp((math::dot(event.incoming, event.outgoing) - upright) / sines, -1.0, 1.0)
                    : 0.0;
  cos_in = std::max(in, kLeastCosine);
  cos_out = std::max(out, kLeastCosine);
  tan_in = sine(cos_in) / cos_in;
  tan_out = sine(cos_out) / cos_out;
  cos_phase = std::clamp(cos_in * cos_out * (1.0 + tan_in * tan_out * cos_azimuth), -1.0, 1.0);
}

double ReflectionAngles::shadow_distance() const {
  const double apart = tan_in - tan_out;
  return std::sqrt(apart * apart + 2.0 * tan_in * tan_out * (1.0 - cos_azimuth));
}

}  // namespace ifov::materials
