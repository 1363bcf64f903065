#pragma once

#include "materials/bsdf/bsdf.h"

namespace ifov::materials {

/// The angles of an event as reflectance models of land surfaces use them. Such models are fitted to views and light well above
/// the horizon and grow without bound towards it; beyond acos(kLeastCosine) = 88.9 deg either direction counts as if it
/// were there, at its own azimuth, so that what is checked at that angle holds for all beyond. Reciprocal.
struct ReflectionAngles {
  static constexpr double kLeastCosine = 0.02;

  explicit ReflectionAngles(const BsdfEvent& event);

  double cos_in, cos_out;
  double tan_in, tan_out;
  double cos_azimuth;  ///< between the two along the surface; 1 where light comes from the side of the viewer
  double cos_phase;    ///< of the angle between the two directions; 1 in the hot spot

  /// sqrt(tan^2 in + tan^2 out - 2 tan in tan out cos azimuth): how far apart the two shadows of a stem of unit height end.
  double shadow_distance() const;
};

}  // namespace ifov::materials
