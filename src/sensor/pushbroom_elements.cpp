#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sensor/pushbroom_camera.h"

namespace ifov::sensor {

AlongTrack PushbroomCamera::along_track() const {
  return {.exposure_px = settings_.exposure_s > 0.0 ? settings_.exposure_s / settings_.line_period_s : 1.0,
          .element_px = settings_.element_px * lines_a_pitch_,
          .stages = settings_.stages,
          .stage_px = std::abs(1.0 - lines_a_pitch_),
          .pitch_px = lines_a_pitch_,
          .timed = true};
}

std::optional<std::array<double, 2>> PushbroomCamera::displaced_px(double x_px, double y_px, double ahead_px,
                                                                   double ground_m) const {
  const CameraPose at = pose(y_px);
  const auto [right, ahead] = towards(x_px, ahead_px);
  const math::Vec3 d = at.axes.forward + at.axes.right * right + at.axes.down * ahead;
  const double below_m = at.position_m->z - ground_m;
  if (!(below_m > 0.0) || !(d.z < 0.0)) return std::nullopt;
  sampling::FocalPoint seen;
  if (!project(*at.position_m + d * (below_m / -d.z), seen)) return std::nullopt;
  return std::array{seen.x_px - x_px, seen.y_px - y_px};
}

double PushbroomCamera::mean_lines_a_pitch() const {
  constexpr int kLines = 64;
  const double ground_m = 0.5 * (settings_.lowest_m + settings_.highest_m);
  double sum = 0.0;
  int found = 0;
  for (int k = 0; k < kLines; ++k)
    for (const double v : {-1.0, 1.0})
      if (const auto d =
              displaced_px(0.5 * settings_.width_px, settings_.height_px * (k + 0.5) / kLines, v, ground_m))
        sum += (*d)[1] / v, ++found;
  return found > 0 && sum > 0.0 ? sum / found : 1.0;
}

void PushbroomCamera::find_lines_a_pitch() {
  // The furthest that an element of any stage looks ahead, and the lines in which one does: as finely as the platform turns.
  const double ahead_px = 0.5 * (settings_.element_px + settings_.stages - 1);
  const double beyond_px = 0.5 * (settings_.stages - 1), lines = settings_.height_px + 2.0 * beyond_px;
  const double step_s = settings_.platform->step_s();
  constexpr double kMost = 1e5;
  const double steps =
      std::isinf(step_s) ? 32.0 : std::max(32.0, std::ceil(2.0 * lines * settings_.line_period_s / step_s));
  if (!(steps <= kMost))
    throw InputError(format(
        "elements of a length on a platform that turns within {:.3g} s, over {:g} lines, take {:.3g} places to be judged; expected at "
        "most {:g}: fewer lines, or no 'element_length'",
        step_s, lines, steps, kMost));
  struct Seen {
    double y_px, across, along;  // displaced, a pitch
  };
  std::vector<Seen> all;
  for (int k = 0; k <= static_cast<int>(steps); ++k) {
    const double y = lines * k / steps - beyond_px;
    for (const double x : {0.0, 0.5, 1.0})
      for (const double ground_m : {settings_.lowest_m, settings_.highest_m})
        for (const double v : {-ahead_px, -0.5 * ahead_px, 0.5 * ahead_px, ahead_px})
          if (const auto d = displaced_px(x * settings_.width_px, y, v, ground_m))
            all.push_back({y, (*d)[0] / v, (*d)[1] / v});
  }
  if (all.empty()) return;  // it looks at no ground, or stands below it
  const auto [least, most] = std::minmax_element(
      all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.along < b.along; });
  lines_a_pitch_ = 0.5 * (least->along + most->along);
  const Seen& widest = *std::max_element(all.begin(), all.end(), [](const Seen& a, const Seen& b) {
    return std::abs(a.across) < std::abs(b.across);
  });
  const double off_across = std::abs(widest.across) * ahead_px,
               off_along = 0.5 * (most->along - least->along) * ahead_px;
  const double off = std::max(off_across, off_along);
  if (off <= kMost_px) return;
  const std::string why =
      off_across > off_along
          ? format("at {:.4g} s the platform rolls or yaws by {:.3g} pixels while it moves on by a pitch",
                   settings_.start_s + widest.y_px * settings_.line_period_s, std::abs(widest.across))
          : format(
                "it moves on by a pitch in {:.4g} to {:.4g} lines, as it turns and between {:g} and {:g} m of height",
                least->along, most->along, settings_.lowest_m, settings_.highest_m);
  throw InputError(format(
      "what elements {:.3g} pitches long, all stages together, see is {:.2g} pixels off from what is known of their lines: {}; expected {:g} "
      "pixels at most, which {:.2g} pitches have: a shorter 'element_length', fewer 'stages', or neither",
      2.0 * ahead_px, off, why, kMost_px, 2.0 * ahead_px * kMost_px / off));
}

}  // namespace ifov::sensor
