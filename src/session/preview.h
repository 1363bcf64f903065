#pragma once

#include "ifov/simulation.h"

namespace ifov::session {

class Session;

/// One path after another at each pixel, coarse first. Throws Cancelled.
Preview make_preview(const Session& session, const PreviewOptions& options);

}  // namespace ifov::session
