#include "session/plausibility/motion_lines.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "io/document/document.h"
#include "sensor/along_track.h"
#include "sensor/camera.h"
#include "sensor/flying/image_way.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

using geometry::MovingWorld;

/// From line to line.
double line_period_s(const sensor::Camera& camera) {
  const double middle_px = camera.middle_line_px();
  return std::abs(camera.pose(middle_px + 0.5).time_s - camera.pose(middle_px - 0.5).time_s);
}

/// For how long a point of the image is exposed.
double exposure_s(const sensor::Camera& camera) {
  if (camera.exposure_s() > 0.0 || camera.row_period_s() > 0.0) return camera.exposure_s();
  return line_period_s(camera) * camera.along_track().exposure_px;
}

/// Of the carrier's origin, at most, by small steps of the time in which the image is taken.
struct Way {
  double length_m = 0.0, fastest_m_s = 0.0;
  math::Point3 at_m;  ///< in the middle of that time
};
Way way_of(const MovingWorld& world, std::size_t mover) {
  constexpr int kSteps = 200;
  const double from_s = world.from_s(), to_s = world.to_s();
  // Of an image that is taken at an instant the speed is that about it.
  const double span_s = to_s > from_s ? to_s - from_s : 1e-3,
               begin_s = to_s > from_s ? from_s : from_s - 5e-4;
  const auto at = [&](int k) {
    return world.motion(mover).scene_from_carrier(begin_s + span_s * k / kSteps).origin_m();
  };
  Way way;
  for (int k = 0; k < kSteps; ++k) {
    const double step_m = math::length(at(k + 1) - at(k));
    way.length_m += step_m;
    way.fastest_m_s = std::max(way.fastest_m_s, step_m * kSteps / span_s);
  }
  if (!(to_s > from_s)) way.length_m = 0.0;
  way.at_m = at(kSteps / 2);
  return way;
}

std::string title(const Parts& parts, const MovingWorld& world, std::size_t mover) {
  return title_of(parts.document.scene.objects, parts.placed.of(world.first_object(mover)));
}

}  // namespace

std::vector<std::string> motion_lines(const Parts& parts) {
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> lines;
  if (const auto motion = sensor::frame_motion(*parts.camera, parts.scene.world->heights().low_m))
    if (parts.camera->exposure_s() > 0.0 || parts.camera->row_period_s() > 0.0)
      lines.push_back(format(
          "{:<10} while a pixel is exposed the picture of the ground moves by {:.2g} pixels{}",
          "flight:", motion->exposure_px,
          parts.camera->row_period_s() > 0.0 ? format(", from row to row by {:.2g}", motion->row_px) : ""));
  const MovingWorld* const world = parts.scene.world->moving();
  if (world == nullptr) return lines;
  for (std::size_t m = 0; m < world->mover_count(); ++m) {
    const char* const heading = m == 0 ? "moving:" : "";
    if (m == kMostNamed) {
      lines.push_back(format("{:<10} {} more", heading, world->mover_count() - m));
      break;
    }
    const Way way = way_of(*world, m);
    const double exposed_m = way.fastest_m_s * exposure_s(*parts.camera);
    const double gsd_m = parts.camera->gsd_m(way.at_m);
    lines.push_back(format(
        "{:<10} {}: {:.3g} m/s; while a pixel is exposed {:.3g} m ({:.2g} pixels), while the image is taken {:.3g} m",
        heading, title(parts, *world, m), way.fastest_m_s, exposed_m, exposed_m / gsd_m, way.length_m));
  }
  return lines;
}

void warn_of_motion(const Parts& parts, LogSink& log) {
  constexpr double kNoticed_px = 0.05;
  const MovingWorld* const world = parts.scene.world->moving();
  const double period_s = world != nullptr ? line_period_s(*parts.camera) : 0.0;
  if (!(period_s > 0.0)) return;
  const sensor::AlongTrack along = parts.camera->along_track();
  const bool optics = !std::holds_alternative<io::NoPsf>(parts.document.sensor.psf);
  const double lines = 0.5 * along.element_px + 0.5 * (along.stages - 1) + (optics ? 1.0 : 0.0);
  for (std::size_t m = 0; m < world->mover_count(); ++m) {
    const Way way = way_of(*world, m);
    const double drawn_px = lines * period_s * way.fastest_m_s / parts.camera->gsd_m(way.at_m);
    if (drawn_px > kNoticed_px)
      log.warn(format(
          "{} moves by {:.2g} pixels while what the sensor spreads light over (its PSF, the length of its elements, its stages) "
          "passes: these are taken to look at what stands still, so that its edges are blurred a little more or less than they would "
          "be; they are where they should be",
          title(parts, *world, m), drawn_px));
  }
}

}  // namespace ifov::session
