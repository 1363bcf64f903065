#pragma once

#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// By how many seconds of UTC a time is after another; days with a leap second count 86400.
double seconds_after(UtcTime time, UtcTime other);

/// By how many seconds of atomic time it is. InputError for years that ERFA refuses.
double tai_seconds_after(UtcTime time, UtcTime other);

}  // namespace ifov::geodesy
