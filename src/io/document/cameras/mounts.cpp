#include "io/document/cameras/mounts.h"

#include <array>
#include <memory>

#include "core/format.h"
#include "core/overloaded.h"
#include "geodesy/geodetic.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/path_table.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
#include "platform/mounts/gimbal.h"
#include "platform/mounts/programmed.h"
#include "platform/trajectory.h"

namespace ifov::io {
namespace {

/// In the scene.
math::Point3 scene_point(const TrackedPoint& point, const OriginDocument& origin, math::Vec3 offset_m) {
  const auto [x, y, z] = point.place;
  if (point.frame == PathFrame::scene) return math::Point3{x, y, z} - offset_m;
  const auto ecef_from_scene = geodesy::ecef_from_enu(
      {origin.geographic->latitude_rad, origin.geographic->longitude_rad, origin.height_m});
  const geodesy::EcefPoint place = point.frame == PathFrame::geodetic ? geodesy::ecef_from_geodetic({y, x, z})
                                                                      : geodesy::EcefPoint{{x, y, z}};
  return ecef_from_scene.inverse()(place).p;
}

std::optional<platform::Gimbal::Limits> limits_of(const std::optional<GimbalDocument::Limits>& told) {
  if (!told) return std::nullopt;
  return platform::Gimbal::Limits{(*told)[0], (*told)[1]};
}

/// Of the flight whose platform it is.
struct BearingMaker {
  const PlatformFlight& flight;
  math::Vec3 offset_m;
  double from_s, to_s;

  using Made = std::shared_ptr<const platform::Bearing>;

  Made operator()(std::monostate) const { return nullptr; }

  Made operator()(const GimbalDocument& told) const {
    platform::Gimbal::Settings settings;
    std::visit(Overloaded{[&](const TrackedPoint& point) {
                            settings.target = scene_point(point, flight.origin, offset_m);
                            settings.name = "its point";
                          },
                          [&](const TrackedObject& object) {
                            const PlatformFlight way{*flight.tracked.at(object.name.name), flight.time,
                                                     flight.origin, flight.seed};
                            settings.target =
                                platform::Gimbal::Follow{std::make_shared<const platform::Trajectory>(
                                                             trajectory_of(way, offset_m, from_s, to_s)),
                                                         object.offset_m};
                            settings.name = format("'{}'", object.name.name);
                          }},
               told.target);
    settings.axes = told.axes == GimbalDocument::Axes::pan_tilt ? platform::Gimbal::Axes::pan_tilt
                                                                : platform::Gimbal::Axes::pitch_roll;
    settings.yaw = limits_of(told.yaw_rad), settings.pitch = limits_of(told.pitch_rad);
    settings.roll = limits_of(told.roll_rad);
    settings.stops = told.at_limits == GimbalDocument::AtLimits::stop;
    settings.rate_rad_s = told.rate_rad_s;
    settings.blind_share = told.jitter_share;
    return std::make_shared<const platform::Gimbal>(std::move(settings));
  }

  Made operator()(const StepStareDocument& told) const {
    return std::make_shared<const platform::StepStare>(platform::StepStare::Settings{
        told.first, told.step, told.steps, told.start_s, told.period_s, told.slew_s});
  }

  Made operator()(const TurnTableDocument& told) const {
    std::vector<double> times_s;
    std::vector<geodesy::Attitude> angles;
    for (const PathRow& row : read_turn_table(told.file.path).rows) {
      times_s.push_back(row.time_s);
      angles.push_back(row.angles);
    }
    return std::make_shared<const platform::TurnTable>(std::move(times_s), angles);
  }
};

}  // namespace

std::vector<platform::Mount> mounts_of(const PlatformFlight& flight, math::Vec3 offset_m, double from_s,
                                       double to_s) {
  std::vector<platform::Mount> mounts;
  for (const MountDocument& mount : mounts_in(flight.platform.mounts))
    mounts.push_back({mount.lever_arm_m, mount.boresight,
                      std::visit(BearingMaker{flight, offset_m, from_s, to_s}, mount.bearing)});
  return mounts;
}

}  // namespace ifov::io
