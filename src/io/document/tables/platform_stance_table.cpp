#include <array>
#include <utility>

#include "io/document/mount_document.h"
#include "io/document/tables/framed_place.h"
#include "io/document/tables/platform_tables.h"

namespace ifov::io {
namespace {

/// `yaw`, `pitch` and `roll` of a member of the record: standard deviations.
template <class T>
void add_deviations(Record<T>& record, geodesy::Attitude T::*angles) {
  const auto add = [&](const char* key, double geodesy::Attitude::*member, const char* doc) {
    record.with_default(key, path(angles, member), quantity(kAngle, Range::between(0.0, 5.0, "deg")),
                        "\"0 deg\"", doc);
  };
  add("yaw", &geodesy::Attitude::yaw_rad, "standard deviation about the body's down");
  add("pitch", &geodesy::Attitude::pitch_rad, "about its right wing");
  add("roll", &geodesy::Attitude::roll_rad, "about its nose");
}

}  // namespace

SchemaType<PlatformAttitude> platform_attitude_type() {
  struct Target {
    PlaceEntry place;
  };
  Record<Target> target("point looked at", "What the belly, and with it the camera, is turned to.");
  add_place(target, &Target::place, "position", "where it is");
  const auto look_at = converted<FramedPoint>(
      target.type(), [](const Target& t) { return point_of(t.place); },
      [](const FramedPoint& p) { return Target{entry_of_point(p)}; });
  Record<PlatformAttitude> record(
      "platform attitude",
      "How the body stands, and held angles (the 3-2-1 sequence) from there. Without more the body is level at the platform's place, its nose "
      "along the track over the ground, which for a satellite is yaw steering. A scanner looks along the body's down.");
  add_angles(record, &PlatformAttitude::angles,
             {"clockwise from what `from` says", "nose up", "right wing down"});
  record.at_most_one()
      .one(
          "axes", &PlatformAttitude::axes,
          choice<PlatformAxes>({{"nadir", PlatformAxes::nadir},
                                {"geocentric", PlatformAxes::geocentric},
                                {"velocity", PlatformAxes::velocity}}),
          "what the angles are about: the belly along the local vertical (`nadir`, as without the key), the belly to the Earth's centre, or "
          "the nose along the velocity")
      .one("look_at", &PlatformAttitude::look_at, look_at, "instead: the belly to a point, at all times")
      .optional(
          "from", &PlatformAttitude::from,
          choice<YawFrom>({{"track", YawFrom::track}, {"orbit", YawFrom::orbit}, {"north", YawFrom::north}}),
          "what yaw is counted from: where the platform flies to over the ground (`track`, as without the key), where it flies to among "
          "the stars (as a satellite without yaw steering), or north (as without the key of what is `fixed`)");
  return record.type();
}

SchemaType<JitterDocument> jitter_type() {
  const SchemaType<double> frequency = quantity(kFrequency, Range::between(1e-6, 1e5, "Hz"));
  Record<WhiteJitter> white("white jitter", "The same power at all frequencies up to one.");
  add_deviations(white, &WhiteJitter::rms);
  white.required("up_to", &WhiteJitter::up_to_hz, frequency, "highest frequency");
  Record<FallingJitter> falling("falling jitter",
                                "Power as 1 / (1 + (f / corner)^slope), up to a highest frequency.");
  add_deviations(falling, &FallingJitter::rms);
  falling.required("corner", &FallingJitter::corner_hz, frequency, "where half of the power density is left")
      .required("slope", &FallingJitter::slope, number(Range::between(0.0, 12.0)), "exponent of its fall")
      .required("up_to", &FallingJitter::up_to_hz, frequency, "highest frequency");
  Record<TabulatedJitter> tabulated("tabulated jitter",
                                    "Power densities from a table (docs/formats/paths.md).");
  tabulated.required("file", &TabulatedJitter::file, file(), "the table, CSV");
  Record<JitterDocument> record(
      "jitter",
      "Random turns of the body about its own axes, drawn from the document's seed by time. Deviations are those of a long time.");
  const auto whole = [](auto type) {
    using Kind = decltype(type);
    return via([](JitterDocument& to, Kind kind) { to = std::move(kind); },
               [](const JitterDocument& of) { return std::get_if<Kind>(&of); });
  };
  record.exactly_one()
      .one("white", whole(WhiteJitter{}), white.type(), "the same power at all frequencies")
      .one("falling", whole(FallingJitter{}), falling.type(), "less at high frequencies")
      .one("table", whole(TabulatedJitter{}), tabulated.type(), "power densities from a file");
  return record.type();
}

SchemaType<ReportedPose> reported_type() {
  struct Angles {
    geodesy::Attitude angles;
  };
  const auto to_angles = [](const Angles& a) { return a.angles; };
  const auto from_angles = [](const geodesy::Attitude& a) { return Angles{a}; };
  Record<Angles> bias("attitude bias",
                      "What the reported attitude is turned by against the true one, about the body's axes."),
      noise("attitude noise", "Standard deviations of the reported attitude.");
  add_angles(bias, &Angles::angles, {"to the right", "nose up", "right wing down"});
  add_deviations(noise, &Angles::angles);
  const auto lengths = converted<math::Vec3>(
      tuple<double, 3>(quantity(kLength, Range::at_least(0.0, "m"))),
      [](const std::array<double, 3>& c) {
        return math::Vec3{c[0], c[1], c[2]};
      },
      [](math::Vec3 v) {
        return std::array{v.x, v.y, v.z};
      });
  Record<ReportedPose> record(
      "reported pose",
      "What the platform's receiver and inertial unit say of it: path and attitude without jitter, with errors. Places of pixels follow from "
      "this, rays from what is true.");
  record
      .with_default("position_bias", &ReportedPose::position_bias_m, displacement(),
                    R"(["0 m", "0 m", "0 m"])", "of the position: to the east, to the north, up")
      .with_default("position_noise", &ReportedPose::position_noise_m, lengths, R"(["0 m", "0 m", "0 m"])",
                    "its standard deviations")
      .optional("attitude_bias", &ReportedPose::attitude_bias,
                converted<geodesy::Attitude>(bias.type(), to_angles, from_angles), "of the attitude")
      .optional("attitude_noise", &ReportedPose::attitude_noise,
                converted<geodesy::Attitude>(noise.type(), to_angles, from_angles), "its standard deviations")
      .with_default("noise_up_to", &ReportedPose::noise_up_to_hz,
                    quantity(kFrequency, Range::between(1e-6, 1e5, "Hz")), "\"1 Hz\"",
                    "highest frequency of the noise, whose power is the same below")
      .optional(
          "mount",
          via(
              [](ReportedPose& to, std::vector<MountDocument> mounts) {
                to.mounts = std::make_shared<const MountList>(MountList{std::move(mounts)});
              },
              [](const ReportedPose& of) { return of.mounts ? &of.mounts->mounts : nullptr; }),
          mounts_type("How the camera is taken to be fixed to the body; what is not given is 0.", false),
          "of the camera as it was measured; if not given as it is. Angles that change are known");
  return record.type();
}

}  // namespace ifov::io
