#pragma once

#include "ifov/outcome.h"

namespace ifov::cli {

/// Prints what a run made, what it cost and what accuracy it reached.
void print_summary(const Outcome& outcome);

}  // namespace ifov::cli
