#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geodesy/orbit/free_orbit.h"

namespace ifov::geodesy::test_free_orbit {
namespace {

constexpr double kGm = 3.986004415e14, kRadius_m = 6378136.3, kPi = std::numbers::pi;
const GcrsVector kPole{{0.0, 0.0, 1.0}};

struct Ellipse {
  double axis_m, eccentricity, inclination, node, perigee;
};

/// Kepler's ellipse at a mean anomaly (textbook form).
CelestialState on_ellipse(const Ellipse& e, double mean) {
  double anomaly = mean;
  for (int k = 0; k < 50; ++k)
    anomaly -=
        (anomaly - e.eccentricity * std::sin(anomaly) - mean) / (1.0 - e.eccentricity * std::cos(anomaly));
  const double n = std::sqrt(kGm / std::pow(e.axis_m, 3)),
               minor = std::sqrt(1.0 - e.eccentricity * e.eccentricity);
  const double rate = n / (1.0 - e.eccentricity * std::cos(anomaly));
  const double x = e.axis_m * (std::cos(anomaly) - e.eccentricity), y = e.axis_m * minor * std::sin(anomaly);
  const double vx = -e.axis_m * std::sin(anomaly) * rate, vy = e.axis_m * minor * std::cos(anomaly) * rate;
  const double cw = std::cos(e.perigee), sw = std::sin(e.perigee), ci = std::cos(e.inclination),
               si = std::sin(e.inclination), co = std::cos(e.node), so = std::sin(e.node);
  const math::Vec3 p{co * cw - so * sw * ci, so * cw + co * sw * ci, sw * si},
      q{-co * sw - so * cw * ci, -so * sw + co * cw * ci, cw * si};
  return {{math::Point3{} + x * p + y * q}, {vx * p + vy * q}};
}

TEST(FreeOrbit, IsKeplersEllipseAboutAPoint) {
  for (const Ellipse& e : {Ellipse{7.0e6, 0.001, 1.7, 0.3, 1.0}, Ellipse{26.6e6, 0.74, 1.1, 2.0, 4.7}}) {
    const double n = std::sqrt(kGm / std::pow(e.axis_m, 3));
    FreeOrbit orbit(on_ellipse(e, 0.2), kPole, {0.0, 0.0, 0.0});
    for (const double t : {3600.0, 86400.0, -7200.0}) {
      const CelestialState found = orbit.to(t), told = on_ellipse(e, 0.2 + n * t);
      EXPECT_LT(length(found.position - told.position), 1e-4) << t;
      EXPECT_LT(length(found.velocity_m_s - told.velocity_m_s), 1e-7) << t;
    }
  }
}

TEST(FreeOrbit, KeepsItsEnergy) {
  const CelestialState start = on_ellipse({7.2e6, 0.05, 1.2, 0.3, 1.0}, 0.0);
  FreeOrbit orbit(start, kPole);
  const double energy = orbit.energy(start);
  for (int hour = 1; hour <= 24; ++hour)
    EXPECT_NEAR(orbit.energy(orbit.to(3600.0 * hour)), energy, 1e-12 * std::abs(energy)) << hour;
  // Gravity that is not the potential's slope would be seen.
  const FreeOrbit other(start, kPole, {1.0826261738522227e-3, 2.5324105185677225e-6, -1.6198975999169731e-6});
  EXPECT_GT(std::abs(other.energy(orbit.to(1800.0)) - other.energy(start)), 1e-7 * std::abs(energy));
}

/// The nodes of an orbit drift by -3/2 n J2 (a / p)^2 cos i (Kaula 1966, section 3.6), about the pole that there is.
TEST(FreeOrbit, DriftsWithTheEarthsBulge) {
  const GcrsVector tilted{{0.6, 0.0, 0.8}};
  for (const bool tilts : {false, true}) {
    const Ellipse e{7.078e6, 1e-4, 98.2 * kPi / 180.0, 0.5, 0.0};
    CelestialState start = on_ellipse(e, 0.0);
    const auto turned = [&](math::Vec3 v) {  // z to the pole
      return tilts ? math::Vec3{0.8 * v.x + 0.6 * v.z, v.y, -0.6 * v.x + 0.8 * v.z} : v;
    };
    const auto back = [&](math::Vec3 v) {
      return tilts ? math::Vec3{0.8 * v.x - 0.6 * v.z, v.y, 0.6 * v.x + 0.8 * v.z} : v;
    };
    start.position.p = math::Point3{} + turned(start.position.p - math::Point3{});
    start.velocity_m_s.v = turned(start.velocity_m_s.v);
    FreeOrbit orbit(start, tilts ? tilted : kPole);
    const auto node = [&](const CelestialState& s) {
      const math::Vec3 h = back(math::cross(s.position.p - math::Point3{}, s.velocity_m_s.v));
      return std::atan2(h.x, -h.y);
    };
    const double n = std::sqrt(kGm / std::pow(e.axis_m, 3)), turn_s = 2.0 * kPi / n;
    // Means over a turn, 100 turns apart, so that what is periodic falls out.
    const auto mean = [&](int first) {
      double sum = 0.0;
      for (int k = 0; k < 64; ++k) sum += node(orbit.to((first + k / 64.0) * turn_s));
      return sum / 64.0;
    };
    const double before = mean(0), drift = (mean(100) - before) / (100.0 * turn_s);
    const double told =
        -1.5 * n * 1.0826261738522227e-3 * std::pow(kRadius_m / e.axis_m, 2) * std::cos(e.inclination);
    EXPECT_NEAR(drift, told, 4e-3 * told) << "of second order in J2";
    EXPECT_NEAR(drift, 2.0 * kPi / (365.2422 * 86400.0), 0.01 * drift) << "it follows the Sun";
  }
}

TEST(FreeOrbit, SaysWhereItEnds) {
  const auto said = [](const CelestialState& start, double t) -> std::string {
    try {
      FreeOrbit(start, kPole).to(t);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said({{{6000e3, 0.0, 0.0}}, {{0.0, 7e3, 0.0}}}, 1.0),
            "the orbit's position is 6000 km from the Earth's centre, inside the Earth");
  EXPECT_EQ(said({{{6800e3, 0.0, 0.0}}, {{0.0, 6e3, 0.0}}}, 3600.0).substr(0, 26),
            "the orbit meets the ground");
}

}  // namespace
}  // namespace ifov::geodesy::test_free_orbit
