#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "platform/mounts/gimbal.h"
#include "platform/mounts/programmed.h"
#include "platform/power_spectrum.h"
#include "platform/trajectory.h"
#include "platform/wander.h"

namespace ifov::platform::test_mounts {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const math::Point3 kTarget{120.0, 700.0, 15.0};

Trajectory flight(double bank_deg = 3.0) {
  return Trajectory::straight({-40.0, 0.0, 1000.0}, {10.0, 90.0, -2.0},
                              {{4.0 * kDegree, 2.0 * kDegree, bank_deg * kDegree}, true});
}

std::shared_ptr<const Gimbal> gimbal(Gimbal::Settings settings = {}) {
  if (settings.name.empty()) settings.name = "its point";
  return std::make_shared<const Gimbal>(std::move(settings));
}

/// Between what the camera's axis is along and where the target is, as seen from the camera.
double off_rad(const Pose& pose, math::Point3 target) {
  const math::Vec3 line = math::normalized(target - pose.position_m);
  return math::length(math::cross(line, pose.enu_from_body.z().v)) +
         (math::dot(line, pose.enu_from_body.z().v) > 0.0 ? 0.0 : 2.0);
}

std::string refusal(const Trajectory& path, std::vector<double> times_s) {
  try {
    path.check_bearings(times_s);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Gimbal, LooksAtItsPointHoweverItIsCarried) {
  for (const auto axes : {Gimbal::Axes::pitch_roll, Gimbal::Axes::pan_tilt}) {
    const Mount mount{{1.0, -2.0, 3.0}, {0.3, -0.2, 0.1}, gimbal({.target = kTarget, .axes = axes})};
    const Trajectory path =
        flight().carrying({.shift_m = {1.0, 2.0, 3.0}, .turn = {0.05, 0.1, -0.2}, .mounts = {mount}});
    for (double t = -5.0; t < 20.0; t += 0.7) EXPECT_LT(off_rad(path.pose(t), kTarget), 1e-14) << t;
  }
}

TEST(Gimbal, TurnsAsTheWayPastItsPointHasIt) {
  // Level to the north at 100 m/s, 800 m above a point that it passes 600 m beside, at 0 s: in the plane through its wings the point is
  // atan(600/800) to the right.
  const Trajectory north = Trajectory::straight({}, {0.0, 100.0, 0.0}, {{}, true});
  const Gimbal rolls({.target = math::Point3{600.0, 0.0, -800.0}}),
      pans({.target = math::Point3{600.0, 0.0, -800.0}, .axes = Gimbal::Axes::pan_tilt});
  for (double t = -9.0; t <= 9.0; t += 1.5) {
    const Pose pose = north.pose(t);
    const double ahead = -100.0 * t;
    const geodesy::Attitude a = rolls.angles(t, pose), b = pans.angles(t, pose);
    EXPECT_NEAR(a.pitch_rad, std::atan(ahead / 800.0), 1e-12);
    EXPECT_NEAR(a.roll_rad, -std::asin(600.0 / std::hypot(ahead, 1000.0)), 1e-12);
    EXPECT_EQ(a.yaw_rad, 0.0);
    EXPECT_NEAR(b.yaw_rad, std::atan2(600.0, ahead), 1e-12);
    EXPECT_NEAR(b.pitch_rad, std::acos(800.0 / std::hypot(ahead, 1000.0)), 1e-12);
  }
  // With pitch and roll the top of the image stays in the plane of nose and belly; with pan and tilt it is away from the belly.
  const Pose level =
      north.carrying({.mounts = {{{}, {}, gimbal({.target = math::Point3{600.0, 0.0, -800.0}})}}}).pose(-3.0);
  EXPECT_NEAR(level.enu_from_body.x().v.x, 0.0, 1e-14);
  const Pose panned = north
                          .carrying({.mounts = {{{},
                                                 {},
                                                 gimbal({.target = math::Point3{600.0, 0.0, -800.0},
                                                         .axes = Gimbal::Axes::pan_tilt})}}})
                          .pose(-3.0);
  EXPECT_NEAR(panned.enu_from_body.y().v.z, 0.0, 1e-14);
  EXPECT_GT(panned.enu_from_body.x().v.z, 0.0);
}

TEST(Gimbal, FollowsWhatMoves) {
  const auto boat = std::make_shared<const Trajectory>(
      Trajectory::straight({50.0, 20.0, 0.0}, {-7.0, 12.0, 0.0}, {{}, true}));
  const Mount mount{{}, {}, gimbal({.target = Gimbal::Follow{boat, {1.0, 4.0, 2.0}}})};
  const Trajectory path = flight().carrying({.mounts = {mount}});
  const double speed = std::hypot(7.0, 12.0);
  for (double t = -4.0; t < 12.0; t += 0.9) {
    // Ahead is along the track, the right a quarter turn clockwise from it.
    const math::Point3 at{50.0 - 7.0 * t + (4.0 * -7.0 + 1.0 * 12.0) / speed,
                          20.0 + 12.0 * t + (4.0 * 12.0 + 1.0 * 7.0) / speed, 2.0};
    EXPECT_LT(off_rad(path.pose(t), at), 1e-13) << t;
  }
}

TEST(Gimbal, StandsOnOtherMounts) {
  // The inner one looks at its point from where and how the outer one holds it, whatever that is.
  const Mount outer{{2.0, 0.0, 1.0}, {0.1, 0.0, 0.0}, gimbal({.target = math::Point3{0.0, 0.0, 0.0}})},
      steps{{0.0, 0.0, 0.5},
            {},
            std::make_shared<const StepStare>(StepStare::Settings{{}, {0.0, 0.0, 0.3}, 3, 0.0, 1.0, 0.25})},
      inner{{0.0, 0.1, 0.2}, {}, gimbal({.target = kTarget})};
  for (double t = 0.0; t < 4.0; t += 0.31) {
    const Pose at = flight().carrying({.mounts = {outer, steps, inner}}).pose(t);
    EXPECT_LT(off_rad(at, kTarget), 1e-14);
    const Pose base = flight().carrying({.mounts = {outer, steps}}).pose(t);
    EXPECT_NEAR(math::length(at.position_m - base.position_m -
                             base.enu_from_body(geodesy::BodyVector{{0.0, 0.1, 0.2}}).v),
                0.0, 1e-11);
  }
}

TEST(Gimbal, LetsThroughItsShareOfJitter) {
  std::array<PowerSpectrum, 6> spectra;
  spectra[4] = PowerSpectrum::flat(20.0, 2e-3), spectra[5] = PowerSpectrum::flat(20.0, 1e-3);
  const auto wander = std::make_shared<const Wander>(spectra, 5, 0, -1.0, 5.0);
  const auto off = [&](double share, double t) {
    const Mount mount{{}, {}, gimbal({.target = math::Point3{0.0, 0.0, 0.0}, .blind_share = share})};
    // Far above and level, so that pitch and roll of the platform are those of the line of sight.
    const Trajectory high = Trajectory::straight({0.0, 0.0, 1e6}, {0.0, 1.0, 0.0}, {{}, true});
    return off_rad(high.carrying({.motion = wander, .mounts = {mount}}).pose(t), {0.0, 0.0, 0.0});
  };
  for (double t = 0.1; t < 4.0; t += 0.37) {
    std::array<double, 6> moved{};
    wander->at(t, moved);
    const double all = std::hypot(moved[4], moved[5]);
    EXPECT_LT(off(0.0, t), 1e-14);
    EXPECT_NEAR(off(1.0, t), all, 1e-4 * all + 1e-12);
    EXPECT_NEAR(off(0.25, t), 0.25 * all, 1e-3 * all + 1e-12);
  }
}

TEST(Gimbal, IsReportedByItsAnglesOnThePoseThatIsReported) {
  const Mount mount{{1.0, 0.0, 0.0}, {}, gimbal({.target = kTarget})};
  const auto truth = std::make_shared<const Trajectory>(flight().carrying({.mounts = {mount}}));
  // A bias of the position alone moves what it seems to look at by as much.
  const Trajectory moved =
      flight().carrying({.shift_m = {3.0, -1.0, 2.0}, .mounts = {mount}, .read_on = truth});
  EXPECT_LT(off_rad(moved.pose(2.0), kTarget + math::Vec3{3.0, -1.0, 2.0}), 1e-14);
  // Of the attitude: not taken out. About the nose it turns what is looked at by its angle to that.
  const Pose told =
      flight().carrying({.turn = {0.0, 0.0, 0.01}, .mounts = {mount}, .read_on = truth}).pose(2.0);
  const Pose body = flight().pose(2.0);
  const math::Vec3 line = math::normalized(kTarget - truth->pose(2.0).position_m);
  const double about_nose = math::length(math::cross(line, body.enu_from_body.x().v));
  EXPECT_NEAR(math::length(told.enu_from_body.z().v - line), 2.0 * std::sin(0.005) * about_nose, 1e-12);
}

TEST(Gimbal, SaysWhatItCannotReach) {
  // 100 m/s, 1000 m above the point: at 0 s the pitch turns by 0.1 rad/s, 5.73 deg/s.
  const Trajectory north = Trajectory::straight({0.0, 0.0, 1000.0}, {0.0, 100.0, 0.0}, {{}, true});
  const auto path = [&](Gimbal::Settings settings) {
    settings.target = math::Point3{0.0, 0.0, 0.0};
    return north.carrying({.mounts = {{{}, {}, gimbal(std::move(settings))}}});
  };
  std::vector<double> times_s;
  for (int k = -100; k <= 100; ++k) times_s.push_back(0.1 * k);
  EXPECT_EQ(refusal(path({.rate_rad_s = 5.74 * kDegree}), times_s), "");
  EXPECT_EQ(
      refusal(path({.rate_rad_s = 5.5 * kDegree}), times_s),
      "at -1.9 s the gimbal cannot look at its point: its pitch would turn by 5.52 deg/s, and it turns by at most 5.5 deg/s");
  const Gimbal::Limits limits{-30.0 * kDegree, 44.0 * kDegree};
  EXPECT_EQ(
      refusal(path({.pitch = limits}), times_s),
      "at -10 s the gimbal cannot look at its point: that needs a pitch of 45 deg, and it reaches -30 to 44 deg; expected wider "
      "limits, another path, or \"at_limits\": \"stop\"");
  const Trajectory stops = path({.pitch = limits, .stops = true});
  EXPECT_EQ(refusal(stops, times_s), "");
  const auto pitch = [&](double t) {
    const math::Vec3 axis = stops.pose(t).enu_from_body.z().v;
    return std::atan2(axis.y, -axis.z);
  };
  EXPECT_NEAR(pitch(-10.0), 44.0 * kDegree, 1e-12);
  EXPECT_NEAR(pitch(3.0), -std::atan(0.3), 1e-12);
  EXPECT_NEAR(pitch(9.0), -30.0 * kDegree, 1e-12);
  EXPECT_EQ(
      refusal(path({.axes = Gimbal::Axes::pan_tilt}), {-1.0, 0.0, 1.0}),
      "at 0 s the gimbal cannot look at its point: it is along the axis that pans, so that yaw is none; expected other 'axes' "
      "(\"pitch roll\"), or another way past it");
}

TEST(Gimbal, StopsAtTheLimitThatIsNearestAroundTheCircle) {
  // To the north past a point behind its right wing's side: its yaw goes from 90 deg through 180 to -170, where it can turn from 90 to 175 deg.
  const Gimbal pans({.target = math::Point3{0.0, 0.0, 0.0},
                     .axes = Gimbal::Axes::pan_tilt,
                     .yaw = Gimbal::Limits{90.0 * kDegree, 175.0 * kDegree},
                     .stops = true});
  const auto yaw = [&](double bearing_deg) {
    const double b = bearing_deg * kDegree;
    const Trajectory path = Trajectory::straight({-std::sin(b) * 500.0, -std::cos(b) * 500.0, 1000.0},
                                                 {0.0, 100.0, 0.0}, {{}, true});
    return pans.angles(0.0, path.pose(0.0)).yaw_rad / kDegree;
  };
  EXPECT_NEAR(yaw(120.0), 120.0, 1e-9);
  EXPECT_NEAR(yaw(179.0), 175.0, 1e-9);
  EXPECT_NEAR(yaw(-179.0), 175.0, 1e-9);
  EXPECT_NEAR(yaw(-150.0), 175.0, 1e-9);
  EXPECT_NEAR(yaw(-40.0), 90.0, 1e-9);
  EXPECT_NEAR(yaw(20.0), 90.0, 1e-9);
}

TEST(Gimbal, TellsWhereItTurns) {
  // 100 m/s, 1000 m above the point: a pitch of atan(-t/10).
  const Trajectory north = Trajectory::straight({0.0, 0.0, 1000.0}, {0.0, 100.0, 0.0}, {{}, true});
  const auto told = [&](Gimbal::Settings settings) {
    settings.target = math::Point3{0.0, 0.0, 0.0};
    std::vector<double> times_s;
    for (int k = -100; k <= 100; ++k) times_s.push_back(0.1 * k);
    return north
        .carrying(
            {.mounts = {{{1.0, 0.0, 0.0}, {}, nullptr}, {{-1.0, 0.0, 0.0}, {}, gimbal(std::move(settings))}}})
        .bearings_told(times_s);
  };
  const double low = -std::atan(0.545);
  using Told = std::vector<std::string>;
  EXPECT_EQ(told({}), Told{"gimbal towards its point, pitch -45 to 45 deg"});
  EXPECT_EQ(
      told({.pitch = Gimbal::Limits{low, 1.0}, .stops = true}),
      Told{"gimbal towards its point, pitch -28.59 to 45 deg; its pitch is at a limit from 5.5 to 10 s"});
  EXPECT_EQ(
      told({.pitch = Gimbal::Limits{low, -low}, .stops = true}),
      Told{
          "gimbal towards its point, pitch -28.59 to 28.59 deg; its pitch is at a limit 46 % of the time, first at -10 s "
          "and last at 10 s"});
  EXPECT_EQ(told({.pitch = Gimbal::Limits{1.0, 1.2}, .stops = true}),
            Told{"gimbal towards its point, pitch 57.3 deg; its pitch is at a limit all the time"});
}

TEST(StepStare, StaresAndTurnsOn) {
  const StepStare steps({{0.0, 0.1, -0.4}, {0.0, 0.0, 0.2}, 3, 1.0, 2.0, 0.5});
  const auto roll = [&](double t) { return steps.angles(t, flight().pose(0.0)).roll_rad; };
  for (const double t : {1.0, 1.7, 2.49}) EXPECT_NEAR(roll(t), -0.4, 1e-15) << t;
  for (const double t : {3.0, 4.4}) EXPECT_NEAR(roll(t), -0.2, 1e-15) << t;
  EXPECT_NEAR(roll(2.75), -0.3, 1e-14);
  EXPECT_NEAR(roll(2.625), -0.4 + 0.1 * (1.0 - std::sqrt(0.5)), 1e-14);
  // After the last the first, and before the start as ever.
  EXPECT_NEAR(roll(7.1), -0.4, 1e-14);
  EXPECT_NEAR(roll(6.75), -0.2, 1e-14);
  EXPECT_NEAR(roll(-0.9), 0.0, 1e-14);
  EXPECT_EQ(steps.angles(4.0, flight().pose(0.0)).pitch_rad, 0.1);
}

TEST(TurnTable, IsSmoothThroughItsRowsAndCoversThem) {
  std::vector<double> times_s;
  std::vector<geodesy::Attitude> angles;
  for (int k = 0; k <= 40; ++k)
    times_s.push_back(0.05 * k),
        angles.push_back({0.1 * times_s.back(), 0.0, 0.2 * std::sin(3.0 * times_s.back())});
  const Trajectory path =
      flight().carrying({.mounts = {{{}, {}, std::make_shared<const TurnTable>(times_s, angles)}}});
  const TurnTable table(times_s, angles);
  for (double t = 0.0; t <= 2.0; t += 0.013) {
    EXPECT_NEAR(table.angles(t, flight().pose(0.0)).yaw_rad, 0.1 * t, 1e-14);
    EXPECT_NEAR(table.angles(t, flight().pose(0.0)).roll_rad, 0.2 * std::sin(3.0 * t), 2e-6);
  }
  EXPECT_EQ(refusal(path, {0.0, 2.0}), "");
  EXPECT_EQ(refusal(path, {0.0, 2.5}),
            "the mount's table covers 0 to 2 s, and the image is exposed from 0 to 2.5 s");
  EXPECT_NEAR(path.step_s(), 0.05, 1e-12);
}

}  // namespace
}  // namespace ifov::platform::test_mounts
