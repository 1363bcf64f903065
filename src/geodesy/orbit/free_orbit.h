#pragma once

#include "geodesy/frames.h"

namespace ifov::geodesy {

/// Of the Earth's gravity: unnormalised zonal harmonics of EGM2008 (Pavlis et al. 2012), about its axis of rotation.
struct Zonals {
  double j2 = 1.0826261738522227e-3, j3 = -2.5324105185677225e-6, j4 = -1.6198975999169731e-6;
};

struct CelestialState {
  PointIn<Gcrs> position;  ///< m
  GcrsVector velocity_m_s;
};

/// Falls freely about the Earth: its mass and zonal harmonics to the fourth, integrated numerically by extrapolation (Gragg 1965, Bulirsch and
/// Stoer 1966). No air, Moon or Sun, and no harmonics by longitude. Equations and what is left out: docs/theory/orbits.md.
class FreeOrbit {
 public:
  /// `pole`: the Earth's axis of rotation. InputError for a start inside the Earth.
  FreeOrbit(const CelestialState& start, GcrsVector pole, const Zonals& zonals = {});

  /// Goes on to so long after the start, or before. InputError where it meets the ground on the way.
  const CelestialState& to(double seconds);

  /// Energy a mass in the field, m2/s2: of a free orbit the same at all times.
  double energy(const CelestialState& state) const;

 private:
  math::Vec3 acceleration(math::Vec3 position_m) const;
  /// By a step; false where it is too long to be found.
  bool step(double seconds);

  CelestialState state_;
  math::Vec3 pole_;
  Zonals zonals_;
  double now_s_ = 0.0, step_s_ = 60.0;
};

}  // namespace ifov::geodesy
