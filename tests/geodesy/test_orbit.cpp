#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "geodesy/geodetic.h"
#include "geodesy/orbit/sgp4.h"
#include "math/angle.h"
#include "support/truth_data.h"

namespace ifov::geodesy::test_orbit {
namespace {

constexpr const char* kFirst = "1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753";
constexpr const char* kSecond = "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667";

/// Some sets of the verification were made of others by hand, without their checksums.
std::string with_checksum(std::string line) {
  line.resize(69, ' ');
  int sum = 0;
  for (const char symbol : line.substr(0, 68))
    sum += symbol == '-' ? 1 : symbol >= '0' && symbol <= '9' ? symbol - '0' : 0;
  line[68] = static_cast<char>('0' + sum % 10);
  return line;
}

/// A case of the verification that was made to have no position at all.
constexpr int kFailsAtOnce = 33334;

struct Case {
  std::string first, second;
  double stop_min = 0.0;
};

struct Row {
  double minutes, position_km[3], velocity_km_s[3];
};

std::vector<Case> cases(const std::filesystem::path& file) {
  std::vector<Case> found;
  std::ifstream stream(file);
  for (std::string line, first; std::getline(stream, line);) {
    if (line.rfind("1 ", 0) == 0) first = line;
    if (line.rfind("2 ", 0) != 0) continue;
    double start = 0.0, stop = 0.0;
    std::istringstream(line.substr(69)) >> start >> stop;
    found.push_back({with_checksum(first), with_checksum(line), stop});
  }
  return found;
}

/// The rows of each case, in the order of the file.
std::vector<std::vector<Row>> expected(const std::filesystem::path& file) {
  std::vector<std::vector<Row>> found;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.find("xx") != std::string::npos) {
      found.emplace_back();
      continue;
    }
    Row row{};
    std::istringstream words(line);
    words >> row.minutes;
    for (double& x : row.position_km) words >> x;
    for (double& v : row.velocity_km_s) words >> v;
    if (words) found.back().push_back(row);
  }
  return found;
}

// The 33 satellites that Vallado, Crawford, Hujsak and Kelso (2006) verify implementations with.
TEST(Sgp4, VerificationOf2006) {
  const auto elements = test::truth_file("orbit_sun/sgp4/SGP4-VER.TLE"),
             answers = test::truth_file("orbit_sun/sgp4/tcppver.out");
  if (!elements || !answers) GTEST_SKIP() << "reference data not found: orbit_sun/sgp4";
  const std::vector<Case> given = cases(*elements);
  const std::vector<std::vector<Row>> wanted = expected(*answers);
  ASSERT_EQ(given.size(), 33u);
  ASSERT_EQ(wanted.size(), given.size());
  double farthest_km = 0.0, fastest_km_s = 0.0;
  std::size_t rows = 0;
  std::map<int, std::vector<OrbitFault>> faults;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const Sgp4 orbit(parse_two_line_elements(given[k].first, given[k].second));
    const int number = orbit.elements().catalogue_number;
    for (const Row& row : wanted[k]) {
      const OrbitState state = orbit.after_minutes(row.minutes);
      // That program printed here what it had of the satellite before.
      if (number == kFailsAtOnce) break;
      ASSERT_EQ(state.fault, OrbitFault::none) << number << " at " << row.minutes;
      const math::Point3 p = state.position.p;
      const math::Vec3 v = state.velocity_m_s.v;
      const double at[3] = {p.x, p.y, p.z}, moving[3] = {v.x, v.y, v.z};
      for (int axis = 0; axis < 3; ++axis) {
        farthest_km = std::max(farthest_km, std::abs(at[axis] / 1000.0 - row.position_km[axis]));
        fastest_km_s = std::max(fastest_km_s, std::abs(moving[axis] / 1000.0 - row.velocity_km_s[axis]));
      }
      ++rows;
    }
    // The file ends a case at its first fault.
    const double last = wanted[k].back().minutes;
    for (double minutes = last; minutes <= given[k].stop_min; minutes += 1.0) {
      const OrbitFault fault = orbit.after_minutes(minutes).fault;
      if (fault != OrbitFault::none) {
        faults[number].push_back(fault);
        break;
      }
    }
  }
  EXPECT_GT(rows, 600u);
  EXPECT_LT(farthest_km, 1e-6);
  EXPECT_LT(fastest_km_s, 1e-8);
  const std::map<int, std::vector<OrbitFault>> known = {{20413, {OrbitFault::decayed}},
                                                        {22312, {OrbitFault::eccentricity}},
                                                        {28350, {OrbitFault::eccentricity}},
                                                        {28872, {OrbitFault::decayed}},
                                                        {29141, {OrbitFault::decayed}},
                                                        {33333, {OrbitFault::semi_latus_rectum}},
                                                        {kFailsAtOnce, {OrbitFault::perturbed_eccentricity}}};
  EXPECT_EQ(faults, known);
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
