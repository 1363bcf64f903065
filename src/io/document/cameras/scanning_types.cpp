#include <algorithm>

#include "core/format.h"
#include "io/document/cameras/scanning_cameras.h"
#include "io/document/schema/record.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

template <class Camera, class M>
M Camera::*own(M ScanningCamera::*member) {
  return member;
}

/// The keys that both have.
template <class Camera>
void tell_scanning(Record<Camera>& record, double widest_deg, const char* sweep_angle) {
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  const SchemaType<double> duration = quantity(kDuration, Range::above(0.0, "s"));
  record
      .required("pixels", own<Camera>(&ScanningCamera::size), image_size_type(),
                "samples of a sweep, and lines: `elements` of them for each sweep")
      .with_default("elements", own<Camera>(&ScanningCamera::elements), integer(1, 4096), "1",
                    "detector elements along the track, seen together: lines that one sweep makes")
      .exactly_one()
      .one("focal_length", own<Camera>(&ScanningCamera::focal_length_m), length, "focal length; with `pitch`")
      .one("element_angle", own<Camera>(&ScanningCamera::element_angle_rad),
           quantity(kAngle, {0.0, 90.0, true, true, "deg"}), "instead: from element to element")
      .optional("pitch", own<Camera>(&ScanningCamera::pitch_m), length, "distance between elements")
      .needs("pitch", "focal_length")
      .required("sweep_angle", own<Camera>(&ScanningCamera::sweep_angle_rad),
                quantity(kAngle, {0.0, widest_deg, true, false, "deg"}), sweep_angle)
      .required("period", own<Camera>(&ScanningCamera::period_s), duration,
                "from the beginning of a sweep to that of the next")
      .optional("sweep_time", own<Camera>(&ScanningCamera::sweep_time_s), duration,
                "for which a sweep takes samples; if not given all of the period")
      .with_default("reversed", own<Camera>(&ScanningCamera::reversed), boolean(), "false",
                    "whether sweeps run towards the right wing, against the image's x")
      .with_default("both_ways", own<Camera>(&ScanningCamera::both_ways), boolean(), "false",
                    "whether every second sweep runs back")
      .optional(
          "element_width", own<Camera>(&ScanningCamera::element_width_m),
          quantity(kLength, Range::at_least(0.0, "m")),
          "sensitive width of an element along the sweep; if not given 0, so that at one time it sees a line")
      .needs("element_width", "pitch")
      .with_default("exposure_share", own<Camera>(&ScanningCamera::exposure_share),
                    number(Range{0.0, 1.0, true, false, ""}), "1",
                    "of a sample's time, for which it is exposed, in its middle")
      .with_default("start", own<Camera>(&ScanningCamera::start_s), quantity(kDuration), "\"0 s\"",
                    "when the first sweep begins, after the document's `time`")
      .check([](const Camera& camera, const DocumentNode& node) {
        if (camera.focal_length_m && !camera.pitch_m)
          node.given("focal_length")
              .fail("'focal_length' needs 'pitch', the distance between detector elements");
        if (camera.size.height_px % camera.elements != 0)
          node.given("pixels").fail(
              format("{} lines are not made by whole sweeps of {} 'elements'; expected a multiple, {} or {}",
                     camera.size.height_px, camera.elements,
                     std::max(1, camera.size.height_px / camera.elements) * camera.elements,
                     (camera.size.height_px / camera.elements + 1) * camera.elements));
        if (camera.sweep_time_s && *camera.sweep_time_s > camera.period_s)
          node.given("sweep_time")
              .fail(format("'sweep_time' is longer than 'period', {:g} s; expected at most that",
                           camera.period_s));
      });
}

SchemaType<std::shared_ptr<const CameraSettings>> whiskbroom_type() {
  Record<WhiskbroomCamera> record(
      "whiskbroom camera",
      "A few detector elements along the track of the document's `platform`, which a mirror sweeps across it, again and again. Image x is the "
      "angle that the mirror turns the line of sight by, about the nose's axis, in equal steps from the right wing to the left; image y the elements "
      "of the first sweep, then those of the second.");
  tell_scanning(record, 178.0, "that the line of sight turns by in a sweep, with the belly in the middle");
  record
      .optional("amplitude", &WhiskbroomCamera::amplitude_rad,
                quantity(kAngle, {0.0, 89.5, true, false, "deg"}),
                "of a line of sight that swings as a sine does, to each side; if not given it turns evenly")
      .check([](const WhiskbroomCamera& camera, const DocumentNode& node) {
        if (!camera.amplitude_rad) return;
        if (camera.sweep_time_s)
          node.given("sweep_time")
              .fail("with 'amplitude' the sweep's time follows from 'period'; expected one of both");
        if (!(*camera.amplitude_rad > 0.5 * camera.sweep_angle_rad))
          node.given("amplitude")
              .fail(format(
                  "a line of sight that swings by {:g} deg to each side does not sweep over {:g} deg; expected more than {:g} deg",
                  *camera.amplitude_rad / math::kDegree, camera.sweep_angle_rad / math::kDegree,
                  0.5 * camera.sweep_angle_rad / math::kDegree));
      });
  return settings_type(record.type());
}

SchemaType<std::shared_ptr<const CameraSettings>> conical_type() {
  Record<ConicalCamera> record(
      "conical camera",
      "A few detector elements that are swept over a cone about the belly's axis, so that the ground is seen at one zenith angle. Image x is the "
      "angle about that axis, from the right wing to the left; image y as of a whiskbroom camera.");
  record.required("cone", &ConicalCamera::cone_rad, quantity(kAngle, {0.0, 89.5, true, false, "deg"}),
                  "between the line of sight and the belly's axis");
  tell_scanning(
      record, 350.0,
      "that the line of sight turns by about the axis in a sweep, with the nose (or the tail) in the middle");
  record.with_default("looks", &ConicalCamera::looks,
                      choice<ConicalCamera::Looks>(
                          {{"ahead", ConicalCamera::Looks::ahead}, {"behind", ConicalCamera::Looks::behind}}),
                      "\"ahead\"", "where the middle of a sweep looks");
  return settings_type(record.type());
}

}  // namespace

constinit const CameraModel WhiskbroomCamera::kModel{
    "whiskbroom", "a few elements swept across the track by a mirror", whiskbroom_type};
constinit const CameraModel ConicalCamera::kModel{
    "conical", "a few elements swept over a cone about the belly", conical_type};

std::string WhiskbroomCamera::name() const { return std::string(kModel.key); }
std::string ConicalCamera::name() const { return std::string(kModel.key); }

}  // namespace ifov::io
