#include "atmosphere/imported_runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

constexpr double kSameSun_rad = 1.0 * math::kDegree;

void check_geometry(const ImportedPath& path, const std::optional<SunAbove>& sun) {
  const PathGeometry& geometry = path.geometry;
  if (geometry.zenith_rad && *geometry.zenith_rad < 0.5 * std::numbers::pi && sees_ground(path))
    throw InputError(
        format("{}: the path looks up ({:.1f} deg from the zenith); expected one from the sensor down to "
               "the ground",
               path.source(), *geometry.zenith_rad / math::kDegree));
  if (!geometry.sun_zenith_rad || !sun) return;
  const double zenith_rad = std::acos(std::clamp(sun->cos_zenith, -1.0, 1.0));
  if (std::abs(zenith_rad - *geometry.sun_zenith_rad) > kSameSun_rad)
    throw InputError(
        format("{}: the Sun stands {:.1f} deg from the zenith; expected {:.1f} deg, as in the document",
               path.source(), *geometry.sun_zenith_rad / math::kDegree, zenith_rad / math::kDegree));
}

}  // namespace

bool sees_ground(const ImportedPath& path) {
  using Q = PathQuantity;
  constexpr Q kOfSight[] = {Q::ground_sensor_transmittance, Q::total_radiance, Q::solar_path_radiance,
                            Q::thermal_path_radiance};
  return std::any_of(std::begin(kOfSight), std::end(kOfSight),
                     [&](Q quantity) { return path.has(quantity); });
}

RunQuantities::RunQuantities(const ImportedRuns& given, const std::optional<SunAbove>& sun) : given_(given) {
  if (given.runs.empty()) throw InputError("found no run over ground; expected one to three");
  const auto darkest = std::min_element(given.albedo.begin(), given.albedo.end());
  const auto brightest = std::max_element(given.albedo.begin(), given.albedo.end());
  dark_ = static_cast<std::size_t>(darkest - given.albedo.begin());
  bright_ = static_cast<std::size_t>(brightest - given.albedo.begin());
  for (const ImportedPath& run : given.runs) check_geometry(run, sun);
  for (const ImportedPath& light : given.lights) check_geometry(light, sun);
}

RunQuantities::Column RunQuantities::of_dark(PathQuantity quantity) const {
  const auto column = dark().column(quantity);
  return {column.begin(), column.end()};
}

RunQuantities::Column RunQuantities::any(PathQuantity quantity) const {
  if (dark().has(quantity)) return of_dark(quantity);
  for (const ImportedPath& run : given_.runs)
    if (run.has(quantity)) return {run.column(quantity).begin(), run.column(quantity).end()};
  return of_lights(quantity);
}

RunQuantities::Column RunQuantities::of_lights(PathQuantity quantity) const {
  for (const ImportedPath& light : given_.lights) {
    if (!light.has(quantity)) continue;
    const radiometry::Spectrum spectrum = light.spectrum(quantity);
    Column values;
    for (const double um : dark().wavelength_um()) values.push_back(spectrum.at(um));
    return values;
  }
  return {};
}

void RunQuantities::missing(std::string_view what, PathQuantity quantity, std::string_view advice) const {
  std::string told;
  try {
    dark().need(quantity);
  } catch (const InputError& error) {
    told = error.what();
  }
  throw InputError(format("{}{}{}; {}", told, told.empty() ? "" : ": ", what, advice));
}

}  // namespace ifov::atmosphere
