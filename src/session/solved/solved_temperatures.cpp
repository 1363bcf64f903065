#include "session/solved/solved_temperatures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "core/parallel.h"
#include "exposure/exposed_point.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "radiometry/spectral_nodes.h"
#include "scene/scene.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/assembly/whole/camera_grid.h"
#include "session/loaded/parts.h"
#include "session/solved/document_outdoors.h"

namespace ifov::session {
namespace {

constexpr double kSunRadius_rad = 0.00465;  // at 1 au, of 6.957e8 m
constexpr int kAcross = 24;                 // rays along each side of the image
constexpr std::size_t kMeasured = 64;
constexpr int kSkyPairs = 128;
constexpr double kWarm_um = 3.0;  // surfaces emit beyond it

/// Where the document first asks for a solved temperature.
SourcePosition asked_at(const io::Document& document) {
  const auto solved = [](const std::optional<io::TemperatureDocument>& temperature) {
    return temperature && std::holds_alternative<io::SolvedTemperatureDocument>(temperature->value);
  };
  for (const io::MaterialDocument& material : document.scene.materials)
    if (solved(material.temperature)) return material.temperature->position;
  for (const auto& object : document.scene.objects)
    if (solved(object.temperature)) return object.temperature->position;
  return {};
}

/// What a material is solved from, and its classes.
struct Solved {
  ThermalMaterial thermal;
  std::shared_ptr<const thermal::SurfaceClasses> classes;
};

thermal::Stand open_stand(const DocumentOutdoors& about) {
  thermal::Stand stand;
  stand.terrain = about.terrain;
  return stand;
}

ThermalMaterial thermal_of(const io::Document& document, const io::MaterialDocument& source,
                           const scene::Scene& scene, std::uint32_t material, double deep_k) {
  if (auto thermal = assemble_thermal(document.sources, source, scene.materials[material], deep_k))
    return std::move(*thermal);
  throw io::document_error(
      document.sources, source.position,
      format(
          "the temperature of '{}' is to be solved, and it has neither \"thermal\" nor a reflectance of the "
          "library, of which it is known what it stands on",
          source.name));
}

/// The Sun of the image is the one that warmed the scene, unless the document has put it elsewhere.
void warn_of_another_sun(const scene::Scene& scene, const thermal::Outdoors& now, LogSink& log) {
  constexpr double kApart_deg = 3.0;
  if (!scene.sun || scene.sun->is_moon) return;
  const double level = std::cos(now.sun_elevation_rad);
  const math::Vec3 there{level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
                         std::sin(now.sun_elevation_rad)};
  const double apart_deg =
      std::acos(std::clamp(math::dot(there, scene.sun->direction), -1.0, 1.0)) * 180.0 / std::numbers::pi;
  if (apart_deg > kApart_deg)
    log.warn(format(
        "the Sun of 'light' stands {:.0f} deg from where it stood at the document's 'time', by which temperatures "
        "are solved: its shadows and theirs do not go together",
        apart_deg));
}

/// The temperature of a point that is solved in full by itself.
double full_solution_k(const Solved& solved, const thermal::OutdoorsSeries& series, thermal::Stand stand,
                       math::Vec3 normal, const exposure::SolvedSurface::Exposure& exposure) {
  stand.tilt_rad = std::acos(std::clamp(normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(normal.x, normal.y);
  stand.free_sky = exposure.free_sky;
  std::vector<double> visibility(series.rows.size(), 0.0);
  for (std::size_t k = 0; k < exposure.visibility.size(); ++k)
    visibility[solved.classes->row_of_series(k)] = exposure.visibility[k];
  const thermal::SurfaceSolution solution = thermal::solve_surface(
      solved.thermal.solid, solved.thermal.skin, stand, series, solved.thermal.start, std::move(visibility));
  return solution.history.nodes.back().surface_k;
}

/// By what a level surface in the open is off by the length of steps: twice as long ones make four times the error.
double step_error_k(const Solved& solved, const thermal::OutdoorsSeries& series,
                    const thermal::Stand& stand) {
  thermal::OutdoorsSeries every_other = series;
  every_other.step_s *= 2.0;
  every_other.rows.clear();
  for (std::size_t row = (series.rows.size() - 1) % 2; row < series.rows.size(); row += 2)
    every_other.rows.push_back(series.rows[row]);
  const auto last_k = [&](const thermal::OutdoorsSeries& of) {
    return thermal::solve_surface(solved.thermal.solid, solved.thermal.skin, stand, of, solved.thermal.start)
        .history.nodes.back()
        .surface_k;
  };
  return std::abs(last_k(every_other) - last_k(series)) / 3.0;
}

}  // namespace

std::optional<TemperatureErrors> solve_temperatures(const io::Document& document,
                                                    const atmosphere::WeatherSeries* weather,
                                                    const sensor::Camera& camera, scene::Scene& scene,
                                                    int threads, LogSink* log) {
  std::map<std::uint32_t, Solved> by_material;
  for (const scene::SurfaceState& state : scene.states)
    if (state.solved > 0) by_material[state.solved - 1];
  if (by_material.empty()) {
    scene.solved.clear();
    return std::nullopt;
  }
  const auto missing = [&](const char* what) {
    return io::document_error(document.sources, asked_at(document), what);
  };
  if (!document.time)
    throw missing("a temperature that is solved needs a \"time\", and weather of the day before it");
  if (weather == nullptr)
    throw missing(
        "a temperature that is solved needs \"weather\": a file with air temperature, wind and sunlight, such as "
        "\"weather\": {\"file\": \"amsterdam.epw\"}");
  const DocumentOutdoors about = outdoors_of_document(document, *weather);
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  const thermal::Stand stand = open_stand(about);
  for (auto& [material, solved] : by_material) {
    solved.thermal =
        thermal_of(document, document.scene.materials[material], scene, material, about.mean_air_k);
    solved.classes = std::make_shared<const thermal::SurfaceClasses>(
        series, thermal::ClassSurface{solved.thermal.solid, solved.thermal.skin, stand, solved.thermal.start},
        threads);
    scene.solved[material] =
        std::make_shared<const exposure::SolvedSurface>(solved.classes, *scene.world, kSunRadius_rad);
  }

  TemperatureErrors errors;
  for (const auto& [material, solved] : by_material)
    errors.step_k = std::max(errors.step_k, step_error_k(solved, series, stand));
  struct Point {
    const geometry::SurfacePoint* at;
    std::uint32_t material;
    double off_k = 0.0;
  };
  const std::vector<geometry::SurfacePoint> seen = hits_of_camera(*scene.world, camera, kAcross);
  std::vector<Point> points;
  for (const geometry::SurfacePoint& point : seen) {
    if (!point.hit()) continue;
    const scene::ResolvedSurface surface = scene.resolve_without_temperature(point);
    const std::uint32_t by = scene.states[surface.constituents[0].state].solved;
    if (by > 0) points.push_back({&point, by - 1});
  }
  if (points.size() > kMeasured) {
    std::vector<Point> some;
    for (std::size_t k = 0; k < kMeasured; ++k) some.push_back(points[k * points.size() / kMeasured]);
    points = std::move(some);
  }
  parallel_for(static_cast<std::int64_t>(points.size()), threads, [&](std::int64_t k) {
    Point& point = points[static_cast<std::size_t>(k)];
    const Solved& solved = by_material.at(point.material);
    const exposure::SolvedSurface surface(solved.classes, *scene.world, kSunRadius_rad);
    const auto exposure = surface.exposure(*point.at, static_cast<std::uint64_t>(k), kSkyPairs, 1);
    point.off_k = surface.temperature_k(*point.at, exposure) -
                  full_solution_k(solved, series, stand,
                                  exposure::ExposedPoint(*scene.world, *point.at).normal(), exposure);
  });
  errors.points = static_cast<int>(points.size());
  for (const Point& point : points) {
    const double share = 1.0 / static_cast<double>(points.size());
    errors.bias_k += share * point.off_k;
    errors.rms_k += share * point.off_k * point.off_k;
    errors.worst_k = std::max(errors.worst_k, std::abs(point.off_k));
  }
  errors.rms_k = std::sqrt(errors.rms_k);
  errors.weather = about.statement;
  for (const std::string& note : about.outdoors.notes) errors.weather += "; " + note;
  if (log != nullptr) warn_of_another_sun(scene, series.rows.back(), *log);
  return errors;
}

void count_temperature_errors(Parts& parts, LogSink& log) {
  if (!parts.temperature_errors) return;
  const double half_width_k = parts.temperature_errors->half_width_k();
  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  if (request != nullptr && request->unit == render::ErrorUnit::kelvin && request->error < half_width_k)
    throw InputError(format(
        "an accuracy of {:g} K is asked for, and temperatures that are solved may themselves be off by {:.2f} K: "
        "{}. Ask for {:.1f} K or more",
        request->error, half_width_k, parts.temperature_errors->statement(),
        std::ceil(20.0 * half_width_k) / 10.0));
  const std::size_t channels = parts.nodes->channel_count();
  std::vector<double> cooler(channels), warmer(channels);
  const scene::TemperatureRange range = *parts.scene.mapped_temperatures();
  const double middle_k = 0.5 * (range.coldest_k + range.hottest_k);
  parts.nodes->planck_channels(middle_k - 0.5, cooler);
  parts.nodes->planck_channels(middle_k + 0.5, warmer);
  parts.node_errors.resize(channels);
  bool too_fine = false;
  for (std::size_t c = 0; c < channels; ++c) {
    const double emitted = half_width_k * (warmer[c] - cooler[c]);
    parts.node_errors[c].emitted = emitted;
    too_fine = too_fine || (request != nullptr && request->unit == render::ErrorUnit::percent &&
                            parts.channels[c].centre_um > kWarm_um &&
                            emitted > request->error * 0.5 * (cooler[c] + warmer[c]));
  }
  if (too_fine)
    log.warn(format(
        "temperatures that are solved may be off by {:.2f} K, which is more than the {:g} % that are asked for: {}",
        half_width_k, 100.0 * request->error, parts.temperature_errors->statement()));
}

}  // namespace ifov::session
