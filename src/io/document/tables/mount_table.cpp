#include <array>
#include <utility>

#include "core/format.h"
#include "io/document/mount_document.h"
#include "io/document/schema/shared_target.h"
#include "io/document/sensor_document.h"
#include "io/document/tables/framed_place.h"
#include "io/document/tables/platform_tables.h"
#include "io/document/tables/sensor_tables.h"

namespace ifov::io {
namespace {

SchemaType<FramedPoint> tracked_point_type() {
  struct Entry {
    PlaceEntry place;
  };
  Record<Entry> record("tracked point", "Where a gimbal looks at all times.");
  add_place(record, &Entry::place, "position", "the place");
  return converted<FramedPoint>(
      record.type(), [](const Entry& entry) { return point_of(entry.place); },
      [](const FramedPoint& point) { return Entry{entry_of_point(point)}; });
}

struct GimbalEntry {
  GimbalDocument gimbal;
  std::optional<math::Vec3> offset_m;
  SourcePosition position;
};

SchemaType<GimbalDocument> gimbal_type() {
  using Gimbal = GimbalDocument;
  const auto limits = [](double least_deg, double most_deg) {
    return tuple<double, 2>(quantity(kAngle, Range::between(least_deg, most_deg, "deg")));
  };
  const auto of = [](auto member) { return path(&GimbalEntry::gimbal, member); };
  const auto whole = [](auto type) {
    using Kind = decltype(type);
    return via([](GimbalEntry& to, Kind kind) { to.gimbal.target = std::move(kind); },
               [](const GimbalEntry& from) { return std::get_if<Kind>(&from.gimbal.target); });
  };
  const auto name = via(
      [](GimbalEntry& to, DocumentName object) {
        to.gimbal.target = TrackedObject{std::move(object), {}};
      },
      [](const GimbalEntry& from) {
        const auto* object = std::get_if<TrackedObject>(&from.gimbal.target);
        return object != nullptr ? &object->name : nullptr;
      });
  Record<GimbalEntry> record(
      "gimbal",
      "Two axes that keep the camera's axis towards a point or an object, whatever carries it does.");
  record.exactly_one()
      .one("point", whole(FramedPoint{}), tracked_point_type(), "what it looks at: a place")
      .one("object", name, name_of("an object"),
           "or one of the scene's objects, with a `motion`: what its path leads through")
      .optional("offset", &GimbalEntry::offset_m, displacement(),
                "from what the object's path leads through to what is looked at, to its right, ahead and up")
      .needs("offset", "object")
      .with_default(
          "axes", of(&Gimbal::axes),
          choice<Gimbal::Axes>(
              {{"pitch roll", Gimbal::Axes::pitch_roll}, {"pan tilt", Gimbal::Axes::pan_tilt}}),
          "\"pitch roll\"",
          "of which the first is the outer one. `pitch roll`: the top of the image stays at the nose, and what is straight to the "
          "side cannot be looked at. `pan tilt`: yaw about the belly and pitch away from it, the top of the image away from the "
          "belly; what is straight below cannot be looked at")
      .optional("yaw", of(&Gimbal::yaw_rad), limits(-180.0, 180.0),
                "least and largest angle of `pan tilt`: to the right; no limits if not given")
      .optional("pitch", of(&Gimbal::pitch_rad), limits(-180.0, 180.0),
                "least and largest angle: from the belly to the nose")
      .optional("roll", of(&Gimbal::roll_rad), limits(-90.0, 90.0),
                "least and largest angle of `pitch roll`: from the belly to the left")
      .with_default(
          "at_limits", of(&Gimbal::at_limits),
          choice<Gimbal::AtLimits>({{"refuse", Gimbal::AtLimits::refuse}, {"stop", Gimbal::AtLimits::stop}}),
          "\"refuse\"",
          "where the target is beyond its limits while the image is taken: an error, or it stands at its limits and looks past the target")
      .optional(
          "rate", of(&Gimbal::rate_rad_s), quantity(kTurnRate, Range::above(0.0, "deg/s")),
          "how fast each axis turns at most; where the target needs more is an error; no limit if not given")
      .with_default(
          "jitter_share", of(&Gimbal::jitter_share), fraction(Range::between(0.0, 1.0)), "0",
          "share of the platform's `jitter` that reaches the camera all the same; it takes out the rest")
      .check([](const GimbalEntry& entry, const DocumentNode& node) {
        const Gimbal& gimbal = entry.gimbal;
        for (const auto& [key, limit] :
             {std::pair{"yaw", &gimbal.yaw_rad}, std::pair{"pitch", &gimbal.pitch_rad},
              std::pair{"roll", &gimbal.roll_rad}})
          if (*limit && !((**limit)[0] < (**limit)[1]))
            node.given(key).fail(format("{}: found limits that do not increase", node.given(key).title()));
        const bool pans = gimbal.axes == Gimbal::Axes::pan_tilt;
        const char* other = pans ? "roll" : "yaw";
        if (pans ? gimbal.roll_rad.has_value() : gimbal.yaw_rad.has_value())
          node.given(other).fail(format("{}: the gimbal's 'axes' are \"{}\"; expected limits of {}",
                                        node.given(other).title(), pans ? "pan tilt" : "pitch roll",
                                        pans ? "'yaw' and 'pitch'" : "'pitch' and 'roll'"));
      });
  return converted<Gimbal>(
      record.type(),
      [](GimbalEntry entry) {
        if (auto* object = std::get_if<TrackedObject>(&entry.gimbal.target))
          object->offset_m = entry.offset_m.value_or(math::Vec3{});
        entry.gimbal.position = entry.position;
        return std::move(entry.gimbal);
      },
      [](const Gimbal& gimbal) {
        GimbalEntry entry{gimbal, {}, gimbal.position};
        if (const auto* object = std::get_if<TrackedObject>(&gimbal.target))
          if (!(object->offset_m == math::Vec3{})) entry.offset_m = object->offset_m;
        return entry;
      });
}

SchemaType<geodesy::Attitude> turn_type(const char* name, const char* doc) {
  struct Angles {
    geodesy::Attitude angles;
  };
  Record<Angles> record(name, doc);
  add_angles(record, &Angles::angles, {"to the right", "nose up", "right wing down"});
  return converted<geodesy::Attitude>(
      record.type(), [](const Angles& a) { return a.angles; },
      [](const geodesy::Attitude& a) { return Angles{a}; });
}

SchemaType<StepStareDocument> step_stare_type() {
  using Steps = StepStareDocument;
  const SchemaType<double> duration = quantity(kDuration, Range::above(0.0, "s"));
  Record<Steps> record(
      "step and stare",
      "Angles that are held for a time and then turned to the next ones, and from the last to the first.");
  record
      .required("first", &Steps::first, turn_type("first stare", "Where the first stare looks."),
                "angles of the first stare")
      .required("step", &Steps::step, turn_type("step", "From stare to stare."),
                "what is added from stare to stare")
      .required("steps", &Steps::steps, integer(1, 100000), "how many stares there are")
      .required("period", &Steps::period_s, duration, "from stare to stare")
      .with_default("slew", &Steps::slew_s, quantity(kDuration, Range::at_least(0.0, "s")), "\"0 s\"",
                    "at the end of each period, for which it turns on as a raised cosine")
      .with_default("start", &Steps::start_s, quantity(kDuration), "\"0 s\"",
                    "when the first stare begins, after the document's `time`")
      .check([](const Steps& steps, const DocumentNode& node) {
        if (!(steps.slew_s < steps.period_s))
          node.given("slew").fail(
              format("{} leaves no time to stare: expected less than the period of {:g} s",
                     node.given("slew").title(), steps.period_s));
      });
  return record.type();
}

SchemaType<TurnTableDocument> turn_table_type() {
  Record<TurnTableDocument> record("table of a mount",
                                   "Angles by time from a table (docs/formats/paths.md).");
  record.required("file", &TurnTableDocument::file, file(), "the table, CSV");
  return record.type();
}

}  // namespace

SchemaType<std::vector<MountDocument>> mounts_type(const char* doc, bool moves) {
  Record<MountDocument> record("mount", doc);
  record.with_default(
      "lever_arm", &MountDocument::lever_arm_m, displacement(), R"(["0 m", "0 m", "0 m"])",
      "from the platform's position to the camera, along the body's nose, right wing and belly");
  add_angles(record, &MountDocument::boresight,
             {"of the camera against the body: to the right", "nose up", "right wing down"});
  if (moves)
    record.at_most_one()
        .one("gimbal", &MountDocument::bearing, gimbal_type(),
             "turns it towards a point or an object, from these angles")
        .one("step_stare", &MountDocument::bearing, step_stare_type(), "turns it in steps")
        .one("table", &MountDocument::bearing, turn_table_type(), "turns it as a file says");
  constexpr std::size_t kMostMounts = 8;
  using Mounts = std::vector<MountDocument>;
  return either(converted<Mounts>(
                    record.type(), [](MountDocument mount) { return Mounts{std::move(mount)}; },
                    [](const Mounts& mounts) {
                      return mounts.size() == 1 ? std::optional(mounts.front()) : std::nullopt;
                    }),
                list(record.type(), 1, kMostMounts));
}

void add_own_mounts(Record<SensorDocument>& record) {
  const auto own_mounts = located<MountList>(
      mounts_type("How the camera is carried by the body, or by the mount before it in a list.", true),
      [](std::vector<MountDocument> mounts, const DocumentNode& node) {
        return MountList{std::move(mounts), node.key_position()};
      },
      [](const MountList& list) { return list.mounts; });
  record.optional(
      "mount", shared(&SensorDocument::mounts), own_mounts,
      "of this camera, or a list of mounts, on those of the document's `platform`: where it is beside other "
      "instruments, and how it is turned against them");
}

}  // namespace ifov::io
