#pragma once

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

}  // namespace ifov::io
