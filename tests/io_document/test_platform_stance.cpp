#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/format.h"
#include "document_maker.h"
#include "geodesy/geodetic.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/flight_motion.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/cameras/jitter_table.h"
#include "io/document/platform_document.h"
#include "platform/trajectory.h"
#include "sensor/camera.h"

namespace ifov::io {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kEarthTurn_rad_s = 7.292115146706979e-5;

class PlatformStances : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("ifov_stances_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  Document document(const std::string& platform,
                    const std::string& origin = R"({"latitude": "0 deg", "longitude": "0 deg"})") const {
    return parse_document(
        "{\"ifov\": 1, \"seed\": 5, \"scene\": {\"origin\": " + origin +
            R"(, "materials": {"a": {"reflectance": 0.2}}, "objects": [{"plane": {}, "material": "a"}]},)" +
            "\n\"platform\": " + platform + ",\n" +
            R"("sensor": {"camera": {"pushbroom": {"pixels": [21, 20], "field_of_view": "1 deg", "line_period": "20 ms"}},
            "channels": [{"monochromatic": {"at": "0.6 um"}}]}})",
        (folder_ / "a.json").string());
  }
  std::unique_ptr<sensor::Camera> camera(const Document& document) const {
    return document.sensor.camera.settings->build({document.scene.origin.offset_m, 0.0});
  }
  platform::Trajectory path(const std::string& text) const {
    const Document of = document(text);
    return trajectory_of({*of.platform, of.time, of.scene.origin}, {}, -5.0, 5.0);
  }
  std::string message(const std::string& platform) const {
    try {
      camera(document(platform));
    } catch (const InputError& error) {
      std::string what = error.what();
      what = what.substr(0, what.find('\n'));
      for (std::size_t at = 0; (at = what.find(folder_.string() + "/")) != std::string::npos;)
        what.erase(at, folder_.string().size() + 1);
      return what;
    }
    return "taken";
  }

  /// A circular orbit at 705 km, inclined by 98.2 deg, whose argument of latitude is `u_deg` over longitude 0 at 0 s.
  static constexpr double kRadius_m = 7083137.0, kInclination_rad = 98.2 * kDegree;
  static double mean_motion() { return std::sqrt(3.986004418e14 / (kRadius_m * kRadius_m * kRadius_m)); }
  void write_orbit(const std::string& name, double u_deg) const {
    std::string text = "time_s,x_m,y_m,z_m\n";
    for (int k = -10; k <= 10; ++k) {
      const double u = u_deg * kDegree + mean_motion() * k, turn = kEarthTurn_rad_s * k;
      const double x = kRadius_m * std::cos(u), y = kRadius_m * std::sin(u) * std::cos(kInclination_rad);
      text += format("{},{:.6f},{:.6f},{:.6f}\n", k, x * std::cos(turn) + y * std::sin(turn),
                     y * std::cos(turn) - x * std::sin(turn),
                     kRadius_m * std::sin(u) * std::sin(kInclination_rad));
    }
    write(name, text);
  }

  std::filesystem::path folder_;
};

std::string straight(const std::string& more) {
  return R"({"straight": {"frame": "scene", "position": ["0 m", "-10 m", "1 km"], "velocity": ["0 m/s", "50 m/s", "0 m/s"]})" +
         (more.empty() ? "" : ", " + more) + "}";
}
std::string table(const std::string& more) {
  return R"({"table": {"frame": "ecef", "file": "orbit.csv"}, "attitude": {)" + more + "}}";
}

double angle(math::Vec3 a, math::Vec3 b) {
  return std::atan2(math::length(math::cross(a, b)), math::dot(a, b));
}

/// tan(psi) = sin i cos u / (n / omega - cos i): how far the track over the turning Earth leans from that of a circular orbit.
TEST_F(PlatformStances, YawSteeringTurnsAsTheEarthDoes) {
  for (const double u_deg : {0.0, 40.0}) {
    write_orbit("orbit.csv", u_deg);
    const double u = u_deg * kDegree;
    const double expected = std::atan2(std::sin(kInclination_rad) * std::cos(u),
                                       mean_motion() / kEarthTurn_rad_s - std::cos(kInclination_rad));
    const auto orbit = path(table(R"("axes": "geocentric", "from": "orbit")")).pose(0.0).enu_from_body,
               steered = path(table(R"("axes": "geocentric", "from": "track")")).pose(0.0).enu_from_body;
    EXPECT_NEAR(angle(orbit.x().v, steered.x().v), expected, 1e-8) << u_deg;
    EXPECT_NEAR(expected / kDegree, u_deg == 0.0 ? 3.86 : 2.96, 0.01);
    EXPECT_NEAR(angle(orbit.z().v, steered.z().v), 0.0, 1e-9);
    // What it flies over stays in its column: the ground's velocity against the nose, along the right wing.
    EXPECT_NEAR(math::dot(path(table("")).pose(0.0).velocity_m_s, steered.y().v), 0.0, 1e-2);
  }
}

/// A vertical leans from the radius by geodetic less geocentric latitude.
TEST_F(PlatformStances, NadirIsNotTheEarthsCentre) {
  write_orbit("orbit.csv", 45.0);
  const auto nadir = path(table(R"("axes": "nadir")")).pose(0.0).enu_from_body,
             usual = path(table("")).pose(0.0).enu_from_body,
             centre = path(table(R"("axes": "geocentric")")).pose(0.0).enu_from_body,
             orbit = path(table(R"("from": "orbit")")).pose(0.0).enu_from_body;
  const double u = 45.0 * kDegree;
  const geodesy::EcefPoint place{{kRadius_m * std::cos(u),
                                  kRadius_m * std::sin(u) * std::cos(kInclination_rad),
                                  kRadius_m * std::sin(u) * std::sin(kInclination_rad)}};
  const double geocentric = std::asin(place.p.z / kRadius_m);
  const double leans = geodesy::geodetic_from_ecef(place).latitude_rad - geocentric;
  EXPECT_GT(leans, 2e-3);
  EXPECT_NEAR(angle(nadir.z().v, centre.z().v), leans, 1e-9);
  EXPECT_NEAR(angle(nadir.z().v, orbit.z().v), 0.0, 1e-9);
  EXPECT_NEAR(angle(nadir.x().v, usual.x().v), 0.0, 1e-15);
  // On a circular orbit the velocity is level to the radius, and so is the nose that follows it.
  const auto along = path(table(R"("axes": "velocity", "from": "orbit")")).pose(0.0).enu_from_body;
  EXPECT_NEAR(math::dot(along.x().v, centre.z().v), 0.0, 1e-7);
  EXPECT_NEAR(angle(along.x().v,
                    path(table(R"("axes": "geocentric", "from": "orbit")")).pose(0.0).enu_from_body.x().v),
              0.0, 1e-7);
}

TEST_F(PlatformStances, LooksAtAPointOfTheScene) {
  const std::string looking =
      straight(R"("attitude": {"look_at": {"frame": "scene", "position": ["40 m", "30 m", "5 m"]}})");
  const platform::Trajectory flight = path(looking);
  for (const double t : {-5.0, 0.1, 3.0}) {
    const platform::Pose pose = flight.pose(t);
    EXPECT_NEAR(angle(pose.enu_from_body.z().v, math::Point3{40.0, 30.0, 5.0} - pose.position_m), 0.0, 1e-12);
  }
  EXPECT_EQ(message(looking).substr(0, 37), "line 1 of the scanner looks 0.00537 m")
      << "all lines see one place";
}

TEST_F(PlatformStances, MountsShiftAndTurnTheCamera) {
  const auto seen = camera(document(
      straight(R"("mount": {"lever_arm": ["2 m", "0.5 m", "1 m"], "roll": "1 deg", "pitch": "0.5 deg"})")));
  const math::Ray ray = seen->ray({10.5, 10.0});
  EXPECT_NEAR(math::length(ray.origin_m - math::Point3{0.5, 2.0, 999.0}), 0.0, 1e-9)
      << "nose north, right wing east";
  // Nose up: the belly looks ahead; right wing down: it looks to the left.
  EXPECT_NEAR(ray.direction.x, -std::sin(1.0 * kDegree), 1e-9);
  EXPECT_NEAR(ray.direction.y, std::sin(0.5 * kDegree) * std::cos(1.0 * kDegree), 1e-9);
}

TEST_F(PlatformStances, ReportWhatIsNotTrue) {
  const Document of = document(straight(
      R"("mount": {"lever_arm": ["0 m", "0 m", "1 m"], "roll": "1 deg"}, "jitter": {"white": {"roll": "0.01 mrad", "up_to": "20 Hz"}},
         "reported": {"position_bias": ["3 m", "0 m", "-2 m"], "attitude_bias": {"pitch": "0.1 deg"}, "mount": {"roll": "0.9 deg"}})"));
  const auto seen = camera(of);
  ASSERT_NE(&seen->reported(), seen.get());
  const math::Ray ray = seen->reported().ray({10.5, 10.0}), truth = seen->ray({10.5, 10.0});
  EXPECT_NEAR(math::length(ray.origin_m - math::Point3{3.0, 0.0, 998.0}), 0.0, 1e-9);
  EXPECT_NEAR(
      angle(ray.direction, {-std::sin(0.9 * kDegree), std::sin(0.1 * kDegree) * std::cos(0.9 * kDegree),
                            -std::cos(0.1 * kDegree) * std::cos(0.9 * kDegree)}),
      0.0, 1e-9)
      << "without jitter";
  EXPECT_NEAR(truth.direction.x, -std::sin(1.0 * kDegree), 1e-4);
  EXPECT_GT(std::abs(truth.direction.x + std::sin(1.0 * kDegree)), 1e-9) << "with it";
  const auto known = camera(document(straight("")));
  EXPECT_EQ(&known->reported(), known.get());
}

/// Noise has its standard deviations: of 400 places 2 s apart, of noise up to 1 Hz, each within 4 of its own standard deviations.
TEST_F(PlatformStances, ReportNoise) {
  const Document of = document(straight(
      R"("reported": {"position_noise": ["2 m", "0 m", "5 m"], "attitude_noise": {"yaw": "0.2 mrad"}})"));
  const Motions motions = motions_of({*of.platform, of.time, of.scene.origin, 5}, {}, 0.0, 800.0, 0.0);
  EXPECT_EQ(motions.truth->pose(3.0).position_m.z, 1000.0);
  double x = 0.0, y = 0.0, z = 0.0, yaw = 0.0;
  for (int k = 0; k < 400; ++k) {
    const platform::Pose pose = motions.reported->pose(2.0 * k);
    x += pose.position_m.x * pose.position_m.x, z += std::pow(pose.position_m.z - 1000.0, 2);
    y += std::abs(pose.position_m.y - (100.0 * k - 10.0)), yaw += std::pow(pose.enu_from_body.x().v.x, 2);
  }
  const double four = 4.0 / std::sqrt(2.0 * 400.0);
  EXPECT_NEAR(std::sqrt(x / 400.0), 2.0, 2.0 * four);
  EXPECT_NEAR(std::sqrt(z / 400.0), 5.0, 5.0 * four);
  EXPECT_NEAR(std::sqrt(yaw / 400.0), 2e-4, 2e-4 * four);
  EXPECT_NEAR(y, 0.0, 1e-6);
}

TEST_F(PlatformStances, JitterIsOfTheSeedAndTheTime) {
  const std::string jitter =
      R"("jitter": {"falling": {"yaw": "0.1 mrad", "pitch": "0.02 mrad", "corner": "5 Hz", "slope": 2, "up_to": "20 Hz"}})";
  const Document of = document(straight(jitter));
  const auto noses = [&](std::uint64_t seed, double from_s, double to_s) {
    return motions_of({*of.platform, of.time, of.scene.origin, seed}, {}, from_s, to_s, 0.0)
        .truth->pose(0.5)
        .enu_from_body.x()
        .v;
  };
  const math::Vec3 one = noses(5, 0.0, 1.0);
  EXPECT_LT(math::length(noses(5, -3.0, 40.0) - one), 1e-12) << "whatever is drawn around it";
  EXPECT_GT(math::length(noses(6, 0.0, 1.0) - one), 1e-6);
  EXPECT_GT(std::abs(one.x), 1e-6);
  EXPECT_LT(math::length(one - math::Vec3{0.0, 1.0, 0.0}), 6e-4);
  const sensor::CameraPose at = camera(of)->pose(25.0);
  EXPECT_LT(math::length(at.axes.down - one), 1e-12) << "0.5 s are line 25, and the document's seed is 5";
}

TEST_F(PlatformStances, JitterOfATable) {
  write("j.csv", "# of a gimbal\nfrequency_hz,roll_rad2_hz\n1,1e-12\n3,1e-12\n5,0\n");
  const JitterSpectra spectra = read_jitter_table(folder_ / "j.csv");
  EXPECT_NEAR(spectra.roll.rms(), std::sqrt(3e-12), 1e-12);
  EXPECT_EQ(spectra.yaw.rms(), 0.0);
  EXPECT_EQ(message(straight(R"("jitter": {"table": {"file": "j.csv"}})")), "taken");
  const auto said = [&](const std::string& text) {
    write("j.csv", text);
    return message(straight(R"("jitter": {"table": {"file": "j.csv"}})"));
  };
  EXPECT_EQ(
      said("frequency_hz,rol_rad2_hz\n"),
      "j.csv:1:14: found the heading 'rol_rad2_hz'; expected 'frequency_hz', 'yaw_rad2_hz', 'pitch_rad2_hz' or 'roll_rad2_hz'; "
      "did you mean 'roll_rad2_hz'?");
  EXPECT_EQ(said("roll_rad2_hz\n"), "j.csv:1: the table has no column 'frequency_hz'");
  EXPECT_EQ(
      said("frequency_hz\n"),
      "j.csv:1: the table has no column of a power: expected 'yaw_rad2_hz', 'pitch_rad2_hz' or 'roll_rad2_hz'");
  EXPECT_EQ(said("frequency_hz,roll_rad2_hz\n1,2e-12\n1,2e-12\n"),
            "j.csv:3:1: found the frequency 1 Hz after 1 Hz; expected frequencies that increase");
  EXPECT_EQ(said("frequency_hz,roll_rad2_hz\n1,-2\n"),
            "j.csv:2:3: found -2 as 'roll_rad2_hz'; expected 0 to 1");
  EXPECT_EQ(said("frequency_hz,roll_rad2_hz\n1,much\n"),
            "j.csv:2:3: found 'much' as 'roll_rad2_hz'; expected a number");
  EXPECT_EQ(said("frequency_hz,roll_rad2_hz\n1\n"),
            "j.csv:2: found 1 values; expected 2, as the heading has");
  EXPECT_EQ(said("frequency_hz,roll_rad2_hz\n1,1\n"), "j.csv: found 1 rows; expected two at least");
  EXPECT_EQ(said("# nothing\n"), "j.csv: found an empty file; expected a table of power densities");
}

TEST_F(PlatformStances, Messages) {
  EXPECT_EQ(
      message(straight(R"("attitude": {"axes": "geocentric"})")),
      "a.json:2:13: 'axes' that are \"geocentric\" need a path about the Earth: in the scene's frame the ground is flat, expected "
      "\"nadir\"");
  EXPECT_EQ(message(straight(R"("attitude": {"from": "orbit"})")),
            "a.json:2:13: 'from' \"orbit\" needs a path about the Earth, expected \"track\" or \"north\"");
  EXPECT_EQ(
      message(straight(R"("attitude": {"axes": "velocity", "from": "north"})")),
      "a.json:2:13: 'axes' along the velocity have their nose there, and 'from' says north; expected one of both");
  EXPECT_EQ(
      message(straight(R"("attitude": {"look_at": {"position": ["0 m", "0 m", "0 m"]}})")).substr(0, 13),
      "a.json:2:150:");
  EXPECT_EQ(message(straight(R"("jitter": {"white": {"roll": "1 mrad"}})")).substr(0, 7), "a.json:");
  EXPECT_EQ(message(straight(R"("jitter": {"white": {"pitch": "20 mrad", "up_to": "100 Hz"}})")).substr(0, 5),
            "line ")
      << "ground is seen twice";
}

}  // namespace
}  // namespace ifov::io
