#include "io/document/cameras/mounts.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "core/format.h"
#include "core/overloaded.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/cameras/mount_error.h"
#include "io/document/cameras/path_table.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
#include "platform/mounts/gimbal.h"
#include "platform/mounts/programmed.h"
#include "platform/trajectory.h"

namespace ifov::io {
namespace {

std::optional<platform::Gimbal::Limits> limits_of(const std::optional<GimbalDocument::Limits>& told) {
  if (!told) return std::nullopt;
  return platform::Gimbal::Limits{(*told)[0], (*told)[1]};
}

/// A bearing of the document, which says what it cannot do there.
class PlacedBearing final : public platform::Bearing {
 public:
  PlacedBearing(std::shared_ptr<const platform::Bearing> bearing, SourcePosition position)
      : bearing_(std::move(bearing)), position_(std::move(position)) {}

  geodesy::Attitude angles(double time_s, const platform::Pose& carrier) const override {
    return bearing_->angles(time_s, carrier);
  }
  double step_s() const override { return bearing_->step_s(); }
  double blind_share() const override { return bearing_->blind_share(); }
  std::string told(std::span<const double> times_s,
                   std::span<const geodesy::Attitude> angles) const override {
    return bearing_->told(times_s, angles);
  }
  void check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const override {
    try {
      bearing_->check(times_s, angles);
    } catch (const InputError& error) {
      throw MountError(error.what(), position_);
    }
  }

 private:
  std::shared_ptr<const platform::Bearing> bearing_;
  SourcePosition position_;
};

/// Of the flight whose platform it is.
struct BearingMaker {
  const PlatformFlight& flight;
  const SceneFrame& scene;
  double from_s, to_s;

  using Made = std::shared_ptr<const platform::Bearing>;

  Made operator()(std::monostate) const { return nullptr; }

  Made operator()(const GimbalDocument& told) const {
    platform::Gimbal::Settings settings;
    std::visit(Overloaded{[&](const FramedPoint& point) {
                            settings.target = scene_point(point, flight.origin, scene);
                            settings.name = "its point";
                          },
                          [&](const TrackedObject& object) {
                            const PlatformFlight way{*flight.tracked.at(object.name.name), flight.time,
                                                     flight.origin, flight.seed};
                            settings.target =
                                platform::Gimbal::Follow{std::make_shared<const platform::Trajectory>(
                                                             trajectory_of(way, scene, from_s, to_s)),
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
    return std::make_shared<const PlacedBearing>(
        std::make_shared<const platform::Gimbal>(std::move(settings)), told.position);
  }

  Made operator()(const StepStareDocument& told) const {
    return std::make_shared<const platform::StepStare>(platform::StepStare::Settings{
        told.first, told.step, told.steps, told.start_s, told.period_s, told.slew_s});
  }

  static std::vector<PathRow> rows_of(const DocumentFile& file) {
    try {
      return read_turn_table(file.path).rows;
    } catch (const InputError& error) {
      throw MountError(error.what(), file.position);
    } catch (const SystemError& error) {
      throw MountError(error.what(), file.position);
    }
  }

  Made operator()(const TurnTableDocument& told) const {
    std::vector<double> times_s;
    std::vector<geodesy::Attitude> angles;
    for (const PathRow& row : rows_of(told.file)) {
      times_s.push_back(row.time_s);
      angles.push_back(row.angles);
    }
    return std::make_shared<const PlacedBearing>(
        std::make_shared<const platform::TurnTable>(std::move(times_s), angles), told.file.position);
  }
};

}  // namespace

std::vector<platform::Mount> mounts_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s,
                                       double to_s) {
  std::vector<platform::Mount> mounts;
  for (const MountDocument& mount : mounts_in(flight.platform.mounts))
    mounts.push_back({mount.lever_arm_m, mount.boresight,
                      std::visit(BearingMaker{flight, scene, from_s, to_s}, mount.bearing)});
  return mounts;
}

}  // namespace ifov::io
