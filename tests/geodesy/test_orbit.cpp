#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.h"
#include "geodesy/geodetic.h"
#include "geodesy/orbit/sgp4_verification.h"
#include "math/angle.h"
#include "support/truth_data.h"

namespace ifov::geodesy::test_orbit {
namespace {

constexpr const char* kFirst = "1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753";
constexpr const char* kSecond = "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667";

// The 33 satellites that Vallado, Crawford, Hujsak and Kelso (2006) verify implementations with.
TEST(Sgp4, VerificationOf2006) {
  const auto elements = test::truth_file("orbit_sun/sgp4/SGP4-VER.TLE"),
             answers = test::truth_file("orbit_sun/sgp4/tcppver.out");
  if (!elements || !answers) GTEST_SKIP() << "reference data not found: orbit_sun/sgp4";
  const auto text = [](const std::filesystem::path& file) {
    std::ostringstream stream;
    stream << std::ifstream(file).rdbuf();
    return stream.str();
  };
  const Sgp4Verification found = verify_sgp4(text(*elements), text(*answers));
  EXPECT_EQ(found.satellites.size(), 33u);
  EXPECT_GT(found.states(), 600u);
  EXPECT_LT(found.farthest_km(), 1e-6);
  EXPECT_LT(found.fastest_km_s(), 1e-8);
  EXPECT_TRUE(found.faults_as_made());
  // Planted faults: an inclination that is 1e-4 degrees off, and a satellite without its fault.
  std::string other = text(*elements);
  other.replace(other.find(" 34.2682 "), 9, " 34.2683 ");
  EXPECT_GT(verify_sgp4(other, text(*answers)).satellites[0].farthest_km, 1e-3);
  Sgp4Verification fewer = found;
  fewer.faults.erase(28872);
  EXPECT_FALSE(fewer.faults_as_made());
}

// Vallado et al. (2006), appendix C: 2004 April 6, 7:51:28.386009 UTC, UT1 - UTC = -0.4399619 s, before polar motion.
TEST(Teme, TurnsWithTheEarth) {
  constexpr double kTold_m = 0.012;  // the paper keeps the date in one number: 20 us
  const UtcTime time = parse_utc("2004-04-06T07:51:28.386009Z");
  const auto ecef = ecef_from_teme(time, {-0.4399619});
  const TemePoint position{{5094180.16210, 6127644.65950, 6380344.53270}};
  const math::Point3 at = ecef(position).p;
  EXPECT_NEAR(at.x, -1033475.03130, kTold_m);
  EXPECT_NEAR(at.y, 7901305.58560, kTold_m);
  EXPECT_NEAR(at.z, 6380344.53270, 1e-9);
  const math::Vec3 moving = ecef_velocity(ecef, position, {{-4746.131487, 785.818041, 5531.931288}}).v;
  EXPECT_NEAR(moving.x, -3225.632747, 3e-5);
  EXPECT_NEAR(moving.y, -2872.442511, 3e-5);
  EXPECT_NEAR(moving.z, 5531.931288, 1e-9);
  // 0.44 s of the Earth's rotation at this radius.
  EXPECT_NEAR(length(ecef_from_teme(time)(position) - ecef(position)),
              0.4399619 * 7.292115e-5 * std::hypot(at.x, at.y), 0.01);
}

constexpr double kArcSecond = math::kDegree / 3600.0;

/// Vallado, Seago and Seidelmann 2006 (AAS 06-134), table of the example: one place in all frames, on 2004 April 6 at 7:51:28.386009 UTC, with
/// UT1 - UTC and the pole of the day. UT1 is that of the paper, whose date is one number.
TEST(Celestial, IsThePublishedPlace) {
  const EarthOrientation day{-0.4399619, -0.140682 * kArcSecond, 0.333309 * kArcSecond};
  const UtcTime time{2453101.827406783, 0.4399619 / 86400.0};
  const EcefPoint itrf{{-1033479.3830, 7901295.2754, 6380356.5958}};
  constexpr double kPrinted_m = 1e-3;  // figures end at 0.1 mm; IAU 2000A and 2006 differ by less
  const auto ecef_from_celestial = ecef_from_gcrs(time, day);
  const PointIn<Gcrs> gcrf = ecef_from_celestial.inverse()(itrf);
  EXPECT_NEAR(gcrf.p.x, 5102508.9592, kPrinted_m);
  EXPECT_NEAR(gcrf.p.y, 6123011.4033, kPrinted_m);
  EXPECT_NEAR(gcrf.p.z, 6378136.9247, kPrinted_m);
  EXPECT_LT(length(ecef_from_celestial(gcrf) - itrf), 1e-8) << "there and back";
  const TemePoint teme = ecef_from_teme(time, day).inverse()(itrf);
  EXPECT_NEAR(teme.p.x, 5094180.1621, kPrinted_m);
  EXPECT_NEAR(teme.p.y, 6127644.6595, kPrinted_m);
  EXPECT_NEAR(teme.p.z, 6380344.5327, kPrinted_m);
  // What is left out is found: the pole, UT1, and one frame taken for the other.
  EXPECT_GT(length(ecef_from_gcrs(time, {-0.4399619})(gcrf) - itrf), 10.0);
  EXPECT_GT(length(ecef_from_gcrs(time, {0.0, day.pole_x_rad, day.pole_y_rad})(gcrf) - itrf), 200.0);
  EXPECT_GT(length(gcrf.p - teme.p), 5000.0);
}

/// SOFA Tools for Earth Attitude (document revision 1.64), section 5.5: 2007 April 5, 12 h UTC, by IAU 2006/2000A angles, there with offsets of the
/// celestial pole of 0.18 and 0.23 milliarcseconds.
TEST(Celestial, IsTheMatrixOfSofa) {
  const auto ecef = ecef_from_gcrs(parse_utc("2007-04-05T12:00:00Z"),
                                   {-0.072073685, 0.0349282 * kArcSecond, 0.4833163 * kArcSecond});
  const double told[3][3] = {{0.973104317697535, 0.230363826239128, -0.000703163482198},
                             {-0.230363800456037, 0.973104570632801, 0.000118545366625},
                             {0.000711560162668, 0.000046626403995, 0.999999745754024}};
  const GcrsVector axes[3] = {{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}};
  for (int column = 0; column < 3; ++column) {
    const math::Vec3 v = ecef(axes[column]).v;
    const double found[3] = {v.x, v.y, v.z};
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(found[row], told[row][column], 1.5e-9) << row << column;
  }
}

std::string complaint(std::string first, std::string second) {
  try {
    parse_two_line_elements(first, second);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TwoLineElements, AreRead) {
  const TwoLineElements elements = parse_two_line_elements(kFirst, kSecond);
  EXPECT_EQ(elements.catalogue_number, 5);
  EXPECT_EQ(format_utc(elements.epoch), "2000-06-27T18:50:19.734Z");
  EXPECT_DOUBLE_EQ(elements.inclination_rad / math::kDegree, 34.2682);
  EXPECT_DOUBLE_EQ(elements.ascending_node_rad / math::kDegree, 348.7242);
  EXPECT_DOUBLE_EQ(elements.eccentricity, 0.1859667);
  EXPECT_DOUBLE_EQ(elements.perigee_argument_rad / math::kDegree, 331.7664);
  EXPECT_DOUBLE_EQ(elements.mean_anomaly_rad / math::kDegree, 19.3264);
  EXPECT_DOUBLE_EQ(elements.mean_motion_rad_min, 10.82419157 * 2.0 * std::numbers::pi / 1440.0);
  EXPECT_DOUBLE_EQ(elements.drag_bstar, 0.28098e-4);
}

TEST(TwoLineElements, MistakesAreExplained) {
  const std::string first = kFirst, second = kSecond;
  EXPECT_EQ(complaint(first.substr(0, 60), second),
            "line 1 of the two-line elements has 60 columns; expected 69");
  EXPECT_EQ(complaint(second, first), "line 1 of the two-line elements begins with '2 '; expected '1 '");
  std::string wrong = second;
  wrong[10] = '9';
  EXPECT_EQ(complaint(first, wrong),
            "line 2 of the two-line elements ends with the checksum '7'; its digits add up to 2");
  wrong = second;
  wrong.replace(2, 5, "00006");
  EXPECT_EQ(complaint(first, with_checksum(wrong)),
            "line 1 of the two-line elements is of satellite 00005, line 2 of satellite 00006");
  wrong = second;
  wrong.replace(8, 8, "234.2682");
  EXPECT_EQ(
      complaint(first, with_checksum(wrong)),
      "columns 9 to 16 of line 2 of the two-line elements: the inclination is 234.2682 deg; expected 0 to 180");
  wrong = second;
  wrong.replace(52, 11, "10.8x419157");
  EXPECT_EQ(
      complaint(first, with_checksum(wrong)),
      "columns 53 to 63 of line 2 of the two-line elements hold '10.8x419157'; expected the mean motion, revolutions a day");
  wrong = first;
  wrong.replace(53, 8, "        ");
  EXPECT_EQ(
      complaint(with_checksum(wrong), second),
      "columns 54 to 61 of line 1 of the two-line elements hold ''; expected the drag term B*, such as 28098-4");
}

}  // namespace
}  // namespace ifov::geodesy::test_orbit
