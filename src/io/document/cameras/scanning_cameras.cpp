#include "io/document/cameras/scanning_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "io/document/cameras/flight_motion.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/platform_document.h"
#include "math/angle.h"
#include "platform/trajectory.h"
#include "sensor/detector/read_out.h"
#include "sensor/scanning/scan_camera.h"

namespace ifov::io {
double ScanningCamera::step() const {
  return element_angle_rad ? *element_angle_rad : *pitch_m / *focal_length_m;
}

sensor::SweepPattern ScanningCamera::pattern() const {
  sensor::SweepPattern pattern;
  pattern.samples = size.width_px;
  pattern.elements = elements;
  pattern.sweeps = size.height_px / elements;
  pattern.turn_rad = sweep_angle_rad;
  pattern.step = step();
  pattern.focal_length_m = focal_length_m.value_or(0.0);
  pattern.start_s = start_s;
  pattern.period_s = period_s;
  pattern.sweep_s = sweep_time_s.value_or(period_s);
  pattern.reversed = reversed;
  pattern.both_ways = both_ways;
  if (element_width_m) pattern.element_px = *element_width_m / *pitch_m;
  pattern.exposure = exposure_share;
  return pattern;
}

CameraSettings::Exposed ScanningCamera::exposed() const {
  return {start_s, start_s + size.height_px / std::max(1, elements) * period_s};
}

sensor::SweepPattern WhiskbroomCamera::pattern() const {
  sensor::SweepPattern pattern = ScanningCamera::pattern();
  pattern.axis = sensor::SweepPattern::Axis::nose;
  pattern.cone_rad = 0.5 * std::numbers::pi;
  if (amplitude_rad) {
    pattern.amplitude_rad = *amplitude_rad;
    pattern.sweep_s = sensor::SweepPattern::sine_sweep_s(sweep_angle_rad, *amplitude_rad,
                                                         both_ways ? 2.0 * period_s : period_s);
  }
  return pattern;
}

sensor::SweepPattern ConicalCamera::pattern() const {
  sensor::SweepPattern pattern = ScanningCamera::pattern();
  pattern.axis = looks == Looks::ahead ? sensor::SweepPattern::Axis::belly_looking_ahead
                                       : sensor::SweepPattern::Axis::belly_looking_behind;
  pattern.cone_rad = cone_rad;
  return pattern;
}

std::unique_ptr<sensor::Camera> ScanningCamera::build(const CameraSite& site) const {
  if (!flight) throw InputError(format("a {} camera needs a 'platform'", name()));
  sensor::ScanCamera::Settings settings;
  settings.pattern = pattern();
  settings.lowest_m = site.lowest_m, settings.highest_m = site.highest_m;
  const sensor::SweepPattern& p = settings.pattern;
  const double end_s = start_s + (p.sweeps - 1) * p.period_s + p.sweep_s;
  const double beyond_s = (sensor::SweepCamera::kBeyond_px + 1.0) * p.longest_sample_s();
  const Motions motions = motions_of(*flight, {site.offset_m, site.maps}, start_s, end_s, beyond_s);
  settings.platform = motions.truth, settings.reported = motions.reported;
  auto camera = std::make_unique<sensor::ScanCamera>(settings);
  check_flatness(*camera, *flight);
  return camera;
}

sensor::ReadOut ScanningCamera::read_out() const {
  const sensor::SweepPattern p = pattern();
  return {sensor::ReadOut::Kind::sweeps, p.elements, p.reversed, p.both_ways, p.sweep_s / p.samples};
}

std::string ScanningCamera::description(math::Vec3 shift_m, std::string_view axes) const {
  const sensor::SweepPattern p = pattern();
  return format("{}, {} sweeps of {} samples by {} element{} over {:.4g} deg, in {:.6g} of {:.6g} ms, {}",
                name(), p.sweeps, p.samples, p.elements, p.elements == 1 ? "" : "s",
                sweep_angle_rad / math::kDegree, 1e3 * p.sweep_s, 1e3 * p.period_s,
                flight ? path_description(*flight, shift_m, axes) : "without a platform");
}

std::shared_ptr<const CameraSettings> ScanningCamera::shrunk(int longest_px) const {
  const std::shared_ptr<ScanningCamera> camera = copy();
  const ImageSize wanted = size.divided(size.times(longest_px));
  const int sweeps = size.height_px / elements;
  // Elements of a sweep first, so that sweeps lie where they lay; then sweeps, in the same time.
  const int fewer = std::clamp(wanted.height_px / sweeps, 1, elements);
  const int fewer_sweeps = std::clamp(wanted.height_px / fewer, 1, sweeps);
  camera->elements = fewer;
  camera->size = {wanted.width_px, fewer * fewer_sweeps};
  const double larger = static_cast<double>(elements) / fewer,
               longer = static_cast<double>(sweeps) / fewer_sweeps;
  (pitch_m ? *camera->pitch_m : *camera->element_angle_rad) *= larger;
  camera->period_s *= longer;
  if (sweep_time_s) *camera->sweep_time_s *= longer;
  // Of pixels so large, that is small.
  camera->element_width_m.reset(), camera->exposure_share = 1.0;
  return camera;
}

std::shared_ptr<const CameraSettings> ScanningCamera::seen_from(double, double) const {
  throw InputError(format(
      "a {} camera looks where its platform carries it: it cannot be asked to look from elsewhere", name()));
}

std::optional<CameraSettings::Optics> ScanningCamera::optics() const {
  if (!focal_length_m) return std::nullopt;
  return Optics{*focal_length_m, *pitch_m};
}

std::shared_ptr<const CameraSettings> ScanningCamera::carried_by(
    std::shared_ptr<const PlatformFlight> by) const {
  if (!by)
    throw InputError(format(
        "a {} camera moves: expected a 'platform' beside the 'sensor', which says where it flies", name()));
  check_flight(*by);
  const std::shared_ptr<ScanningCamera> camera = copy();
  camera->flight = std::move(by);
  return camera;
}

std::vector<std::string> ScanningCamera::remarks() const {
  return flight ? flight_remarks(*flight) : std::vector<std::string>{};
}

}  // namespace ifov::io
