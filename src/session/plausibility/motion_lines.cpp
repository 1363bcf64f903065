#include "session/plausibility/motion_lines.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/format.h"
#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "io/document/document.h"
#include "sampling/footprint_groups.h"
#include "sensor/along_track.h"
#include "sensor/camera.h"
#include "sensor/flying/image_way.h"
#include "sensor/flying/picture_stack.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

using geometry::MovingWorld;

/// Of the picture in the middle of the image: by how much later what lies a pixel further right or down in it is seen. 0 of a frame, rows
/// of a rolling shutter included, each of which is a picture of one time.
struct Pace {
  double x_s = 0.0, y_s = 0.0;
};
Pace pace_of(const sensor::Camera& camera) {
  std::unique_ptr<const sensor::Camera> own;
  if (const sensor::PictureStack* const stack = camera.pictures())
    own = stack->picture(static_cast<int>(camera.middle_line_px()) / stack->lines_of_each());
  const sensor::Camera& picture = own ? *own : camera;
  const double x_px = 0.5 * picture.width_px(), y_px = picture.middle_line_px();
  const auto time_s = [&](double dx_px, double dy_px) {
    return picture.ray({x_px + dx_px, y_px + dy_px}).time_s;
  };
  return {time_s(0.5, 0.0) - time_s(-0.5, 0.0), time_s(0.0, 0.5) - time_s(0.0, -0.5)};
}

/// For how long a point of the image is exposed.
double exposure_s(const sensor::Camera& camera) {
  if (camera.exposure_s() > 0.0 || camera.row_period_s() > 0.0) return camera.exposure_s();
  const Pace pace = pace_of(camera);
  return std::abs(pace.x_s) * camera.along_line().exposure_px +
         std::abs(pace.y_s) * camera.along_track().exposure_px;
}

/// Variance of a footprint along y, or x, about its middle, px^2.
double variance_px2(const sampling::PixelFootprint& footprint, bool along_x) {
  constexpr int kStrips = 400;
  const double reach_px = std::max(footprint.half_width_px(), footprint.half_width_across_px());
  double energy = 0.0, first = 0.0, second = 0.0;
  for (int k = 0; k < kStrips; ++k) {
    const double from_px = reach_px * (2.0 * k / kStrips - 1.0),
                 to_px = reach_px * (2.0 * (k + 1) / kStrips - 1.0), at_px = 0.5 * (from_px + to_px);
    const double share = along_x ? footprint.integral(from_px, -reach_px, to_px, reach_px)
                                 : footprint.integral(-reach_px, from_px, reach_px, to_px);
    energy += share;
    first += share * at_px;
    second += share * at_px * at_px;
  }
  return second / energy - first * first / (energy * energy);
}

/// What a footprint is spread over beyond the way of an exposure, and by how much channels' own places are seen earlier or later: where what
/// moves is not where it was when the middle was seen.
struct Apart {
  double spread_s = 0.0, shift_s = 0.0;
};
Apart apart_of(const Parts& parts) {
  const Pace pace = pace_of(*parts.camera);
  Apart apart;
  const auto count = [&](const sampling::PixelFootprint& footprint, sampling::Point2 shift_px) {
    const auto spread_s = [&](double pace_s, bool along_x, double exposure_px) {
      if (pace_s == 0.0) return 0.0;
      return std::abs(pace_s) *
             std::sqrt(std::max(0.0, variance_px2(footprint, along_x) - exposure_px * exposure_px / 12.0));
    };
    apart.spread_s =
        std::max({apart.spread_s, spread_s(pace.x_s, true, parts.camera->along_line().exposure_px),
                  spread_s(pace.y_s, false, parts.camera->along_track().exposure_px)});
    apart.shift_s = std::max(apart.shift_s, std::abs(pace.x_s * shift_px.x + pace.y_s * shift_px.y));
  };
  if (parts.groups == nullptr) {
    count(*parts.footprint, {});
  } else {
    for (std::size_t g = 0; g < parts.groups->size(); ++g)
      count((*parts.groups)[g].footprint, (*parts.groups)[g].shift_px);
  }
  return apart;
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
  constexpr double kNoticed_px = 0.01;
  const MovingWorld* const world = parts.scene.world->moving();
  if (world == nullptr) return;
  const Apart apart = apart_of(parts);
  if (!(apart.spread_s > 0.0 || apart.shift_s > 0.0)) return;
  for (std::size_t m = 0; m < world->mover_count(); ++m) {
    const Way way = way_of(*world, m);
    const double px_per_s = way.fastest_m_s / parts.camera->gsd_m(way.at_m);
    if (const double spread_px = apart.spread_s * px_per_s; spread_px > kNoticed_px)
      log.warn(format(
          "{} moves by {:.2g} pixels while what the sensor spreads light over (its PSF, the length of its elements, its stages) "
          "passes: these are taken to look at what stands still, so that its edges are blurred a little more or less than they would "
          "be, which half-widths do not hold; they are where they should be",
          title(parts, *world, m), spread_px));
    if (const double shift_px = apart.shift_s * px_per_s; shift_px > kNoticed_px)
      log.warn(format(
          "{} is up to {:.2g} pixels from where it should be in channels with a 'shift': these show it as it is when the "
          "sensor's middle is over what they see, which half-widths do not hold",
          title(parts, *world, m), shift_px));
  }
}

}  // namespace ifov::session
