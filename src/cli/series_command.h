#pragma once

#include "cli/exit_code.h"
#include "ifov/series.h"

namespace ifov::cli {

class Console;

/// `ifov render --times`: renders, and prints what there is of all times. Throws as render_series() does.
ExitCode render_times(const Document& document, const std::string& times, const SeriesOptions& options,
                      Console& console, bool quiet);

/// Throws InputError where a document is given a time as well.
void require_no_time(const std::vector<std::string>& set);

}  // namespace ifov::cli
