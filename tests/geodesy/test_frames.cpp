#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "core/error.h"
#include "geodesy/attitude.h"
#include "geodesy/geodetic.h"

namespace ifov::geodesy::test_frames {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Geodetic place(double latitude_deg, double longitude_deg, double height_m) {
  return {latitude_deg * kDegree, longitude_deg * kDegree, height_m};
}

// A point of one frame is no point of another, nor a vector; a transform takes its own source alone.
static_assert(!std::is_convertible_v<EcefPoint, EnuPoint>);
static_assert(!std::is_convertible_v<EnuPoint, EnuVector>);
static_assert(std::is_invocable_v<FrameTransform<Ecef, Enu>, EnuPoint>);
static_assert(!std::is_invocable_v<FrameTransform<Ecef, Enu>, EcefPoint>);
static_assert(!std::is_invocable_v<FrameTransform<Ecef, Enu>, BodyVector>);

// PROJ 9.1.1: +proj=cart +ellps=WGS84, and +proj=topocentric +ellps=WGS84 about 52.0116 N, 4.3571 E, 45 m.
TEST(Frames, PlacesAreWhereProjHasThem) {
  const struct {
    Geodetic place;
    math::Point3 ecef_m, enu_m;
  } cases[] = {
      {place(39.742476, -105.1786, 1830.14),
       {-1286219.235019, -4741071.253184, 4057210.569472},
       {-4629651.909545, 3812641.045757, -4178356.590144}},
      {place(52.0116, 4.3571, 45.0), {3922601.488985, 298873.482417, 5003633.344463}, {0.0, 0.0, 0.0}},
      {place(-33.8568, 151.2153, -12.5),
       {-4646959.539607, 2553071.921809, -3533260.163501},
       {2898734.310166, 1345006.621329, -11882156.125084}},
      {place(0.0, 179.99, 0.0),
       {-6378136.902855, 1113.194902, 0.0},
       {485672.774216, 5032996.530790, -10279264.911909}},
      {place(89.9999, 0.0, 500e3),
       {12.042063, 0.0, 6856752.314235},
       {-0.914865, 4241090.565524, -960850.695347}},
      {place(-24.6, -70.4, 700e3),
       {2159994.268755, -6065968.629610, -2930249.324352},
       {-6212537.563346, -3117056.715058, -7632354.026477}}};
  const auto enu_from_ecef = ecef_from_enu(place(52.0116, 4.3571, 45.0)).inverse();
  for (const auto& c : cases) {
    const EcefPoint ecef = ecef_from_geodetic(c.place);
    EXPECT_LT(length(ecef - EcefPoint{c.ecef_m}), 2e-6) << c.place.latitude_rad / kDegree;
    EXPECT_LT(length(enu_from_ecef(ecef) - EnuPoint{c.enu_m}), 2e-6) << c.place.latitude_rad / kDegree;
  }
}

// ERFA's one step of Halley's method leaves micrometres up to low orbits, and 1 mm at the geostationary one.
TEST(Frames, ThereAndBack) {
  const auto ecef_from_scene = ecef_from_enu(place(52.0116, 4.3571, 45.0));
  for (const double height_m : {-400.0, 0.0, 9000.0, 500e3, 800e3, 36e6})
    for (const double latitude_deg : {-90.0, -89.9999, -35.0, 0.0, 1e-9, 52.0, 90.0})
      for (const double longitude_deg : {-179.999, -70.0, 0.0, 4.4, 180.0}) {
        const double within_m = height_m <= 500e3 ? 1e-6 : height_m <= 800e3 ? 5e-6 : 1e-3;
        const EcefPoint ecef = ecef_from_geodetic(place(latitude_deg, longitude_deg, height_m));
        EXPECT_LT(length(ecef_from_geodetic(geodetic_from_ecef(ecef)) - ecef), within_m)
            << latitude_deg << ' ' << longitude_deg << ' ' << height_m;
        EXPECT_NEAR(geodetic_from_ecef(ecef).height_m, height_m, within_m);
        const EnuPoint scene = ecef_from_scene.inverse()(ecef);
        EXPECT_LT(length(ecef_from_scene(scene) - ecef), 1e-7);
      }
}

TEST(Frames, LocalAxes) {
  const auto frame = ecef_from_enu(place(0.0, 90.0, 0.0));  // in the Indian ocean
  EXPECT_LT(length(frame(EnuVector{{1.0, 0.0, 0.0}}) - EcefVector{{-1.0, 0.0, 0.0}}), 1e-15);
  EXPECT_LT(length(frame(EnuVector{{0.0, 1.0, 0.0}}) - EcefVector{{0.0, 0.0, 1.0}}), 1e-15);
  EXPECT_LT(length(frame(EnuVector{{0.0, 0.0, 1.0}}) - EcefVector{{0.0, 1.0, 0.0}}), 1e-15);
  EXPECT_LT(length(frame(EnuPoint{{0.0, 0.0, 100.0}}) - ecef_from_geodetic(place(0.0, 90.0, 100.0))), 1e-8);
}

// A satellite's camera, from its body to the scene of a place it sees: one transform after the other is their product.
TEST(Frames, TransformsChain) {
  const auto ecef_from_scene = ecef_from_enu(place(52.0, 4.0, 0.0));
  const auto ecef_from_nadir = ecef_from_enu(place(50.0, 7.0, 700e3));
  const auto nadir_from_body = enu_from_body({0.4, -0.1, 0.2});
  const auto scene_from_body = ecef_from_scene.inverse() * ecef_from_nadir * nadir_from_body;
  static_assert(std::is_same_v<decltype(scene_from_body), const FrameTransform<Enu, Body>>);
  const BodyPoint lens{{1.5, -0.5, 0.25}};
  const EnuPoint by_steps = ecef_from_scene.inverse()(ecef_from_nadir(nadir_from_body(lens)));
  EXPECT_LT(length(scene_from_body(lens) - by_steps), 1e-8);
  EXPECT_LT(length(scene_from_body.inverse()(by_steps) - lens), 1e-8);
  EXPECT_NEAR(length(scene_from_body(BodyVector{{3.0, 4.0, 12.0}})), 13.0, 1e-12);
}

TEST(Frames, AttitudeTurnsABody) {
  const auto level = enu_from_body({});
  EXPECT_EQ(level.x().v, (math::Vec3{0.0, 1.0, 0.0}));   // the nose to the north
  EXPECT_EQ(level.y().v, (math::Vec3{1.0, 0.0, 0.0}));   // the right wing to the east
  EXPECT_EQ(level.z().v, (math::Vec3{0.0, 0.0, -1.0}));  // the belly down
  const auto turned = enu_from_body({90.0 * kDegree, 30.0 * kDegree, 0.0});
  EXPECT_NEAR(turned.x().v.x, std::cos(30.0 * kDegree), 1e-15);  // east
  EXPECT_NEAR(turned.x().v.z, 0.5, 1e-15);                       // nose up
  const auto rolled = enu_from_body({0.0, 0.0, 10.0 * kDegree});
  EXPECT_NEAR(rolled.y().v.z, -std::sin(10.0 * kDegree), 1e-15);  // right wing down
  for (const Attitude& attitude : {Attitude{0.3, -0.2, 1.1}, Attitude{-3.0, 1.5, -2.0}}) {
    const auto frame = enu_from_body(attitude);
    EXPECT_LT(length(cross(frame.x(), frame.y()) - frame.z()), 1e-15);
    EXPECT_NEAR(dot(frame.x(), frame.y()), 0.0, 1e-15);
  }
}

TEST(Frames, WhatIsNoPlace) {
  const auto error_of = [](const auto& ask) {
    try {
      ask();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  EXPECT_EQ(error_of([] { ecef_from_geodetic(place(91.0, 0.0, 0.0)); }),
            "a latitude of 91 degrees is beyond the poles");
  EXPECT_EQ(error_of([] { ecef_from_geodetic(place(std::nan(""), 0.0, 0.0)); }),
            "a latitude of nan degrees is beyond the poles");
  EXPECT_EQ(error_of([] {
              geodetic_from_ecef({{std::nan(""), 0.0, 0.0}});
            }),
            "a position about the Earth is not finite");
}

}  // namespace
}  // namespace ifov::geodesy::test_frames
