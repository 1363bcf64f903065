#pragma once

#include <string>

#include "core/run_control.h"

namespace ifov::cli {

/// One line that says how far a run is, at most `width` columns: share of pixels done, time left, rays per
/// second, share of finished pixels that reached their accuracy, worst error in units of its limit. A bar
/// takes the room that is left.
std::string progress_line(const Progress& progress, int width);

/// "850", "12.3 k", "4.56 M".
std::string short_count(double count);

/// "0:07", "12:05", "3:02:01".
std::string short_duration(double seconds);

}  // namespace ifov::cli
