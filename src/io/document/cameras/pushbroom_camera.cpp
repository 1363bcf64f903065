#include "io/document/cameras/pushbroom_camera.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "io/document/cameras/flight_motion.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/platform_document.h"
#include "io/document/schema/record.h"
#include "platform/trajectory.h"
#include "sensor/detector/read_out.h"
#include "sensor/lens/lens.h"
#include "sensor/pushbroom_camera.h"

namespace ifov::io {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

SchemaType<std::shared_ptr<const CameraSettings>> pushbroom_type() {
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  Record<PushbroomCamera> record(
      "pushbroom camera",
      "A line of detector elements across the track of the document's `platform`, read out line after line. Image y is time, "
      "image x grows towards the left wing, so that the image is not mirrored.");
  record.required("pixels", &PushbroomCamera::size, image_size_type(), "elements and lines")
      .exactly_one()
      .one("focal_length", &PushbroomCamera::focal_length_m, length, "focal length; with `pitch`")
      .one("field_of_view", &PushbroomCamera::field_of_view_rad,
           quantity(kAngle, {0.0, 180.0, true, true, "deg"}), "instead: of all elements together, across")
      .optional("pitch", &PushbroomCamera::pitch_m, length, "distance between elements")
      .needs("pitch", "focal_length")
      .required("line_period", &PushbroomCamera::line_period_s, quantity(kDuration, Range::above(0.0, "s")),
                "from the beginning of a line to that of the next")
      .optional("exposure", &PushbroomCamera::exposure_s, quantity(kDuration, Range::above(0.0, "s")),
                "for which a line is exposed, in the middle of its period; if not given all of it")
      .optional(
          "element_length", &PushbroomCamera::element_length_m, quantity(kLength, Range::at_least(0.0, "m")),
          "sensitive length of a detector element along the track; if not given 0, so that at one time it sees a line")
      .needs("element_length", "pitch")
      .with_default(
          "stages", &PushbroomCamera::stages, integer(1, 1024), "1",
          "of time delay and integration: elements a `pitch` apart along the track, each exposed a line period after the one ahead "
          "of it and added up")
      .with_default("start", &PushbroomCamera::start_s, quantity(kDuration), "\"0 s\"",
                    "when the first line begins, after the document's `time`")
      .at_most_one()
      .one("distortion", path(&PushbroomCamera::lens, &LensSettings::distortion), distortion_type(),
           "of the lens, y being 0 along the line; none if not given")
      .one(
          "elements", path(&PushbroomCamera::lens, &LensSettings::elements), elements_type(),
          "instead: where each element looks and how wide; `focal_length` and `pitch` then scale the optics' blur alone")
      .check([](const PushbroomCamera& camera, const DocumentNode& node) {
        if (camera.focal_length_m && !camera.pitch_m)
          node.given("focal_length")
              .fail("'focal_length' needs 'pitch', the distance between detector elements");
        if (camera.exposure_s && *camera.exposure_s > camera.line_period_s)
          node.given("exposure")
              .fail(format("'exposure' is longer than 'line_period', {:g} s; expected at most that",
                           camera.line_period_s));
      });
  return settings_type(record.type());
}

}  // namespace

constinit const CameraModel PushbroomCamera::kModel{"pushbroom", "a line scanner on the document's platform",
                                                    pushbroom_type};

double PushbroomCamera::step() const {
  return field_of_view_rad ? 2.0 * std::tan(0.5 * *field_of_view_rad) / size.width_px
                           : *pitch_m / *focal_length_m;
}

std::unique_ptr<sensor::Camera> PushbroomCamera::build(const CameraSite& site) const {
  if (!flight) throw InputError("a pushbroom camera needs a 'platform'");
  sensor::PushbroomCamera::Settings settings;
  settings.width_px = size.width_px, settings.height_px = size.height_px;
  settings.step = step();
  settings.focal_length_m = focal_length_m.value_or(0.0);
  settings.start_s = start_s, settings.line_period_s = line_period_s;
  settings.exposure_s = exposure_s.value_or(0.0);
  if (element_length_m) settings.element_px = *element_length_m / *pitch_m;
  settings.stages = stages;
  settings.lens = lens_of(lens, *focal_plane());
  settings.lowest_m = site.lowest_m, settings.highest_m = site.highest_m;
  const double end_s = start_s + size.height_px * line_period_s;
  const double beyond_s = (sensor::PushbroomCamera::kBeyond_px + stages) * line_period_s;
  const Motions motions = motions_of(*flight, {site.offset_m, site.maps}, start_s, end_s, beyond_s);
  settings.platform = motions.truth, settings.reported = motions.reported;
  auto camera = std::make_unique<sensor::PushbroomCamera>(settings);
  check_flatness(*camera, *flight);
  return camera;
}

sensor::ReadOut PushbroomCamera::read_out() const {
  return {.kind = sensor::ReadOut::Kind::lines, .period_s = line_period_s};
}

std::string PushbroomCamera::description(math::Vec3 shift_m, std::string_view axes) const {
  const std::shared_ptr<const sensor::Lens> optics = lens_of(lens, *focal_plane());
  const double half = 0.5 * size.width_px * step();
  const auto side = [&](double x) { return std::atan(optics ? optics->direction_of({x, 0.0}).x : x); };
  return format("pushbroom, {} x {} pixels, {:.4g} deg across{}, a line every {:.6g} ms, {}", size.width_px,
                size.height_px, (side(half) - side(-half)) * kDegrees,
                !optics         ? std::string()
                : lens.elements ? std::string(", elements by a table")
                                : format(", lens distortion by {:.3g} px at the right end",
                                         (optics->image_of({half, 0.0}).x - half) / step()),
                1e3 * line_period_s,
                flight ? path_description(*flight, shift_m, axes) : "without a platform");
}

std::shared_ptr<const CameraSettings> PushbroomCamera::shrunk(int longest_px) const {
  auto camera = std::make_shared<PushbroomCamera>(*this);
  camera->size = size.divided(size.times(longest_px));
  camera->lens = lens.of(size);
  // The same time for all lines, so that the path covers them still.
  camera->line_period_s *= static_cast<double>(size.height_px) / camera->size.height_px;
  if (pitch_m) camera->pitch_m = *pitch_m * size.width_px / camera->size.width_px;
  // Of pixels so large, those are small.
  camera->exposure_s.reset(), camera->element_length_m.reset(), camera->stages = 1;
  return camera;
}

std::shared_ptr<const CameraSettings> PushbroomCamera::seen_from(double, double) const {
  throw InputError(
      "a pushbroom camera looks where its platform carries it: it cannot be asked to look from elsewhere");
}

std::optional<CameraSettings::Optics> PushbroomCamera::optics() const {
  if (!focal_length_m) return std::nullopt;
  return Optics{*focal_length_m, *pitch_m};
}

std::shared_ptr<const CameraSettings> PushbroomCamera::carried_by(
    std::shared_ptr<const PlatformFlight> by) const {
  if (!by)
    throw InputError(
        "a pushbroom camera moves: expected a 'platform' beside the 'sensor', which says where it flies");
  check_flight(*by);
  auto camera = std::make_shared<PushbroomCamera>(*this);
  camera->flight = std::move(by);
  return camera;
}

std::optional<FocalPlane> PushbroomCamera::focal_plane() const {
  return FocalPlane{size.width_px, size.height_px, step(), focal_length_m, true};
}

std::optional<SensitiveSide> PushbroomCamera::sensitive_side() const {
  return io::sensitive_side(lens, *focal_plane());
}

std::vector<std::string> PushbroomCamera::remarks() const {
  return flight ? flight_remarks(*flight) : std::vector<std::string>{};
}

}  // namespace ifov::io
