#include "io/document/cameras/orbit_path.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/format.h"
#include "geodesy/orbit/sgp4.h"
#include "geodesy/orbit/teme.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/platform_document.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

constexpr double kDay_s = 86400.0;

geodesy::TwoLineElements read_elements(const OrbitPath& path) {
  const TextFile file(std::filesystem::path(path.file.path));
  for (int line = 1; line < file.line_count(); ++line) {
    if (!file.line(line).starts_with("1 ") || !file.line(line + 1).starts_with("2 ")) continue;
    try {
      return geodesy::parse_two_line_elements(file.line(line), file.line(line + 1));
    } catch (const InputError& error) {
      const bool second = std::string_view(error.what()).find("line 2 of") != std::string_view::npos;
      file.fail(second ? line + 1 : line, 0, error.what());
    }
  }
  file.fail(0, 0,
            "found no two-line elements; expected a line that begins with '1 ' and after it one with '2 '");
}

double days_between(geodesy::UtcTime from, geodesy::UtcTime to) {
  return (to.jd1 - from.jd1) + (to.jd2 - from.jd2);
}

const char* words_of(geodesy::OrbitFault fault) {
  switch (fault) {
    case geodesy::OrbitFault::none: return "";
    case geodesy::OrbitFault::eccentricity: return "its mean eccentricity is not from 0 to 1";
    case geodesy::OrbitFault::mean_motion: return "its mean motion is negative";
    case geodesy::OrbitFault::perturbed_eccentricity:
      return "its eccentricity, perturbed by Moon and Sun, is not from 0 to 1";
    case geodesy::OrbitFault::semi_latus_rectum: return "its semi-latus rectum is negative";
    case geodesy::OrbitFault::decayed: return "it has decayed";
  }
  return "";
}

}  // namespace

OrbitPoints orbit_points(const OrbitPath& path, geodesy::UtcTime time, double from_s, double to_s) {
  constexpr double kStep_s = 1.0, kMore_s = 1.0, kLongest_s = kDay_s;
  if (to_s - from_s > kLongest_s)
    throw InputError(
        format("the lines are exposed for {:g} s; expected at most a day of an orbit", to_s - from_s));
  const geodesy::Sgp4 orbit(read_elements(path));
  const double minutes = 1440.0 * days_between(orbit.elements().epoch, time);
  const double first_s = from_s - kMore_s, last_s = to_s + kMore_s;
  const int steps = std::max(4, static_cast<int>(std::ceil((last_s - first_s) / kStep_s)));
  OrbitPoints points;
  for (int k = 0; k <= steps; ++k) {
    const double t_s = first_s + (last_s - first_s) * k / steps;
    const geodesy::OrbitState state = orbit.after_minutes(minutes + t_s / 60.0);
    if (state.fault != geodesy::OrbitFault::none)
      throw InputError(format("'{}' gives no position {:.1f} days from its epoch: {}", path.file.path,
                              minutes / 1440.0, words_of(state.fault)));
    const geodesy::UtcTime then{time.jd1, time.jd2 + t_s / kDay_s};
    points.times_s.push_back(t_s);
    points.places.push_back(geodesy::ecef_from_teme(then, orientation_of(path.turn))(state.position));
  }
  return points;
}

double orbit_age_days(const OrbitPath& path, geodesy::UtcTime time) {
  return days_between(read_elements(path).epoch, time);
}

}  // namespace ifov::io
