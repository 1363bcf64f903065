#include "geodesy/orbit/deep_space.h"

#include <cmath>

#include "geodesy/orbit/powers.h"

namespace ifov::geodesy {
namespace {

using orbit::kPi;
using orbit::kTwoPi;
using orbit::square;

constexpr double kSolarRate = 1.19459e-5, kSolarEccentricity = 0.01675, kSolarStrength = 2.9864797e-6;
constexpr double kLunarRate = 1.5835218e-4, kLunarEccentricity = 0.05490, kLunarStrength = 4.7968065e-7;
constexpr double kEclipticSine = 0.39785416, kEclipticCosine = 0.91744867;
constexpr double kSolarPerigeeCosine = 0.1945905, kSolarPerigeeSine = -0.98088458;
constexpr double kLeastInclination = 5.2359877e-2;  // below it nodes are not turned
constexpr double kLyddaneInclination = 0.2;         // below it the node is singular

/// Days from 1900 January 0, 12 h, by way of one Julian date as in the programs that elements are fitted with: its last digit, 40
/// us, moves a satellite of eccentricity 0.97 by 4 mm.
double days_since_1900(const UtcTime& time) { return (time.jd1 + time.jd2) - 2415020.0; }

}  // namespace

DeepSpace::Body DeepSpace::attraction(const TwoLineElements& elements, double mean_motion, const Lie& lie,
                                      double strength, double rate, double orbit_eccentricity,
                                      double mean_anomaly) {
  const double e = elements.eccentricity, e2 = e * e, beta2 = 1.0 - e2, beta = std::sqrt(beta2);
  const double so = std::sin(elements.perigee_argument_rad), co = std::cos(elements.perigee_argument_rad),
               si = std::sin(elements.inclination_rad), ci = std::cos(elements.inclination_rad);
  const double a1 = lie.cos_g * lie.cos_h + lie.sin_g * lie.cos_i * lie.sin_h,
               a3 = -lie.sin_g * lie.cos_h + lie.cos_g * lie.cos_i * lie.sin_h,
               a7 = -lie.cos_g * lie.sin_h + lie.sin_g * lie.cos_i * lie.cos_h, a8 = lie.sin_g * lie.sin_i,
               a9 = lie.sin_g * lie.sin_h + lie.cos_g * lie.cos_i * lie.cos_h, a10 = lie.cos_g * lie.sin_i;
  const double a2 = ci * a7 + si * a8, a4 = ci * a9 + si * a10, a5 = -si * a7 + ci * a8,
               a6 = -si * a9 + ci * a10;
  const double x1 = a1 * co + a2 * so, x2 = a3 * co + a4 * so, x3 = -a1 * so + a2 * co,
               x4 = -a3 * so + a4 * co, x5 = a5 * so, x6 = a6 * so, x7 = a5 * co, x8 = a6 * co;
  const double z31 = 12.0 * x1 * x1 - 3.0 * x3 * x3, z32 = 24.0 * x1 * x2 - 6.0 * x3 * x4,
               z33 = 12.0 * x2 * x2 - 3.0 * x4 * x4;
  const double z1 = 6.0 * (a1 * a1 + a2 * a2) + (1.0 + e2) * z31,
               z2 = 12.0 * (a1 * a3 + a2 * a4) + (1.0 + e2) * z32,
               z3 = 6.0 * (a3 * a3 + a4 * a4) + (1.0 + e2) * z33;
  const double z11 = -6.0 * a1 * a5 + e2 * (-24.0 * x1 * x7 - 6.0 * x3 * x5),
               z12 = -6.0 * (a1 * a6 + a3 * a5) +
                     e2 * (-24.0 * (x2 * x7 + x1 * x8) - 6.0 * (x3 * x6 + x4 * x5)),
               z13 = -6.0 * a3 * a6 + e2 * (-24.0 * x2 * x8 - 6.0 * x4 * x6);
  const double z21 = 6.0 * a2 * a5 + e2 * (24.0 * x1 * x5 - 6.0 * x3 * x7),
               z22 =
                   6.0 * (a4 * a5 + a2 * a6) + e2 * (24.0 * (x2 * x5 + x1 * x6) - 6.0 * (x4 * x7 + x3 * x8)),
               z23 = 6.0 * a4 * a6 + e2 * (24.0 * x2 * x6 - 6.0 * x4 * x8);
  const double s3 = strength / mean_motion, s2 = -0.5 * s3 / beta, s4 = s3 * beta, s1 = -15.0 * e * s4,
               s5 = x1 * x3 + x2 * x4, s6 = x2 * x3 + x1 * x4, s7 = x2 * x4 - x1 * x3;

  Body body;
  body.rate = rate, body.orbit_eccentricity = orbit_eccentricity, body.mean_anomaly = mean_anomaly;
  body.e2 = 2.0 * s1 * s6, body.e3 = 2.0 * s1 * s7;
  body.i2 = 2.0 * s2 * z12, body.i3 = 2.0 * s2 * (z13 - z11);
  body.l2 = -2.0 * s3 * z2, body.l3 = -2.0 * s3 * (z3 - z1),
  body.l4 = -2.0 * s3 * (-21.0 - 9.0 * e2) * orbit_eccentricity;
  body.g2 = 2.0 * s4 * z32, body.g3 = 2.0 * s4 * (z33 - z31), body.g4 = -18.0 * s4 * orbit_eccentricity;
  body.h2 = -2.0 * s2 * z22, body.h3 = -2.0 * s2 * (z23 - z21);

  body.eccentricity_rate = s1 * rate * s5;
  body.inclination_rate = s2 * rate * (z11 + z13);
  body.longitude_rate = -rate * s3 * (z1 + z3 - 14.0 - 6.0 * e2);
  const bool level =
      elements.inclination_rad < kLeastInclination || elements.inclination_rad > kPi - kLeastInclination;
  const double node = level ? 0.0 : -rate * s2 * (z21 + z23);  // times the sine of the inclination
  body.node_rate = si != 0.0 ? node / si : node;
  body.perigee_rate = s4 * rate * (z31 + z33 - 6.0) - ci * body.node_rate;
  return body;
}

DeepSpace::DeepSpace(const TwoLineElements& elements, double mean_motion, const Rates& zonal) {
  const double day = days_since_1900(elements.epoch);
  const double sn = std::sin(elements.ascending_node_rad), cn = std::cos(elements.ascending_node_rad);

  sun_ = attraction(
      elements, mean_motion, {kSolarPerigeeSine, kSolarPerigeeCosine, kEclipticSine, kEclipticCosine, sn, cn},
      kSolarStrength, kSolarRate, kSolarEccentricity, std::fmod(6.2565837 + 0.017201977 * day, kTwoPi));

  // The Moon's orbit from its node in the ecliptic.
  const double ecliptic_node = std::fmod(4.5236020 - 9.2422029e-4 * day, kTwoPi);
  const double ns = std::sin(ecliptic_node), nc = std::cos(ecliptic_node);
  Lie moon;
  moon.cos_i = 0.91375164 - 0.03568096 * nc, moon.sin_i = std::sqrt(1.0 - square(moon.cos_i));
  const double node_sine = 0.089683511 * ns / moon.sin_i, node_cosine = std::sqrt(1.0 - square(node_sine));
  const double longitude = 5.8351514 + 0.0019443680 * day;
  const double perigee =
      longitude - ecliptic_node +
      std::atan2(kEclipticSine * ns / moon.sin_i, node_cosine * nc + kEclipticCosine * node_sine * ns);
  moon.sin_g = std::sin(perigee), moon.cos_g = std::cos(perigee);
  moon.cos_h = node_cosine * cn + node_sine * sn, moon.sin_h = sn * node_cosine - cn * node_sine;
  moon_ = attraction(elements, mean_motion, moon, kLunarStrength, kLunarRate, kLunarEccentricity,
                     std::fmod(4.7199672 + 0.22997150 * day - longitude, kTwoPi));

  secular_ = {sun_.eccentricity_rate + moon_.eccentricity_rate,
              sun_.inclination_rate + moon_.inclination_rate, sun_.longitude_rate + moon_.longitude_rate,
              sun_.perigee_rate + moon_.perigee_rate, sun_.node_rate + moon_.node_rate};
  resonance_ =
      Resonance(elements, mean_motion, {0.0, 0.0, zonal.anomaly, zonal.perigee, zonal.node}, secular_);
}

void DeepSpace::add_secular(double t, Elements& elements) const {
  elements.eccentricity += secular_.eccentricity * t;
  elements.inclination += secular_.inclination * t;
  elements.perigee += secular_.perigee * t;
  elements.node += secular_.node * t;
  elements.anomaly += secular_.anomaly * t;
  resonance_.replace(t, elements.node, elements.perigee, elements.anomaly, elements.mean_motion);
}

void DeepSpace::add_periods(const Body& body, double t, double (&sums)[5]) {
  const double mean = body.mean_anomaly + body.rate * t;
  const double anomaly = mean + 2.0 * body.orbit_eccentricity * std::sin(mean);
  const double s = std::sin(anomaly), f2 = 0.5 * s * s - 0.25, f3 = -0.5 * s * std::cos(anomaly);
  sums[0] += body.e2 * f2 + body.e3 * f3;
  sums[1] += body.i2 * f2 + body.i3 * f3;
  sums[2] += body.l2 * f2 + body.l3 * f3 + body.l4 * s;
  sums[3] += body.g2 * f2 + body.g3 * f3 + body.g4 * s;
  sums[4] += body.h2 * f2 + body.h3 * f3;
}

void DeepSpace::add_periodic(double t, Elements& elements) const {
  double sums[5] = {};
  add_periods(sun_, t, sums);
  add_periods(moon_, t, sums);
  const auto [eccentricity, inclination, longitude, perigee, node] = sums;
  elements.inclination += inclination;
  elements.eccentricity += eccentricity;
  const double si = std::sin(elements.inclination), ci = std::cos(elements.inclination);
  if (elements.inclination >= kLyddaneInclination) {
    elements.perigee += perigee - ci / si * node;
    elements.node += node / si;
    elements.anomaly += longitude;
  } else {
    // Lyddane's variables, which are regular where the orbit is level.
    const double sn = std::sin(elements.node), cn = std::cos(elements.node);
    const double alpha = si * sn + node * cn + inclination * ci * sn,
                 beta = si * cn - node * sn + inclination * ci * cn;
    const double before = std::fmod(elements.node, kTwoPi);
    const double sum =
        elements.anomaly + elements.perigee + longitude + perigee + (ci - inclination * si) * before;
    double after = std::atan2(alpha, beta);
    if (std::abs(before - after) > kPi) after += after < before ? kTwoPi : -kTwoPi;
    elements.node = after;
    elements.anomaly += longitude;
    elements.perigee = sum - elements.anomaly - ci * after;
  }
  if (elements.inclination < 0.0) {
    elements.inclination = -elements.inclination;
    elements.node += kPi;
    elements.perigee -= kPi;
  }
}

}  // namespace ifov::geodesy
