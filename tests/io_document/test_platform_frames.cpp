#include <cmath>

#include "flown_document.h"
#include "geodesy/geodetic.h"
#include "geodesy/line_of_sight.h"
#include "geodesy/orbit/teme.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/platform_document.h"
#include "platform/trajectory.h"

namespace ifov::io::test_platform {
namespace {

class PlatformFrames : public FlownDocument {};

/// The same flight, told in three frames, 500 km up: to the millimetre, and attitudes to 1e-9.
TEST_F(PlatformFrames, FlyTheSamePathInAllFrames) {
  const geodesy::Geodetic origin{52.0 * kDegree, 4.4 * kDegree, 0.0};
  const auto scene_from_ecef = geodesy::ecef_from_enu(origin).inverse();
  std::string of_scene = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n",
              of_earth = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n",
              geodetic = "time_s,longitude_deg,latitude_deg,height_m,yaw_deg,pitch_deg,roll_deg\n";
  for (int k = -3; k <= 3; ++k) {
    const double longitude = 4.4 + 0.01 * k, latitude = 52.0 - 0.03 * k, height = 5e5 + 100.0 * k * k,
                 yaw = 191.0 + k, roll = 0.2 * k;
    const geodesy::Geodetic place{latitude * kDegree, longitude * kDegree, height};
    const geodesy::EcefPoint at = geodesy::ecef_from_geodetic(place);
    const math::Point3 p = scene_from_ecef(at).p;
    const platform::Quaternion q =
        platform::quaternion_of(scene_from_ecef * geodesy::ecef_from_enu(place) *
                                geodesy::enu_from_body({yaw * kDegree, 0.1 * kDegree, roll * kDegree}));
    of_scene += format("{},{:.6f},{:.6f},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f}\n", 0.5 * k, p.x, p.y, p.z,
                       q.w, q.x, q.y, q.z);
    of_earth += format("{},{:.6f},{:.6f},{:.6f},{},0.1,{}\n", 0.5 * k, at.p.x, at.p.y, at.p.z, yaw, roll);
    geodetic +=
        format("{},{:.12f},{:.12f},{:.6f},{},0.1,{}\n", 0.5 * k, longitude, latitude, height, yaw, roll);
  }
  write("scene.csv", of_scene), write("ecef.csv", of_earth), write("geodetic.csv", geodetic);
  const auto trajectory = [&](const std::string& frame) {
    const Document d =
        document(text("{\"table\": {\"frame\": \"" + frame + "\", \"file\": \"" + frame + ".csv\"}}"));
    return trajectory_of({*d.platform, d.time, d.scene.origin}, {}, 0.0, 1.0);
  };
  const platform::Trajectory scene = trajectory("scene"), ecef = trajectory("ecef"),
                             earth = trajectory("geodetic");
  for (double t = -1.5; t <= 1.5; t += 0.1) {
    const platform::Pose a = scene.pose(t), b = ecef.pose(t), c = earth.pose(t);
    EXPECT_LT(length(a.position_m - b.position_m), 1e-3);
    EXPECT_LT(length(a.position_m - c.position_m), 1e-3);
    EXPECT_LT(length(a.enu_from_body.z() - b.enu_from_body.z()), 1e-9);
    EXPECT_LT(length(a.enu_from_body.x() - c.enu_from_body.x()), 1e-9);
  }
  // There and back.
  const math::Point3 p = ecef.pose(0.5).position_m;
  const geodesy::Geodetic back = geodesy::geodetic_from_ecef(scene_from_ecef.inverse()(geodesy::EnuPoint{p}));
  EXPECT_LT(std::abs(back.height_m - 5.001e5), 1e-3);
  EXPECT_LT(std::abs(back.latitude_rad - 51.97 * kDegree) * 6.4e6, 1e-3);
  EXPECT_LT(std::abs(back.longitude_rad - 4.41 * kDegree) * 6.4e6, 1e-3);
}

/// The same flight again: way points about the Earth, and tables among the stars, whose axes turn beneath it; with attitudes.
TEST_F(PlatformFrames, FlyTheSamePathAmongTheStars) {
  const geodesy::UtcTime time = geodesy::parse_utc("2026-06-21T11:00:00Z");
  constexpr double kArcSecond = kDegree / 3600.0;
  const geodesy::EarthOrientation day{-0.031, 0.12 * kArcSecond, 0.41 * kArcSecond};
  std::string teme = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n", gcrs = teme,
              level = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n", ecef = level, points, geodetic;
  for (int k = -3; k <= 3; ++k) {
    const geodesy::Geodetic place{(52.0 - 0.03 * k) * kDegree, (4.4 + 0.01 * k) * kDegree,
                                  5e5 + 100.0 * k * k};
    const geodesy::EcefPoint at = geodesy::ecef_from_geodetic(place);
    const auto ecef_from_body = geodesy::ecef_from_enu(place) * geodesy::enu_from_body({3.3, 0.01, 0.02 * k});
    const geodesy::UtcTime then{time.jd1, time.jd2 + 0.5 * k / 86400.0};
    const auto row = [&](const auto& ecef_from_stars) {
      const auto from_ecef = ecef_from_stars.inverse();
      const math::Point3 p = from_ecef(at).p;
      const auto axes = from_ecef * ecef_from_body;
      const platform::Quaternion q = platform::quaternion_of({{axes.x().v}, {axes.y().v}, {axes.z().v}});
      return format("{},{:.6f},{:.6f},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f}\n", 0.5 * k, p.x, p.y, p.z, q.w,
                    q.x, q.y, q.z);
    };
    teme += row(geodesy::ecef_from_teme(then, day)), gcrs += row(geodesy::ecef_from_gcrs(then, day));
    const math::Point3 p = geodesy::ecef_from_gcrs(then, day).inverse()(at).p;
    const std::string angles =
        format("{:.12f},{:.12f},{:.12f}\n", 3.3 / kDegree, 0.01 / kDegree, 0.02 * k / kDegree);
    level += format("{},{:.6f},{:.6f},{:.6f},{}", 0.5 * k, p.x, p.y, p.z, angles);
    ecef += format("{},{:.6f},{:.6f},{:.6f},{}", 0.5 * k, at.p.x, at.p.y, at.p.z, angles);
    points += format(R"({}{{"time": "{} s", "position": ["{:.6f} m", "{:.6f} m", "{:.6f} m"]}})",
                     k > -3 ? ", " : "", 0.5 * k, at.p.x, at.p.y, at.p.z);
    geodetic += format(
        R"({}{{"time": "{} s", "latitude": "{:.12f} deg", "longitude": "{:.12f} deg", "height": "{:.6f} m"}})",
        k > -3 ? ", " : "", 0.5 * k, 52.0 - 0.03 * k, 4.4 + 0.01 * k, place.height_m);
  }
  write("teme.csv", teme), write("gcrs.csv", gcrs), write("level.csv", level), write("ecef.csv", ecef);
  const auto trajectory = [&](const std::string& platform) {
    const Document d = document(text(platform));
    return trajectory_of({*d.platform, d.time, d.scene.origin}, {}, 0.0, 1.0);
  };
  const std::string turn = R"(, "ut1_minus_utc": "-31 ms", "polar_motion": ["0.12 arcsec", "410 mas"])";
  const auto table = [&](const std::string& frame, const std::string& file, const std::string& more) {
    return trajectory("{\"table\": {\"frame\": \"" + frame + "\", \"file\": \"" + file + ".csv\"" + more +
                      "}}");
  };
  const platform::Trajectory expected = table("ecef", "ecef", "");
  const std::pair<const char*, platform::Trajectory> others[] = {
      {"teme", table("teme", "teme", turn)},
      {"gcrs", table("gcrs", "gcrs", turn)},
      {"level", table("gcrs", "level", turn)},
      {"points", trajectory("{\"way_points\": {\"frame\": \"ecef\", \"points\": [" + points + "]}}")},
      {"geodetic",
       trajectory("{\"way_points\": {\"frame\": \"geodetic\", \"points\": [" + geodetic + "]}}")}};
  for (const auto& [name, other] : others)
    for (double t = -1.5; t <= 1.5; t += 0.1) {
      const platform::Pose a = expected.pose(t), b = other.pose(t);
      EXPECT_LT(length(a.position_m - b.position_m), 1e-3) << name;
      if (name[0] == 'p' || name[2] == 'o') continue;  // the nose along the track
      EXPECT_LT(length(a.enu_from_body.x() - b.enu_from_body.x()), 1e-9) << name;
      EXPECT_LT(length(a.enu_from_body.z() - b.enu_from_body.z()), 1e-9) << name;
    }
  // Frames taken for each other, and UT1 that is not told, are far off: 31 ms of the Earth's turn at this height and latitude are 9.5 m.
  EXPECT_GT(length(table("gcrs", "teme", turn).pose(0.0).position_m - expected.pose(0.0).position_m), 1e4);
  const double off_m =
      length(table("teme", "teme", R"(, "polar_motion": ["0.12 arcsec", "410 mas"])").pose(0.0).position_m -
             expected.pose(0.0).position_m);
  EXPECT_NEAR(off_m, 0.031 * 7.2921e-5 * 6.869e6 * std::cos(52.0 * kDegree), 0.2);
}

/// One state of a satellite in three frames; and what is wrong with others.
TEST_F(PlatformFrames, FallFromAState) {
  // Vallado, Seago and Seidelmann 2006: ITRF and GCRF (m, m/s), TEME of that by this program.
  const geodesy::UtcTime epoch = geodesy::parse_utc("2004-04-06T07:51:28.386009Z");
  constexpr double kArcSecond = kDegree / 3600.0;
  const geodesy::EarthOrientation day{-0.4399619, -0.140682 * kArcSecond, 0.333309 * kArcSecond};
  const geodesy::EcefPoint at{{-1033479.3830, 7901295.2754, 6380356.5958}};
  const geodesy::EcefVector over_ground{{-3225.636520, -2872.451450, 5531.924446}};
  const math::Point3 gcrf{5102508.9592, 6123011.4033, 6378136.9247};
  const math::Vec3 gcrf_m_s{-4743.220156, 790.536498, 5533.755728};
  const auto to_teme = geodesy::ecef_from_teme(epoch, day).inverse() * geodesy::ecef_from_gcrs(epoch, day);
  const std::string turn =
      R"(, "ut1_minus_utc": "-0.4399619 s", "polar_motion": ["-0.140682 arcsec", "0.333309 arcsec"])";
  const auto path = [&](const std::string& frame, math::Point3 p, math::Vec3 v) {
    const Document d = document(text(
        format(
            R"({{"orbit": {{"state": {{"frame": "{}", "position": ["{:.6f} m", "{:.6f} m", "{:.6f} m"], "velocity": ["{:.9f} m/s", "{:.9f} m/s", "{:.9f} m/s"], "epoch": "2004-04-06T07:51:28.386009Z"}}{}}}}})",
            frame, p.x, p.y, p.z, v.x, v.y, v.z, turn),
        kPushbroom, R"({"latitude": "52 deg", "longitude": "4.4 deg"})",
        "\"time\": \"2004-04-06T08:51:28.386009Z\","));
    return trajectory_of({*d.platform, d.time, d.scene.origin}, {}, -3600.0, 0.0);
  };
  const auto ecef = path("ecef", at.p, over_ground.v), gcrs = path("gcrs", gcrf, gcrf_m_s),
             teme = path("teme", to_teme(geodesy::PointIn<geodesy::Gcrs>{gcrf}).p,
                         to_teme(geodesy::GcrsVector{gcrf_m_s}).v);
  const auto scene_from_ecef = geodesy::ecef_from_enu({52.0 * kDegree, 4.4 * kDegree, 0.0}).inverse();
  EXPECT_LT(length(ecef.pose(-3600.0).position_m - scene_from_ecef(at).p), 1e-5);
  EXPECT_LT(length(ecef.pose(-3600.0).velocity_m_s - scene_from_ecef(over_ground).v), 1e-4)
      << "about the pole of the day: about the ellipsoid's it would be 9e-4 off";
  for (const double t : {-3600.0, -1800.0, 0.0}) {
    // The paper keeps its date in one number, 20 us off: 12 mm; its velocities end at 1 um/s.
    EXPECT_LT(length(gcrs.pose(t).position_m - ecef.pose(t).position_m), 0.05) << t;
    EXPECT_LT(length(teme.pose(t).position_m - gcrs.pose(t).position_m), 1e-3) << t;
  }
  // Velocities of one frame taken for the other's.
  EXPECT_GT(length(path("ecef", at.p, gcrf_m_s).pose(0.0).position_m - ecef.pose(0.0).position_m), 1e5);
  const auto said = [&](const std::string& orbit, const std::string& time = "2004-04-06T08:51:28Z") {
    return message(text("{\"orbit\": {" + orbit + "}}", kPushbroom,
                        R"({"latitude": "0 deg", "longitude": "0 deg"})", "\"time\": \"" + time + "\","));
  };
  const auto state = [](const std::string& frame, const std::string& position, const std::string& more = "") {
    return "\"state\": {\"frame\": \"" + frame + "\", \"position\": [\"" + position +
           R"( km", "0 m", "0 m"], "velocity": ["0 m/s", "7.5 km/s", "0 m/s"], "epoch": "2004-04-06T07:51:28Z"})" +
           more;
  };
  EXPECT_EQ(
      said(state("j2000", "7000")),
      "a.json:4:43: 'platform.orbit.state.frame' is the text \"j2000\", expected 'gcrs', 'teme' or 'ecef'");
  EXPECT_EQ(said(state("gcrs", "6000")),
            "the orbit's position is 6000 km from the Earth's centre, inside the Earth");
  EXPECT_EQ(said(state("gcrs", "6400")), "the orbit meets the ground within 488 s of its epoch");
  EXPECT_EQ(said(state("gcrs", "7000"), "2004-05-16T07:51:28Z"),
            "the orbit's state is of 40.0 days before the image; expected at most 30");
  EXPECT_EQ(said(state("gcrs", "7000", R"(, "frame": "teme")")),
            "a.json:4:23: 'frame' needs the key 'file' beside it in 'platform.orbit'");
  EXPECT_EQ(
      said(state("gcrs", "7000", R"(, "file": "a.tle")")),
      "a.json:4:168: 'file' cannot stand beside 'state': 'platform.orbit' takes only one of 'file' or 'state'");
  EXPECT_EQ(said(R"("file": "a.tle")"), "a.json:4:23: 'platform.orbit' lacks the key 'frame': 'teme'");
  const Document old =
      document(text("{\"orbit\": {" + state("gcrs", "7000") + "}}", kPushbroom,
                    R"({"latitude": "0 deg", "longitude": "0 deg"})", "\"time\": \"2004-04-06T10:51:28Z\","));
  ASSERT_EQ(old.sensor.camera.settings->remarks().size(), 1u);
  EXPECT_EQ(
      old.sensor.camera.settings->remarks()[0],
      "the state of the orbit is 3 hours older than the image: what it leaves out moves low satellites by some 1 km until then (gravity by longitude, Sun and Moon), and by 0.32 km more at 400 km (air); expected at most 1 hour");
  EXPECT_EQ(
      old.sensor.camera.settings->description({}, "x").substr(
          old.sensor.camera.settings->description({}, "x").find("on the orbit")),
      "on the orbit from its state at 2004-04-06T07:51:28.000Z, UT1 - UTC and polar motion not given (up to 439 m on the ground)");
}

/// A straight line in space, level where it is.
TEST_F(PlatformFrames, FlyStraightAboutTheEarth) {
  const auto trajectory = [&](const std::string& frame, const std::string& attitude = "") {
    const Document d = document(text("{\"straight\": {" + frame + "}" + attitude + "}"));
    return trajectory_of({*d.platform, d.time, d.scene.origin}, {}, -60.0, 60.0);
  };
  const geodesy::Geodetic start{52.1 * kDegree, 4.5 * kDegree, 3000.0};
  const auto ecef_from_start = geodesy::ecef_from_enu(start);
  const auto scene_from_ecef = geodesy::ecef_from_enu({52.0 * kDegree, 4.4 * kDegree, 0.0}).inverse();
  const auto path = trajectory(
      R"("frame": "geodetic", "latitude": "52.1 deg", "longitude": "4.5 deg", "height": "3 km", "velocity": ["100 m/s", "50 m/s", "2 m/s"])");
  const math::Vec3 v = ecef_from_start(geodesy::EnuVector{{100.0, 50.0, 2.0}}).v;
  const geodesy::EcefPoint p = geodesy::ecef_from_geodetic(start);
  const auto other = trajectory(format(
      R"("frame": "ecef", "position": ["{:.6f} m", "{:.6f} m", "{:.6f} m"], "velocity": ["{:.9f} m/s", "{:.9f} m/s", "{:.9f} m/s"])",
      p.p.x, p.p.y, p.p.z, v.x, v.y, v.z));
  for (double t = -60.0; t <= 60.0; t += 7.1) {
    const math::Point3 at =
        scene_from_ecef(ecef_from_start(geodesy::EnuPoint{{100.0 * t, 50.0 * t, 2.0 * t}})).p;
    EXPECT_LT(length(path.pose(t).position_m - at), 1e-6) << t;
    EXPECT_LT(length(other.pose(t).position_m - at), 1e-5) << t;
    const auto up = scene_from_ecef(
        geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(scene_from_ecef.inverse()(geodesy::EnuPoint{at})))
            .z());
    EXPECT_LT(length(path.pose(t).enu_from_body.z().v + up.v), 1e-9) << "the belly down, where it then is";
  }
  const auto looking = trajectory(
      R"("frame": "geodetic", "latitude": "52.1 deg", "longitude": "4.5 deg", "height": "3 km", "velocity": ["100 m/s", "50 m/s", "0 m/s"])",
      R"(, "attitude": {"look_at": {"frame": "geodetic", "latitude": "52 deg", "longitude": "4.4 deg"}})");
  const platform::Pose pose = looking.pose(3.0);
  EXPECT_GT(dot(pose.enu_from_body.z().v, math::normalized(math::Point3{} - pose.position_m)), 1.0 - 1e-12);
}

TEST_F(PlatformFrames, MessagesOfFrames) {
  write("a.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n");
  const auto table = [&](const std::string& frame, const std::string& more = "",
                         const std::string& origin = "{}", const std::string& time = "") {
    return message(text("{\"table\": {\"frame\": \"" + frame + "\", \"file\": \"a.csv\"" + more + "}}",
                        kPushbroom, origin, time));
  };
  const std::string place = R"({"latitude": "52 deg", "longitude": "4.4 deg"})";
  EXPECT_EQ(
      table("icrf"),
      "a.json:4:33: 'platform.table.frame' is the text \"icrf\", expected 'scene', 'geodetic', 'map', 'ecef', 'teme' or 'gcrs'");
  EXPECT_EQ(table("gcrs", "", place),
            "a.json:4:13: under a path among the stars the Earth turns: expected the document's 'time'");
  EXPECT_EQ(
      table("gcrs"),
      "a.json:4:13: a path about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and 'longitude'");
  EXPECT_EQ(
      table("map", "", place),
      "a.json:4:13: the frame is \"map\", and nothing says which: expected a 'crs' beside it, such as \"EPSG:25832\", or one of the scene's 'origin'");
  EXPECT_EQ(
      table("map", R"(, "crs": "EPSG:28992")"),
      "a.json:4:13: a place on a map needs that of the scene: expected an 'origin' of the scene with 'latitude' and 'longitude', or with a 'crs'");
  EXPECT_EQ(
      table("map", R"(, "crs": "EPSG:28992")", place),
      "a.csv:1:8: found the heading 'x_m'; expected 'time_s', 'easting_m', 'northing_m', 'height_m', 'yaw_deg', 'pitch_deg', 'roll_deg', 'qw', 'qx', 'qy' or 'qz'");
  EXPECT_EQ(table("scene", R"(, "crs": "EPSG:28992")"),
            "a.json:4:59: 'crs' names a map, and 'frame' is none; expected 'frame' \"map\", or no 'crs'");
  EXPECT_EQ(
      table("ecef", R"(, "ut1_minus_utc": "0.1 s")"),
      "a.json:4:58: 'ut1_minus_utc' is of the frames \"teme\" and \"gcrs\", under which the Earth turns");
  EXPECT_EQ(
      table("teme", R"(, "polar_motion": ["1 deg", "0 mas"])"),
      "a.json:4:75: 'platform.table.polar_motion[0]' is the text \"1 deg\": 'deg' is not a unit of angle of the pole. Units: arcsec, mas, rad");
  EXPECT_EQ(
      message(text(
          R"({"way_points": {"frame": "geodetic", "points": [{"time": "0 s", "latitude": "52 deg", "longitude": "4 deg"}, {"time": "1 s", "position": ["0 m", "0 m", "5 m"]}]}})")),
      "a.json:4:122: a geodetic point is told by 'longitude', 'latitude' and 'height'");
  EXPECT_EQ(
      message(text(
          R"({"way_points": {"frame": "geodetic", "points": [{"time": "1 s", "latitude": "52 deg", "longitude": "4 deg"}, {"time": "0 s", "latitude": "52 deg", "longitude": "4 deg"}]}})")),
      "a.json:4:131: found the time 0 s after 1 s; expected times that increase");
  EXPECT_EQ(
      message(text(
          R"({"straight": {"frame": "teme", "position": ["0 m", "0 m", "7000 km"], "velocity": ["7 km/s", "0 m/s", "0 m/s"]}})")),
      "a.json:4:36: 'platform.straight.frame' is the text \"teme\", expected 'scene', 'geodetic', 'map' or 'ecef'");
  EXPECT_EQ(
      message(text(
          R"({"straight": {"frame": "scene", "position": ["0 m", "0 m", "500 m"], "velocity": ["70 m/s", "0 m/s", "0 m/s"]}, "attitude": {"look_at": {"frame": "ecef", "position": ["0 m", "0 m", "500 m"]}}})",
          kPushbroom, "{}")),
      "a.json:4:13: a point about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and 'longitude'");
}

}  // namespace
}  // namespace ifov::io::test_platform
