#pragma once

#include "ifov/simulation.h"

namespace ifov::session {

struct Parts;

/// One path after another at each pixel, coarse first. Throws Cancelled.
Preview make_preview(const Parts& parts, const PreviewOptions& options);

}  // namespace ifov::session
