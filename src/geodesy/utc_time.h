#pragma once

#include <string>
#include <string_view>

namespace ifov::geodesy {

/// An instant in UTC as a two-part (quasi) Julian date, as ERFA keeps it.
struct UtcTime {
  double jd1 = 0.0, jd2 = 0.0;
};

/// ISO 8601 extended: "2003-10-17T19:30:30Z", "2003-10-17T12:30:30.5-07:00", "2003-10-17T19:30Z", "2003-10-17" (0 h). A time of
/// day needs a zone: Z or +hh:mm. Leap seconds (23:59:60Z) are read where there was one. Throws InputError
/// that says what was found and what is expected.
UtcTime parse_utc(std::string_view text);

/// "2003-10-17T19:30:30.000Z".
std::string format_utc(UtcTime time);

}  // namespace ifov::geodesy
