#pragma once

#include <array>

#include "geodesy/attitude.h"
#include "io/document/platform_document.h"
#include "io/document/schema/record.h"

namespace ifov::io {

struct MountDocument;

/// Parts of the table of platforms.
SchemaType<PlatformAttitude> platform_attitude_type();
/// One mount, or several, each on the one before; `moves`: what turns them, too.
SchemaType<std::vector<MountDocument>> mounts_type(const char* doc, bool moves);
SchemaType<JitterDocument> jitter_type();
SchemaType<ReportedPose> reported_type();

/// A frame must be named, also where there is one alone.
template <class T>
void add_only_frame(Record<T>& record, const char* name, const char* doc) {
  record.required("frame", via([](T&, int) {}, [](const T&) { return 0; }), choice<int>({{name, 0}}), doc);
}

/// `yaw`, `pitch` and `roll` of a member of the record, by default 0.
template <class T>
void add_angles(Record<T>& record, geodesy::Attitude T::*angles, const std::array<const char*, 3>& docs) {
  const auto angle = [angles](auto member) { return path(angles, member); };
  record.with_default("yaw", angle(&geodesy::Attitude::yaw_rad), quantity(kAngle), "\"0 deg\"", docs[0])
      .with_default("pitch", angle(&geodesy::Attitude::pitch_rad),
                    quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "\"0 deg\"", docs[1])
      .with_default("roll", angle(&geodesy::Attitude::roll_rad), quantity(kAngle), "\"0 deg\"", docs[2]);
}

}  // namespace ifov::io
