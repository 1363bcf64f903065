#pragma once

#include "session/run.h"

namespace ifov::cli {

/// Prints what a run made, what it cost and what accuracy it reached.
void print_summary(const session::RunResult& result);

}  // namespace ifov::cli
