#include "geodesy/orbit/sgp4.h"

#include <algorithm>
#include <cmath>

#include "geodesy/orbit/powers.h"
#include "geodesy/orbit/wgs72.h"

namespace ifov::geodesy {
namespace {

using orbit::cube;
using orbit::kTwoPi;
using orbit::square;

using wgs72::kJ2;
using wgs72::kJ3;
using wgs72::kJ4;
using wgs72::kRadius_km;
using wgs72::kSqrtGm;

constexpr double kThirds2 = 2.0 / 3.0;
constexpr double kDeepSpacePeriod_min = 225.0;
constexpr double kLeastEccentricity = 1e-6, kNegativeEccentricity = -0.001;
constexpr double kRetrograde = 1.5e-12;  // 1 + cos i, below which the long-period term is cut

OrbitState failed(OrbitFault fault) { return {{}, {}, fault}; }

/// The long-period coefficient of the mean longitude, singular for an orbit of 180 degrees.
double longitude_coefficient(double cos_i, double sin_i) {
  const double beside = std::abs(1.0 + cos_i) > kRetrograde ? 1.0 + cos_i : kRetrograde;
  return -0.25 * (kJ3 / kJ2) * sin_i * (3.0 + 5.0 * cos_i) / beside;
}

double perigee_coefficient(double sin_i) { return -0.5 * (kJ3 / kJ2) * sin_i; }

/// Of the model atmosphere, whose density falls with the fourth power of the height above s: s (Earth radii) and (q0 - s)^4, lower for
/// satellites whose perigee is.
struct Density {
  double s = 0.0, q4 = 0.0;
};

Density density(double perigee_radius) {
  const double perigee_km = (perigee_radius - 1.0) * kRadius_km;
  const double s_km = perigee_km < 98.0 ? 20.0 : perigee_km < 156.0 ? perigee_km - 78.0 : 78.0;
  return {s_km / kRadius_km + 1.0, square(square((120.0 - s_km) / kRadius_km))};
}

}  // namespace

struct Sgp4::Mean {
  double mean_motion = 0.0, semi_major = 0.0, eccentricity = 0.0, inclination = 0.0, node = 0.0,
         perigee = 0.0, anomaly = 0.0;
};

Sgp4::Sgp4(const TwoLineElements& elements) : elements_(elements) {
  const double e = elements.eccentricity, e2 = e * e, beta2 = 1.0 - e2, beta = std::sqrt(beta2);
  cos_i_ = std::cos(elements.inclination_rad), sin_i_ = std::sin(elements.inclination_rad);
  const double c2 = cos_i_ * cos_i_, c4 = c2 * c2;

  // The mean motion of the elements is Kozai's; Brouwer's theory has another one.
  const double kozai = std::pow(kSqrtGm / elements.mean_motion_rad_min, kThirds2);
  const double d1 = 0.75 * kJ2 * (3.0 * c2 - 1.0) / (beta * beta2);
  const double first = d1 / square(kozai);
  const double middle = kozai * (1.0 - square(first) - first * (1.0 / 3.0 + 134.0 * square(first) / 81.0));
  mean_motion_ = elements.mean_motion_rad_min / (1.0 + d1 / square(middle));
  semi_major_ = std::pow(kSqrtGm / mean_motion_, kThirds2);

  const double n = mean_motion_, a = semi_major_, p = a * beta2;
  const double perigee_radius = a * (1.0 - e);
  const double three_c2_1 = 3.0 * c2 - 1.0, five_c2 = 1.0 - 5.0 * c2, one_c2 = 1.0 - c2;
  simple_drag_ = perigee_radius < 220.0 / kRadius_km + 1.0;

  const Density air = density(perigee_radius);
  const double xi = 1.0 / (a - air.s);
  eta_ = a * e * xi;
  const double eta2 = eta_ * eta_, e_eta = e * eta_, psi2 = std::abs(1.0 - eta2);
  const double coefficient = air.q4 * square(square(xi)), scaled = coefficient / std::pow(psi2, 3.5);
  const double c2_drag = scaled * n *
                         (a * (1.0 + 1.5 * eta2 + e_eta * (4.0 + eta2)) +
                          0.375 * kJ2 * xi / psi2 * three_c2_1 * (8.0 + 3.0 * eta2 * (8.0 + eta2)));
  c1_ = elements.drag_bstar * c2_drag;
  const double c3 = e > 1e-4 ? -2.0 * coefficient * xi * (kJ3 / kJ2) * n * sin_i_ / e : 0.0;
  c4_ = 2.0 * n * scaled * a * beta2 *
        (eta_ * (2.0 + 0.5 * eta2) + e * (0.5 + 2.0 * eta2) -
         kJ2 * xi / (a * psi2) *
             (-3.0 * three_c2_1 * (1.0 - 2.0 * e_eta + eta2 * (1.5 - 0.5 * e_eta)) +
              0.75 * one_c2 * (2.0 * eta2 - e_eta * (1.0 + eta2)) *
                  std::cos(2.0 * elements.perigee_argument_rad)));
  c5_ = 2.0 * scaled * a * beta2 * (1.0 + 2.75 * (eta2 + e_eta) + e_eta * eta2);

  const double j2_1 = 1.5 * kJ2 / square(p) * n, j2_2 = 0.5 * j2_1 * kJ2 / square(p),
               j4 = -0.46875 * kJ4 / square(square(p)) * n;
  anomaly_rate_ = n + 0.5 * j2_1 * beta * three_c2_1 + 0.0625 * j2_2 * beta * (13.0 - 78.0 * c2 + 137.0 * c4);
  perigee_rate_ = -0.5 * j2_1 * five_c2 + 0.0625 * j2_2 * (7.0 - 114.0 * c2 + 395.0 * c4) +
                  j4 * (3.0 - 36.0 * c2 + 49.0 * c4);
  const double node_first = -j2_1 * cos_i_;
  node_rate_ = node_first + (0.5 * j2_2 * (4.0 - 19.0 * c2) + 2.0 * j4 * (3.0 - 7.0 * c2)) * cos_i_;

  perigee_drag_ = elements.drag_bstar * c3 * std::cos(elements.perigee_argument_rad);
  anomaly_drag_ = e > 1e-4 ? -kThirds2 * coefficient * elements.drag_bstar / e_eta : 0.0;
  node_drag_ = 3.5 * beta2 * node_first * c1_;
  t2_ = 1.5 * c1_;
  anomaly_cube_ = cube(1.0 + eta_ * std::cos(elements.mean_anomaly_rad));
  sin_anomaly_ = std::sin(elements.mean_anomaly_rad);

  if (kTwoPi / n >= kDeepSpacePeriod_min) {
    simple_drag_ = true;
    deep_space_.emplace(elements, n, DeepSpace::Rates{anomaly_rate_, perigee_rate_, node_rate_});
  }
  if (!simple_drag_) {
    const double c1_2 = c1_ * c1_;
    d2_ = 4.0 * a * xi * c1_2;
    const double part = d2_ * xi * c1_ / 3.0;
    d3_ = (17.0 * a + air.s) * part;
    d4_ = 0.5 * part * a * xi * (221.0 * a + 31.0 * air.s) * c1_;
    t3_ = d2_ + 2.0 * c1_2;
    t4_ = 0.25 * (3.0 * d3_ + c1_ * (12.0 * d2_ + 10.0 * c1_2));
    t5_ = 0.2 * (3.0 * d4_ + 12.0 * c1_ * d3_ + 6.0 * d2_ * d2_ + 15.0 * c1_2 * (2.0 * d2_ + c1_2));
  }
}

OrbitFault Sgp4::add_drag_and_secular(double t, Mean& mean) const {
  const double t2 = t * t;
  const double anomaly = elements_.mean_anomaly_rad + anomaly_rate_ * t;
  mean.anomaly = anomaly;
  mean.perigee = elements_.perigee_argument_rad + perigee_rate_ * t;
  mean.node = elements_.ascending_node_rad + node_rate_ * t + node_drag_ * t2;
  double shrink = 1.0 - c1_ * t, round = elements_.drag_bstar * c4_ * t, ahead = t2_ * t2;
  if (!simple_drag_) {
    const double shift =
        perigee_drag_ * t + anomaly_drag_ * (cube(1.0 + eta_ * std::cos(anomaly)) - anomaly_cube_);
    mean.anomaly += shift;
    mean.perigee -= shift;
    const double t3 = t2 * t, t4 = t3 * t;
    shrink -= d2_ * t2 + d3_ * t3 + d4_ * t4;
    round += elements_.drag_bstar * c5_ * (std::sin(mean.anomaly) - sin_anomaly_);
    ahead += t3_ * t3 + t4 * (t4_ + t * t5_);
  }
  mean.mean_motion = mean_motion_;
  mean.eccentricity = elements_.eccentricity;
  mean.inclination = elements_.inclination_rad;
  if (deep_space_) {
    DeepSpace::Elements changed{mean.mean_motion, mean.eccentricity, mean.inclination,
                                mean.node,        mean.perigee,      mean.anomaly};
    deep_space_->add_secular(t, changed);
    mean = {changed.mean_motion, 0.0,          changed.eccentricity,
            changed.inclination, changed.node, changed.perigee,
            changed.anomaly};
  }
  if (mean.mean_motion <= 0.0) return OrbitFault::mean_motion;
  mean.semi_major = std::pow(kSqrtGm / mean.mean_motion, kThirds2) * square(shrink);
  mean.mean_motion = kSqrtGm / std::pow(mean.semi_major, 1.5);
  mean.eccentricity -= round;
  if (mean.eccentricity >= 1.0 || mean.eccentricity < kNegativeEccentricity) return OrbitFault::eccentricity;
  mean.eccentricity = std::max(mean.eccentricity, kLeastEccentricity);
  mean.anomaly += mean_motion_ * ahead;
  const double longitude = std::fmod(mean.anomaly + mean.perigee + mean.node, kTwoPi);
  mean.node = std::fmod(mean.node, kTwoPi);
  mean.perigee = std::fmod(mean.perigee, kTwoPi);
  mean.anomaly = std::fmod(longitude - mean.perigee - mean.node, kTwoPi);
  return OrbitFault::none;
}

OrbitState Sgp4::short_periods(const Mean& mean) const {
  double cos_i = cos_i_, sin_i = sin_i_;
  if (deep_space_) cos_i = std::cos(mean.inclination), sin_i = std::sin(mean.inclination);
  const double c2 = cos_i * cos_i;

  // Long-period terms of the third zonal harmonic.
  const double a = mean.semi_major, e = mean.eccentricity, per_p = 1.0 / (a * (1.0 - e * e));
  const double along = e * std::cos(mean.perigee),
               across = e * std::sin(mean.perigee) + per_p * perigee_coefficient(sin_i);
  const double longitude =
      mean.anomaly + mean.perigee + mean.node + per_p * longitude_coefficient(cos_i, sin_i) * along;

  // Kepler's equation.
  const double u = std::fmod(longitude - mean.node, kTwoPi);
  double sine = 0.0, cosine = 0.0, eccentric = u;
  for (double step = 1.0, tries = 0; std::abs(step) >= 1e-12 && tries < 10; ++tries) {
    sine = std::sin(eccentric), cosine = std::cos(eccentric);
    step =
        std::clamp((u - across * cosine + along * sine - eccentric) / (1.0 - cosine * along - sine * across),
                   -0.95, 0.95);
    eccentric += step;
  }

  const double e_cosine = along * cosine + across * sine, e_sine = along * sine - across * cosine,
               e2 = along * along + across * across, p = a * (1.0 - e2);
  if (p < 0.0) return failed(OrbitFault::semi_latus_rectum);
  const double r = a * (1.0 - e_cosine), r_rate = std::sqrt(a) * e_sine / r, across_rate = std::sqrt(p) / r,
               beta = std::sqrt(1.0 - e2), part = e_sine / (1.0 + beta);
  const double sin_u = a / r * (sine - across - along * part),
               cos_u = a / r * (cosine - along + across * part);
  const double sin_2u = 2.0 * cos_u * sin_u, cos_2u = 1.0 - 2.0 * sin_u * sin_u;

  // Short-period terms of the second zonal harmonic.
  const double j2_1 = 0.5 * kJ2 / p, j2_2 = j2_1 / p, three_c2_1 = 3.0 * c2 - 1.0, one_c2 = 1.0 - c2;
  const double radius = r * (1.0 - 1.5 * j2_2 * beta * three_c2_1) + 0.5 * j2_1 * one_c2 * cos_2u;
  const double latitude_argument = std::atan2(sin_u, cos_u) - 0.25 * j2_2 * (7.0 * c2 - 1.0) * sin_2u;
  const double node = mean.node + 1.5 * j2_2 * cos_i * sin_2u;
  const double inclination = mean.inclination + 1.5 * j2_2 * cos_i * sin_i * cos_2u;
  const double outward = r_rate - mean.mean_motion * j2_1 * one_c2 * sin_2u / kSqrtGm;
  const double forward =
      across_rate + mean.mean_motion * j2_1 * (one_c2 * cos_2u + 1.5 * three_c2_1) / kSqrtGm;

  const double su = std::sin(latitude_argument), cu = std::cos(latitude_argument), sn = std::sin(node),
               cn = std::cos(node), si = std::sin(inclination), ci = std::cos(inclination);
  const math::Vec3 to_satellite{-sn * ci * su + cn * cu, cn * ci * su + sn * cu, si * su},
      ahead{-sn * ci * cu - cn * su, cn * ci * cu - sn * su, si * cu};
  constexpr double kRadius_m = kRadius_km * 1000.0, kSpeed_m_s = kRadius_m * kSqrtGm / 60.0;
  return {{math::Point3{} + radius * kRadius_m * to_satellite},
          {kSpeed_m_s * (outward * to_satellite + forward * ahead)},
          radius < 1.0 ? OrbitFault::decayed : OrbitFault::none};
}

OrbitState Sgp4::after_minutes(double minutes) const {
  Mean mean;
  if (const OrbitFault fault = add_drag_and_secular(minutes, mean); fault != OrbitFault::none)
    return failed(fault);
  if (deep_space_) {
    DeepSpace::Elements changed{mean.mean_motion, mean.eccentricity, mean.inclination,
                                mean.node,        mean.perigee,      mean.anomaly};
    deep_space_->add_periodic(minutes, changed);
    if (changed.eccentricity < 0.0 || changed.eccentricity > 1.0)
      return failed(OrbitFault::perturbed_eccentricity);
    mean.eccentricity = changed.eccentricity, mean.inclination = changed.inclination,
    mean.node = changed.node;
    mean.perigee = changed.perigee, mean.anomaly = changed.anomaly;
  }
  return short_periods(mean);
}

}  // namespace ifov::geodesy
