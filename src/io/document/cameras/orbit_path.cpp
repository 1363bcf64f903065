#include "io/document/cameras/orbit_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "core/format.h"
#include "core/overloaded.h"
#include "geodesy/orbit/free_orbit.h"
#include "geodesy/orbit/sgp4.h"
#include "geodesy/orbit/teme.h"
#include "geodesy/utc_seconds.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/platform_document.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

constexpr double kDay_s = 86400.0, kLongest_d = 30.0;

geodesy::TwoLineElements read_elements(const DocumentFile& named) {
  const TextFile file(std::filesystem::path(named.path));
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

namespace {

using Follow = std::function<geodesy::EcefPoint(double time_s)>;

Follow by_elements(const DocumentFile& file, const EarthTurnDocument& turn, geodesy::UtcTime time) {
  const geodesy::Sgp4 orbit(read_elements(file));
  const double minutes = 1440.0 * days_between(orbit.elements().epoch, time);
  return [orbit, minutes, time, turn, name = file.path](double t_s) {
    const geodesy::OrbitState state = orbit.after_minutes(minutes + t_s / 60.0);
    if (state.fault != geodesy::OrbitFault::none)
      throw InputError(format("'{}' gives no position {:.1f} days from its epoch: {}", name, minutes / 1440.0,
                              words_of(state.fault)));
    const geodesy::UtcTime then{time.jd1, time.jd2 + t_s / kDay_s};
    return geodesy::ecef_from_teme(then, orientation_of(turn))(state.position);
  };
}

/// Places are asked for in the order of time.
Follow by_state(const OrbitState& state, const EarthTurnDocument& turn, geodesy::UtcTime time) {
  const double days = days_between(state.epoch, time);
  if (!(std::abs(days) <= kLongest_d))
    throw InputError(format("the orbit's state is of {:.1f} days {} the image; expected at most {:g}",
                            std::abs(days), days > 0.0 ? "before" : "after", kLongest_d));
  const geodesy::EarthOrientation orientation = orientation_of(turn);
  const auto gcrs_from_ecef = geodesy::ecef_from_gcrs(state.epoch, orientation).inverse();
  const auto [x, y, z] = state.velocity_m_s;
  geodesy::CelestialState start{{state.position_m}, {{x, y, z}}};
  if (state.frame == PathFrame::ecef) {
    start.position = gcrs_from_ecef(geodesy::EcefPoint{state.position_m});
    // The ground's own speed there, about the axis that it turns about.
    const math::Vec3 axis = geodesy::ecef_from_rotating_equator(orientation).z().v,
                     ground =
                         geodesy::kEarthRotation_rad_s * math::cross(axis, state.position_m - math::Point3{});
    start.velocity_m_s = gcrs_from_ecef(geodesy::EcefVector{math::Vec3{x, y, z} + ground});
  } else if (state.frame == PathFrame::teme) {
    const auto gcrs_from_teme = gcrs_from_ecef * geodesy::ecef_from_teme(state.epoch, orientation);
    start.position = gcrs_from_teme(geodesy::TemePoint{state.position_m});
    start.velocity_m_s = gcrs_from_teme(geodesy::TemeVector{{x, y, z}});
  }
  const auto orbit =
      std::make_shared<geodesy::FreeOrbit>(start, gcrs_from_ecef(geodesy::EcefVector{{0.0, 0.0, 1.0}}));
  const double since_s = geodesy::tai_seconds_after(time, state.epoch);
  return [orbit, since_s, time, orientation](double t_s) {
    const geodesy::UtcTime then{time.jd1, time.jd2 + t_s / kDay_s};
    return geodesy::ecef_from_gcrs(then, orientation)(orbit->to(since_s + t_s).position);
  };
}

}  // namespace

OrbitPoints orbit_points(const OrbitPath& path, geodesy::UtcTime time, double from_s, double to_s) {
  constexpr double kStep_s = 1.0, kMore_s = 1.0, kLongest_s = kDay_s;
  if (to_s - from_s > kLongest_s)
    throw InputError(
        format("the lines are exposed for {:g} s; expected at most a day of an orbit", to_s - from_s));
  const Follow follow =
      std::visit(Overloaded{[&](const DocumentFile& file) { return by_elements(file, path.turn, time); },
                            [&](const OrbitState& state) { return by_state(state, path.turn, time); }},
                 path.source);
  const double first_s = from_s - kMore_s, last_s = to_s + kMore_s;
  const int steps = std::max(4, static_cast<int>(std::ceil((last_s - first_s) / kStep_s)));
  OrbitPoints points;
  for (int k = 0; k <= steps; ++k) {
    points.times_s.push_back(first_s + (last_s - first_s) * k / steps);
    points.places.push_back(follow(points.times_s.back()));
  }
  return points;
}

double orbit_age_days(const OrbitPath& path, geodesy::UtcTime time) {
  const geodesy::UtcTime epoch =
      std::visit(Overloaded{[](const DocumentFile& file) { return read_elements(file).epoch; },
                            [](const OrbitState& state) { return state.epoch; }},
                 path.source);
  return days_between(epoch, time);
}

}  // namespace ifov::io
