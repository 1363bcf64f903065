#pragma once

#include "ifov/instruments.h"
#include "ifov/outcome.h"
#include "ifov/series.h"

namespace ifov::cli {

/// Prints what a run made, what it cost and what accuracy it reached.
void print_summary(const Outcome& outcome);
void print_summary(const SeriesOutcome& outcome);
void print_summary(const InstrumentsOutcome& outcome);

}  // namespace ifov::cli
