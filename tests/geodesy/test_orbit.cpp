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
  const auto ecef = ecef_from_teme(time, -0.4399619);
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
