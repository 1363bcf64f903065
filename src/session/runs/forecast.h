#pragma once

#include "ifov/simulation.h"
#include "session/runs/run.h"

namespace ifov::session {

/// Renders a few small pieces spread over the image, at the document's settings, and scales up. Takes seconds
/// to a minute. Throws Cancelled, and what a run would throw that may not keep or refine.
Forecast forecast_run(const Session& session, const RunRequest& request);

}  // namespace ifov::session
