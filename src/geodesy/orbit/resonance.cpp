#include "geodesy/orbit/resonance.h"

#include <erfa.h>

#include <cmath>

#include "geodesy/orbit/powers.h"
#include "geodesy/orbit/wgs72.h"

namespace ifov::geodesy {
namespace {

using orbit::kTwoPi;
using orbit::square;

constexpr double kEarthRotation = 4.37526908801129966e-3;  // rad/min
constexpr double kStep_min = 720.0;

// Of one revolution a day: longitudes of the harmonics.
constexpr double kDailyPhase[3] = {0.13130908, 2.8843198, 0.37448087};

/// A term of two revolutions a day: sin(perigees * argument of perigee + longitudes * mean longitude - phase).
struct Term {
  double perigees, longitudes, phase;
};
constexpr double k22 = 5.7686396, k32 = 0.95240898, k44 = 1.8014998, k52 = 1.0508330, k54 = 4.4108898;
constexpr Term kTerms[10] = {{2, 1, k22}, {0, 1, k22}, {1, 1, k32},  {-1, 1, k32}, {2, 2, k44},
                             {0, 2, k44}, {1, 1, k52}, {-1, 1, k52}, {1, 2, k54},  {-1, 2, k54}};

/// Functions of eccentricity, as polynomials fitted by Hujsak.
double cubic(double c0, double c1, double c2, double c3, double e) {
  return c0 + e * (c1 + e * (c2 + e * c3));
}

struct EccentricityFunctions {
  double g201, g211, g310, g322, g410, g422, g520, g521, g532, g533;

  explicit EccentricityFunctions(double e) {
    g201 = -0.306 - (e - 0.64) * 0.440;
    if (e <= 0.65) {
      g211 = 3.616 - 13.2470 * e + 16.2900 * e * e;
      g310 = cubic(-19.302, 117.3900, -228.4190, 156.5910, e);
      g322 = cubic(-18.9068, 109.7927, -214.6334, 146.5816, e);
      g410 = cubic(-41.122, 242.6940, -471.0940, 313.9530, e);
      g422 = cubic(-146.407, 841.8800, -1629.014, 1083.4350, e);
      g520 = cubic(-532.114, 3017.977, -5740.032, 3708.2760, e);
    } else {
      g211 = cubic(-72.099, 331.819, -508.738, 266.724, e);
      g310 = cubic(-346.844, 1582.851, -2415.925, 1246.113, e);
      g322 = cubic(-342.585, 1554.908, -2366.899, 1215.972, e);
      g410 = cubic(-1052.797, 4758.686, -7193.992, 3651.957, e);
      g422 = cubic(-3581.690, 16178.110, -24462.770, 12422.520, e);
      g520 = e > 0.715 ? cubic(-5149.66, 29936.92, -54087.36, 31324.56, e)
                       : cubic(1464.74, -4664.75, 3763.64, 0.0, e);
    }
    if (e < 0.7) {
      g533 = cubic(-919.22770, 4988.6100, -9064.7700, 5542.21, e);
      g521 = cubic(-822.71072, 4568.6173, -8491.4146, 5337.524, e);
      g532 = cubic(-853.66600, 4690.2500, -8624.7700, 5341.4, e);
    } else {
      g533 = cubic(-37995.780, 161616.52, -229838.20, 109377.94, e);
      g521 = cubic(-51752.104, 218913.95, -309468.16, 146349.42, e);
      g532 = cubic(-40023.880, 170470.89, -242699.48, 115605.82, e);
    }
  }
};

}  // namespace

Resonance::Resonance(const TwoLineElements& elements, double n, const ResonanceRates& zonal,
                     const ResonanceRates& third_bodies) {
  const double e = elements.eccentricity, e2 = e * e;
  if (n > 0.0034906585 && n < 0.0052359877)
    kind_ = Kind::daily;
  else if (n >= 8.26e-3 && n <= 9.24e-3 && e >= 0.5)
    kind_ = Kind::half_daily;
  else
    return;

  const double per_a = std::pow(n / wgs72::kSqrtGm, 2.0 / 3.0);
  const double c = std::cos(elements.inclination_rad), s = std::sin(elements.inclination_rad), c2 = c * c,
               s2 = s * s;
  start_motion_ = n;
  sidereal_ = eraGmst82(elements.epoch.jd1, elements.epoch.jd2);
  perigee_ = elements.perigee_argument_rad, perigee_rate_ = zonal.perigee;

  if (kind_ == Kind::half_daily) {
    const EccentricityFunctions g(e);
    const double f220 = 0.75 * (1.0 + 2.0 * c + c2), f221 = 1.5 * s2,
                 f321 = 1.875 * s * (1.0 - 2.0 * c - 3.0 * c2),
                 f322 = -1.875 * s * (1.0 + 2.0 * c - 3.0 * c2), f441 = 35.0 * s2 * f220,
                 f442 = 39.3750 * s2 * s2,
                 f522 = 9.84375 * s * (s2 * (1.0 - 2.0 * c - 5.0 * c2) + (-2.0 + 4.0 * c + 6.0 * c2) / 3.0),
                 f523 = s * (4.92187512 * s2 * (-2.0 - 4.0 * c + 10.0 * c2) +
                             6.56250012 * (1.0 + 2.0 * c - 3.0 * c2)),
                 f542 = 29.53125 * s * (2.0 - 8.0 * c + c2 * (-12.0 + 8.0 * c + 10.0 * c2)),
                 f543 = 29.53125 * s * (-2.0 - 8.0 * c + c2 * (12.0 + 8.0 * c - 10.0 * c2));
    const double degree2 = 3.0 * square(n * per_a), degree3 = degree2 * per_a, degree4 = degree3 * per_a,
                 degree5 = degree4 * per_a;
    constexpr double kRoot22 = 1.7891679e-6, kRoot32 = 3.7393792e-7, kRoot44 = 7.3636953e-9,
                     kRoot52 = 1.1428639e-7, kRoot54 = 2.1765803e-9;
    const double terms[10] = {
        degree2 * kRoot22 * f220 * g.g201,       degree2 * kRoot22 * f221 * g.g211,
        degree3 * kRoot32 * f321 * g.g310,       degree3 * kRoot32 * f322 * g.g322,
        2.0 * degree4 * kRoot44 * f441 * g.g410, 2.0 * degree4 * kRoot44 * f442 * g.g422,
        degree5 * kRoot52 * f522 * g.g520,       degree5 * kRoot52 * f523 * g.g532,
        2.0 * degree5 * kRoot54 * f542 * g.g521, 2.0 * degree5 * kRoot54 * f543 * g.g533};
    for (int k = 0; k < 10; ++k) half_daily_[k] = terms[k];
    start_longitude_ =
        std::fmod(elements.mean_anomaly_rad + 2.0 * elements.ascending_node_rad - 2.0 * sidereal_, kTwoPi);
    drift_ =
        zonal.anomaly + third_bodies.anomaly + 2.0 * (zonal.node + third_bodies.node - kEarthRotation) - n;
  } else {
    const double g200 = 1.0 + e2 * (-2.5 + 0.8125 * e2), g310 = 1.0 + 2.0 * e2,
                 g300 = 1.0 + e2 * (-6.0 + 6.60937 * e2);
    const double f220 = 0.75 * square(1.0 + c), f311 = 0.9375 * s2 * (1.0 + 3.0 * c) - 0.75 * (1.0 + c),
                 f330 = 1.875 * (1.0 + c) * square(1.0 + c);
    constexpr double kQ22 = 1.7891679e-6, kQ31 = 2.1460748e-6, kQ33 = 2.2123015e-7;
    const double common = 3.0 * square(n * per_a);
    daily_[0] = common * f311 * g310 * kQ31 * per_a;
    daily_[1] = 2.0 * common * f220 * g200 * kQ22;
    daily_[2] = 3.0 * common * f330 * g300 * kQ33 * per_a;
    start_longitude_ = std::fmod(
        elements.mean_anomaly_rad + elements.ascending_node_rad + elements.perigee_argument_rad - sidereal_,
        kTwoPi);
    drift_ = zonal.anomaly + zonal.perigee + zonal.node - kEarthRotation + third_bodies.anomaly +
             third_bodies.perigee + third_bodies.node - n;
  }
}

Resonance::Change Resonance::change(double since, double longitude, double motion) const {
  Change change;
  change.longitude = motion + drift_;
  if (kind_ == Kind::daily) {
    for (int k = 0; k < 3; ++k) {
      const double order = k + 1.0, angle = order * (longitude - kDailyPhase[k]);
      change.motion += daily_[k] * std::sin(angle);
      change.motion_twice += order * daily_[k] * std::cos(angle);
    }
  } else {
    const double perigee = perigee_ + perigee_rate_ * since;
    for (int k = 0; k < 10; ++k) {
      const double angle = kTerms[k].perigees * perigee + kTerms[k].longitudes * longitude - kTerms[k].phase;
      change.motion += half_daily_[k] * std::sin(angle);
      change.motion_twice += kTerms[k].longitudes * half_daily_[k] * std::cos(angle);
    }
  }
  change.motion_twice *= change.longitude;
  return change;
}

void Resonance::replace(double minutes, double node, double perigee, double& anomaly,
                        double& mean_motion) const {
  if (kind_ == Kind::none) return;
  const double step = minutes > 0.0 ? kStep_min : -kStep_min;
  double since = 0.0, longitude = start_longitude_, motion = start_motion_;
  Change now = change(since, longitude, motion);
  while (std::abs(minutes - since) >= kStep_min) {
    longitude += step * now.longitude + 0.5 * step * step * now.motion;
    motion += step * now.motion + 0.5 * step * step * now.motion_twice;
    since += step;
    now = change(since, longitude, motion);
  }
  const double rest = minutes - since;
  longitude += rest * now.longitude + 0.5 * rest * rest * now.motion;
  mean_motion = motion + rest * now.motion + 0.5 * rest * rest * now.motion_twice;
  const double sidereal = std::fmod(sidereal_ + minutes * kEarthRotation, kTwoPi);
  anomaly = kind_ == Kind::half_daily ? longitude - 2.0 * node + 2.0 * sidereal
                                      : longitude - node - perigee + sidereal;
}

}  // namespace ifov::geodesy
