#include <cmath>

#include "flown_document.h"
#include "geodesy/geodetic.h"
#include "geodesy/line_of_sight.h"
#include "geodesy/orbit/sgp4.h"
#include "geodesy/orbit/teme.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/platform_document.h"
#include "platform/trajectory.h"

namespace ifov::io::test_platform {
namespace {

class Platforms : public FlownDocument {};

TEST_F(Platforms, CarryTheDocumentsCamera) {
  const Document straight = document(text(kStraight));
  const math::Point3 seen = on_ground(camera(straight)->ray({10.5, 10.0}));
  EXPECT_NEAR(seen.x, 0.0, 1e-9);
  EXPECT_NEAR(seen.y, 0.0, 1e-9);
  EXPECT_EQ(
      straight.sensor.camera.settings->description({}, "x, y, z"),
      "pushbroom, 21 x 20 pixels, 1 deg across, a line every 20 ms, straight from x, y, z 0, -10, 1000 m at 50 m/s");
  const auto small = straight.sensor.camera.settings->shrunk(7)->build({});
  EXPECT_EQ(small->width_px(), 7);
  EXPECT_EQ(small->height_px(), 7);
  EXPECT_NEAR(length(on_ground(small->ray({7.0, 7.0})) - on_ground(camera(straight)->ray({21.0, 20.0}))), 0.0,
              1e-9)
      << "the same field of view in the same time";
  // The scene's own coordinates are map coordinates.
  const Document mapped = document(text(
      R"({"way_points": {"frame": "scene", "points": [{"time": "-1 s", "position": ["500010 m", "4000000 m", "500 m"]},
                {"time": "1 s", "position": ["500110 m", "4000000 m", "500 m"]}]}})",
      kPushbroom, R"({"easting": "500000 m", "northing": "4000000 m"})"));
  const math::Ray east = camera(mapped)->ray({10.5, 5.0});
  EXPECT_NEAR(length(east.origin_m - math::Point3{65.0, 0.0, 500.0}), 0.0, 1e-9);
  EXPECT_NEAR(camera(mapped)->pose(0.0).axes.down.x, 1.0, 1e-12) << "the nose along the track";
}

/// By closed forms: where it is, and which ground the middle of its image shows.
TEST_F(Platforms, CircleAndStand) {
  const auto path = [&](const std::string& platform) {
    const Document d = document(text(platform));
    return trajectory_of({*d.platform, d.time, d.scene.origin}, {}, 0.0, 1.0);
  };
  const std::string circle =
      R"({"circling": {"frame": "scene", "center": ["10 m", "20 m", "500 m"], "radius": "300 m", "speed": "30 m/s", "start": "90 deg")";
  // East of the middle and turning to the right: south. A quarter turn takes pi/2 300/30 s.
  const auto right = path(circle + "}}");
  EXPECT_LT(length(right.pose(0.0).position_m - math::Point3{310.0, 20.0, 500.0}), 1e-9);
  EXPECT_LT(length(right.pose(0.0).velocity_m_s - math::Vec3{0.0, -30.0, 0.0}), 1e-9);
  EXPECT_LT(length(right.pose(5.0 * std::numbers::pi).position_m - math::Point3{10.0, -280.0, 500.0}), 1e-9);
  EXPECT_LT(length(right.pose(0.0).enu_from_body.z().v - math::Vec3{0.0, 0.0, -1.0}), 1e-12)
      << "level unless said otherwise";
  const auto left = path(circle + R"(, "direction": "counterclockwise", "bank": "coordinated"}})");
  EXPECT_LT(length(left.pose(0.0).velocity_m_s - math::Vec3{0.0, 30.0, 0.0}), 1e-9);
  // Its left wing, to the west, is down: 30^2 / (9.80665 300) is the tangent.
  const double bank = std::atan(900.0 / (9.80665 * 300.0));
  EXPECT_LT(length(left.pose(0.0).enu_from_body.y().v - math::Vec3{std::cos(bank), 0.0, std::sin(bank)}),
            1e-12);
  EXPECT_LT(
      length(
          path(
              R"({"circling": {"frame": "scene", "center": ["0 m", "0 m", "1 m"], "radius": "2 m", "period": "8 s"}})")
              .pose(2.0)
              .position_m -
          math::Point3{2.0, 0.0, 1.0}),
      1e-12);
  // About a place on Earth.
  const geodesy::Geodetic there{52.01 * kDegree, 4.38 * kDegree, 700.0};
  const math::Point3 expected = geodesy::ecef_from_enu({52.0 * kDegree, 4.4 * kDegree, 0.0})
                                    .inverse()(geodesy::ecef_from_geodetic(there))
                                    .p;
  const std::string geodetic =
      R"("frame": "geodetic", "latitude": "52.01 deg", "longitude": "4.38 deg", "height": "700 m")";
  const auto around = path("{\"circling\": {" + geodetic + R"(, "radius": "50 m", "period": "10 s"}})");
  EXPECT_LT(length(around.pose(5.0).position_m - (expected + math::Vec3{0.0, -50.0, 0.0})), 1e-6);
  const auto fixed = path("{\"fixed\": {" + geodetic + "}}");
  for (const double t : {-1e6, 0.0, 1e6}) EXPECT_LT(length(fixed.pose(t).position_m - expected), 1e-6);
  // Level where it stands, 0.0116 degrees from level at the origin.
  const auto up = geodesy::ecef_from_enu({52.0 * kDegree, 4.4 * kDegree, 0.0})
                      .inverse()(geodesy::ecef_from_enu(there).z());
  EXPECT_LT(length(fixed.pose(0.0).enu_from_body.z().v + up.v), 1e-12);
  EXPECT_GT(length(fixed.pose(0.0).enu_from_body.z().v + math::Vec3{0.0, 0.0, 1.0}), 1e-4);
  // A camera on a mast, by both of its names.
  const std::string frame = R"({"frame": {"pixels": [20, 20], "focal_length": "20 mm", "pitch": "10 um")";
  const Document mast = document(text(
      R"({"fixed": {"frame": "scene", "position": ["3 m", "4 m", "50 m"]}, "attitude": {"yaw": "30 deg", "pitch": "20 deg"}})",
      frame + "}}"));
  EXPECT_EQ(mast.sensor.camera.settings->description({}, "x, y, z"),
            "frame, 20 x 20 pixels, 0.573 x 0.573 deg, fixed at x, y, z 3, 4, 50 m");
  const math::Point3 seen = on_ground(camera(mast)->ray({10.0, 10.0}));
  EXPECT_NEAR(seen.x, 3.0 + 50.0 * std::tan(20.0 * kDegree) * std::sin(30.0 * kDegree), 1e-9);
  EXPECT_NEAR(seen.y, 4.0 + 50.0 * std::tan(20.0 * kDegree) * std::cos(30.0 * kDegree), 1e-9);
  EXPECT_EQ(
      document(text(circle + "}}", frame + "}}")).sensor.camera.settings->description({}, "x, y, z"),
      "frame, 20 x 20 pixels, 0.573 x 0.573 deg, circling clockwise at 300 m from x, y, z 10, 20, 500 m, 30 m/s");
}

TEST_F(Platforms, MessagesOfCirclesAndFixedPlaces) {
  const auto circle = [&](const std::string& more, const std::string& after = "") {
    return message(
        text(R"({"circling": {"frame": "scene", "center": ["0 m", "0 m", "500 m"], "radius": "300 m")" +
             more + "}" + after + "}"));
  };
  const std::string speed = R"(, "speed": "30 m/s")";
  EXPECT_EQ(circle(speed), "taken");
  EXPECT_EQ(circle(""), "a.json:4:26: 'platform.circling' needs exactly one of 'speed' or 'period'");
  EXPECT_EQ(
      circle(speed + R"(, "period": "60 s")"),
      "a.json:4:118: 'period' cannot stand beside 'speed': 'platform.circling' takes only one of 'speed' or 'period'");
  EXPECT_EQ(circle(speed + R"(, "latitude": "52 deg")"),
            "a.json:4:36: a point in this frame is told by its 'center' alone");
  EXPECT_EQ(
      circle(R"(, "speed": "0 m/s")"),
      "a.json:4:108: 'platform.circling.speed' is the text \"0 m/s\", expected a speed above 0 m/s, such as \"3 m/s\" (units: m/s, km/h, kn)");
  EXPECT_EQ(
      circle(speed + R"(, "direction": "left")"),
      "a.json:4:131: 'platform.circling.direction' is the text \"left\", expected 'clockwise' or 'counterclockwise'");
  EXPECT_EQ(
      circle(speed + R"(, "bank": "coordinated")", R"(, "attitude": {"from": "north"})"),
      "a.json:4:13: 'bank' is about a nose along the track, and 'from' says north; expected one of both");
  EXPECT_EQ(
      circle(speed + R"(, "bank": "coordinated")",
             R"(, "attitude": {"look_at": {"frame": "scene", "position": ["0 m", "0 m", "0 m"]}})"),
      "a.json:4:13: 'bank' is of wings, and 'look_at' turns the belly to a point: expected one of both (a 'mount' with a 'gimbal' looks at a point from banked wings)");
  EXPECT_EQ(circle(speed, R"(, "attitude": {"from": "orbit"})"),
            "a.json:4:13: 'from' \"orbit\" needs a path about the Earth, expected \"track\" or \"north\"");
  EXPECT_EQ(
      circle(speed, R"(, "attitude": {"axes": "geocentric"})"),
      "a.json:4:13: a circle is level in the scene, whose ground is flat: expected 'axes' \"nadir\" or \"velocity\"");
  const std::string fixed = R"({"fixed": {"frame": "scene", "position": ["0 m", "0 m", "50 m"]})";
  EXPECT_EQ(
      message(text(fixed + R"(, "attitude": {"from": "track"}})")),
      "a.json:4:13: what is fixed flies nowhere, so that its nose cannot be along its track or velocity: expected 'from' \"north\", and other 'axes'");
  EXPECT_EQ(
      message(text(fixed + R"(, "attitude": {"axes": "velocity"}})")),
      "a.json:4:13: what is fixed flies nowhere, so that its nose cannot be along its track or velocity: expected 'from' \"north\", and other 'axes'");
  EXPECT_EQ(message(text(R"({"fixed": {"frame": "geodetic", "position": ["0 m", "0 m", "50 m"]}})")),
            "a.json:4:33: a geodetic point is told by 'longitude', 'latitude' and 'height'");
  EXPECT_EQ(
      message(text(R"({"fixed": {"frame": "ecef", "position": ["4000 km", "0 m", "5000 km"]}})", kPushbroom,
                   "{}")),
      "a.json:4:13: a path about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and 'longitude'");
  const std::string frame = R"({"frame": {"pixels": [20, 20], "focal_length": "20 mm", "pitch": "10 um"}})";
  EXPECT_EQ(
      message(text(
          R"({"fixed": {"frame": "geodetic", "latitude": "-52 deg", "longitude": "4.4 deg", "height": "50 m"}})",
          frame)),
      "the platform is 52.0 degrees below the scene's horizon, over latitude -52.0000, longitude 4.4000 deg");
  EXPECT_EQ(
      message(text(
          R"({"fixed": {"frame": "geodetic", "latitude": "52.001 deg", "longitude": "4.4 deg", "height": "-10 m"}})",
          frame)),
      "taken")
      << "in a valley";
  EXPECT_EQ(
      message(text(fixed + "}")),
      "line 1 of the scanner looks 0 m behind line 0: the platform stands still, flies backwards or turns back faster than it flies, and the same ground would be seen more than once");
}

// Vallado et al. 2006, verification satellite 6251 ("Near earth normal drag").
const std::string kSatellite =
    "DELTA 1 DEB\n"
    "1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985\n"
    "2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774\n";

TEST_F(Platforms, FollowSgp4) {
  write("a.tle", kSatellite);
  const geodesy::Sgp4 orbit(
      geodesy::parse_two_line_elements(kSatellite.substr(12, 69), kSatellite.substr(82, 69)));
  const geodesy::UtcTime time = geodesy::parse_utc("2006-06-25T21:00:00Z");
  const auto place = [&](double t_s) {
    const geodesy::UtcTime then{time.jd1, time.jd2 + t_s / 86400.0};
    const double minutes =
        1440.0 * ((time.jd1 - orbit.elements().epoch.jd1) + (time.jd2 - orbit.elements().epoch.jd2)) +
        t_s / 60.0;
    return geodesy::ecef_from_teme(then)(orbit.after_minutes(minutes).position);
  };
  // Nadir of the middle of the image is the scene's origin.
  const geodesy::Geodetic below = geodesy::geodetic_from_ecef(place(0.0));
  const std::string origin = format(R"({{"latitude": "{:.12f} deg", "longitude": "{:.12f} deg"}})",
                                    below.latitude_rad / kDegree, below.longitude_rad / kDegree);
  const std::string scanner =
      R"({"pushbroom": {"pixels": [21, 20], "focal_length": "4 m", "pitch": "10 um", "line_period": "150 us", "start": "-1.5 ms"}})";
  const Document d = document(text(R"({"orbit": {"frame": "teme", "file": "a.tle"}})", scanner, origin,
                                   "\"time\": \"2006-06-25T21:00:00Z\","));
  const auto seen = on_ground(camera(d)->ray({10.5, 10.0}));
  EXPECT_LT(std::hypot(seen.x, seen.y), 1e-2);
  EXPECT_NEAR(camera(d)->pose(10.0).position_m->z, below.height_m, 1e-2);
  EXPECT_NEAR(on_ground(camera(d)->ray({11.5, 10.0})).x - seen.x, 0.0, 1.5) << "a metre or so a pixel";
  // Between the points of the spline, for a minute.
  const auto scene_from_ecef =
      geodesy::ecef_from_enu({below.latitude_rad, below.longitude_rad, 0.0}).inverse();
  const auto trajectory = trajectory_of({*d.platform, d.time, d.scene.origin}, {}, -30.0, 30.0);
  for (double t = -30.0; t <= 30.0; t += 0.93)
    EXPECT_LT(length(trajectory.pose(t).position_m - scene_from_ecef(place(t)).p), 1e-5) << t;
}

TEST_F(Platforms, MessagesOfPaths) {
  EXPECT_EQ(
      message(text("")),
      "a.json:4:22: a pushbroom camera moves: expected a 'platform' beside the 'sensor', which says where it flies");
  EXPECT_EQ(
      message(text(kStraight, R"({"orthographic": {"gsd": "1 m", "pixels": [4, 4]}})")),
      "a.json:4:13: a platform carries a camera that scans or has a frame: expected a 'pushbroom', 'whiskbroom', 'conical' or 'frame' camera, or no 'platform'");
  EXPECT_EQ(
      message(text(R"({"table": {"file": "a.csv"}})")),
      "a.json:4:23: 'platform.table' lacks the key 'frame': 'scene', 'geodetic', 'map', 'ecef', 'teme' or 'gcrs'");
  EXPECT_EQ(
      message(text(R"({"table": {"frame": "geodetic", "file": "a.csv"}})", kPushbroom, "{}")),
      "a.json:4:13: a path about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and "
      "'longitude'");
  EXPECT_EQ(message(text(R"({"orbit": {"frame": "teme", "file": "a.tle"}})", kPushbroom,
                         R"({"latitude": "52 deg", "longitude": "4.4 deg"})", "")),
            "a.json:4:13: an orbit needs the document's 'time'");
}

TEST_F(Platforms, MessagesOfTables) {
  const std::string table = text(R"({"table": {"frame": "scene", "file": "a.csv"}})");
  const auto said = [&](const std::string& rows) {
    write("a.csv", rows);
    return message(table);
  };
  const std::string path = "time_s,x_m,y_m,z_m\n-1,0,-50,1000\n1,0,50,1000\n";
  EXPECT_EQ(said(path), "taken");
  EXPECT_EQ(
      said("time_s,x_m,y_m,z_m\n0,0,-50,1000\n0.3,0,50,1000\n"),
      "the platform's path covers 0 to 0.3 s, and the 20 lines are exposed from 0 to 0.4 s: it ends 0.1 s too early");
  EXPECT_EQ(said("time_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,2e-3\n"),
            "a.csv:2: found a quaternion of length 1.000002; expected 1 within 1e-06");
  EXPECT_EQ(
      said(
          "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n-1,0,-50,1000,0,0.7071068,0.7071068,0\n1,0,50,1000,0,0.7071068,0.7071068,0\n"),
      "taken")
      << "of seven digits";
  EXPECT_EQ(
      said("time_s,x_m,y_m,z_m,roll\n"),
      "a.csv:1:20: found the heading 'roll'; expected 'time_s', 'x_m', 'y_m', 'z_m', 'yaw_deg', 'pitch_deg', 'roll_deg', 'qw', "
      "'qx', 'qy' or 'qz'");
  EXPECT_EQ(said("time_s,x_m,y_m\n"), "a.csv:1: the table has no column 'z_m'");
  EXPECT_EQ(said("time_s,x_m,y_m,z_m\n0,0,0,0\n0,1,1,1\n"),
            "a.csv:3: found the time 0 s after 0 s; expected times that increase");
  EXPECT_EQ(said("time_s,x_m,y_m,z_m\n0,0,up,0\n"), "a.csv:2:5: found 'up' as 'y_m'; expected a number");
  EXPECT_EQ(said("time_s,x_m,y_m,z_m\n0,0,0\n"), "a.csv:2: found 3 values; expected 4, as the heading has");
  EXPECT_EQ(said("# nothing\n"), "a.csv: found an empty file; expected a table of a path");
  write("a.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n-1,0,-50,1000,0,0,0\n1,0,50,1000,0,0,0\n");
  EXPECT_EQ(message(text(R"({"table": {"frame": "scene", "file": "a.csv"}, "attitude": {"roll": "1 deg"}})")),
            "'a.csv' tells attitudes, and 'attitude' does too; expected one of both");
}

TEST_F(Platforms, MessagesOfSatellites) {
  write("a.tle", kSatellite);
  const auto said = [&](const std::string& latitude, const std::string& longitude,
                        const std::string& attitude = "") {
    return message(text(
        R"({"orbit": {"frame": "teme", "file": "a.tle"})" + attitude + "}",
        R"({"pushbroom": {"pixels": [21, 20], "focal_length": "4 m", "pitch": "10 um", "line_period": "150 us"}})",
        "{\"latitude\": \"" + latitude + " deg\", \"longitude\": \"" + longitude + " deg\"}",
        "\"time\": \"2006-06-25T21:00:00Z\","));
  };
  EXPECT_EQ(said("-54.9462", "122.8773"), "taken");
  EXPECT_EQ(
      said("0", "0"),
      "the platform is 52.8 degrees below the scene's horizon, over latitude -54.9462, longitude 122.8773 deg");
  EXPECT_EQ(
      said("-54", "123"),
      "the camera looks past the scene: the middle of its image lies at latitude -54.9462, longitude 122.8773 deg, 105.6 km "
      "from the scene's origin");
  EXPECT_EQ(said("-54.9462", "122.8773", R"(, "attitude": {"roll": "88 deg"})"),
            "the camera looks past the Earth: the middle of its image meets no ground");
  const auto wide = [&](const std::string& degrees) {
    return message(text(R"({"orbit": {"frame": "teme", "file": "a.tle"}})",
                        "{\"pushbroom\": {\"pixels\": [21, 20], \"field_of_view\": \"" + degrees +
                            " deg\", \"line_period\": \"150 us\"}}",
                        R"({"latitude": "-54.9462 deg", "longitude": "122.8773 deg"})",
                        "\"time\": \"2006-06-25T21:00:00Z\","));
  };
  EXPECT_EQ(wide("0.9"), "taken");
  EXPECT_EQ(
      wide("2"),
      "the image reaches 7.591 km from the scene's origin (to latitude -55.0084, longitude 122.9260 deg), where the Earth's surface "
      "lies 4.52 m below the flat scene; expected at most 1 m, which is 3.57 km: look at less, or move the origin");
  // Old elements are told, with what is to be expected.
  const Document old =
      document(text(R"({"orbit": {"frame": "teme", "file": "a.tle"}})", kPushbroom,
                    R"({"latitude": "0 deg", "longitude": "0 deg"})", "\"time\": \"2006-08-09T20:00:00Z\","));
  ASSERT_EQ(old.sensor.camera.settings->remarks().size(), 1u);
  EXPECT_EQ(
      old.sensor.camera.settings->remarks()[0].substr(old.sensor.camera.settings->remarks()[0].find("a.tle")),
      "a.tle' are 45 days older than the image: SGP4 leaves them by some 1 to 3 km a day, here 45 to 135 km; expected at most 30 "
      "days");
  const Document fresh =
      document(text(R"({"orbit": {"frame": "teme", "file": "a.tle"}})", kPushbroom,
                    R"({"latitude": "0 deg", "longitude": "0 deg"})", "\"time\": \"2006-07-24T20:00:00Z\","));
  EXPECT_TRUE(fresh.sensor.camera.settings->remarks().empty());
  write("b.tle", "nothing\n");
  EXPECT_EQ(
      message(text(R"({"orbit": {"frame": "teme", "file": "b.tle"}})")),
      "b.tle: found no two-line elements; expected a line that begins with '1 ' and after it one with '2 '");
  EXPECT_EQ(message(text(R"({"orbit": {"frame": "ecef", "file": "a.tle"}})")),
            "a.json:4:33: 'platform.orbit.frame' is the text \"ecef\", expected 'teme'");
}

}  // namespace
}  // namespace ifov::io::test_platform
