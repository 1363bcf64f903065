#pragma once

#include "core/run_control.h"

namespace ifov::cli {

/// From here on Ctrl-C (SIGINT) and SIGTERM set the token returned, which lives as long as the program; a
/// second one ends the program at once.
CancelToken& cancel_on_interrupt();

}  // namespace ifov::cli
