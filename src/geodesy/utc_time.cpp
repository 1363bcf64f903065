#include "geodesy/utc_time.h"

#include <erfa.h>

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "geodesy/utc_seconds.h"

namespace ifov::geodesy {
namespace {

/// Reads the parts of a time one after the other; any part that is not there is an error about the whole
/// text.
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : all_(text), rest_(text) {}

  int number(std::size_t digits) {
    if (rest_.size() < digits) fail();
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (rest_[i] < '0' || rest_[i] > '9') fail();
      value = 10 * value + (rest_[i] - '0');
    }
    rest_.remove_prefix(digits);
    return value;
  }

  double seconds() {
    double value = number(2);
    if (!rest_.empty() && (rest_[0] == '.' || rest_[0] == ',')) {
      rest_.remove_prefix(1);
      if (rest_.empty() || rest_[0] < '0' || rest_[0] > '9') fail();
      for (double unit = 0.1; !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9'; unit *= 0.1) {
        value += unit * (rest_[0] - '0');
        rest_.remove_prefix(1);
      }
    }
    return value;
  }

  void expect(char symbol) {
    if (rest_.empty() || rest_[0] != symbol) fail();
    rest_.remove_prefix(1);
  }

  /// Minutes by which the zone is ahead of UTC.
  int zone_minutes() {
    if (rest_ == "Z" || rest_ == "z") {
      rest_ = {};
      return 0;
    }
    if (rest_.empty() || (rest_[0] != '+' && rest_[0] != '-')) fail();
    const int sign = rest_[0] == '-' ? -1 : 1;
    rest_.remove_prefix(1);
    const int hours = number(2);
    expect(':');
    const int minutes = number(2);
    if (hours > 14 || minutes > 59 || !rest_.empty()) fail();
    return sign * (60 * hours + minutes);
  }

  bool empty() const { return rest_.empty(); }
  bool is_next(char symbol) const { return !rest_.empty() && rest_[0] == symbol; }

  [[noreturn]] void fail() const {
    throw InputError(
        format("found the time '{}'; expected ISO 8601 with a zone, such as "
               "'2003-10-17T19:30:30Z' or '2003-10-17T12:30:30-07:00'",
               all_));
  }

 private:
  std::string_view all_, rest_;
};

}  // namespace

UtcTime parse_utc(std::string_view text) {
  TimeReader reader(text);
  const int year = reader.number(4);
  reader.expect('-');
  const int month = reader.number(2);
  reader.expect('-');
  const int day = reader.number(2);
  int hour = 0, minute = 0, zone = 0;
  double second = 0.0;
  if (!reader.empty()) {
    reader.expect('T');
    hour = reader.number(2);
    reader.expect(':');
    minute = reader.number(2);
    if (reader.is_next(':')) {
      reader.expect(':');
      second = reader.seconds();
    }
    zone = reader.zone_minutes();
  }
  UtcTime time;
  // In a zone other than UTC, a 60th second cannot be told from a slip; ERFA checks it where the zone is UTC.
  if (zone != 0 && second >= 60.0) reader.fail();
  const int status = eraDtf2d("UTC", year, month, day, hour, minute, second, &time.jd1, &time.jd2);
  if (status < 0 || status > 1) reader.fail();  // 1: a year for which leap seconds are not known
  time.jd2 -= zone / 1440.0;
  return time;
}

std::string format_utc(UtcTime time) {
  int year = 0, month = 0, day = 0, hms[4] = {};
  eraD2dtf("UTC", 3, time.jd1, time.jd2, &year, &month, &day, hms);
  return format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", year, month, day, hms[0], hms[1], hms[2],
                hms[3]);
}

double tai_seconds_after(UtcTime time, UtcTime other) {
  UtcTime tai[2];
  int which = 0;
  for (const UtcTime utc : {time, other}) {
    // 1 is a warning: leap seconds for that year are not known.
    if (eraUtctai(utc.jd1, utc.jd2, &tai[which].jd1, &tai[which].jd2) < 0)
      throw InputError(format("leap seconds are not known at {}", format_utc(utc)));
    ++which;
  }
  return 86400.0 * ((tai[0].jd1 - tai[1].jd1) + (tai[0].jd2 - tai[1].jd2));
}

double seconds_after(UtcTime time, UtcTime other) {
  // Days hold an instant to some 1e-11 s, and not the same of it in every zone.
  constexpr double kDay_s = 86400.0, kPerSecond = 1e6;
  const double seconds = kDay_s * ((time.jd1 - other.jd1) + (time.jd2 - other.jd2));
  return std::round(kPerSecond * seconds) / kPerSecond;
}

}  // namespace ifov::geodesy
