#pragma once

#include "ifov/simulation.h"
#include "session/session.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// The document of a preview: the channels of its picture alone, at most `longest_px` pixels a side over the same
/// field of view, perfect optics, and no accuracy asked for.
io::Document for_preview(io::Document document, int longest_px);

/// One path after another at each pixel, coarse first. Throws Cancelled.
Preview make_preview(const Session& session, const PreviewOptions& options);

}  // namespace ifov::session
