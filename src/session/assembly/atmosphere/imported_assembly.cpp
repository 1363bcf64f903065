#include "session/assembly/atmosphere/imported_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/imported_light.h"
#include "core/names.h"
#include "io/atmosphere/import_paths.h"
#include "io/document/atmosphere_document.h"
#include "io/document/light_document.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using atmosphere::ImportedPath;
using atmosphere::PathQuantity;

constexpr std::size_t kMostRuns = 3;
/// Nodes of a channel at most, and the error they may leave: every node is a column that all paths carry.
constexpr std::size_t kMostImportedNodes = 8;
constexpr double kImportedTolerance = 3e-3;
constexpr double kSameAlbedo = 0.01;
/// Lines of sight this far from the run's get a warning.
constexpr double kSameView_rad = 3.0 * std::numbers::pi / 180.0;

constexpr PathQuantity kIrradiances[] = {PathQuantity::direct_irradiance, PathQuantity::diffuse_irradiance,
                                         PathQuantity::global_irradiance, PathQuantity::upward_irradiance};

bool has_irradiance(const ImportedPath& path) {
  return std::any_of(std::begin(kIrradiances), std::end(kIrradiances),
                     [&](PathQuantity quantity) { return path.has(quantity); });
}

/// uvspec states radiance and irradiance of each altitude: the highest one is the sensor's, the lowest the
/// ground's.
std::vector<ImportedPath> with_ground_irradiance(std::vector<ImportedPath> paths) {
  const auto altitude = [](const ImportedPath& path) {
    return path.geometry.sensor_altitude_km.value_or(0.0);
  };
  if (paths.empty() || !has_irradiance(paths[0]) || !paths[0].geometry.sensor_altitude_km) return paths;
  const auto [low, high] = std::minmax_element(
      paths.begin(), paths.end(), [&](const auto& a, const auto& b) { return altitude(a) < altitude(b); });
  if (!paths[0].has(PathQuantity::total_radiance)) return {*low};
  const ImportedPath ground = *low;
  const double top_km = altitude(*high);
  std::vector<ImportedPath> seen;
  for (ImportedPath& path : paths) {
    if (altitude(path) != top_km ||
        path.geometry.zenith_rad.value_or(std::numbers::pi) < 0.5 * std::numbers::pi)
      continue;
    for (const PathQuantity quantity : kIrradiances) {
      const auto column = ground.column(quantity);
      path.set(quantity, altitude(ground) < top_km || top_km <= 0.0
                             ? std::vector<double>(column.begin(), column.end())
                             : std::vector<double>{});
    }
    seen.push_back(std::move(path));
  }
  return seen;
}

/// What the run itself says, else the document; a single run of neither is over black ground.
double albedo_of(const ImportedPath& run, std::size_t index, std::size_t count,
                 const std::vector<double>& given) {
  const std::optional<double> stated = run.surface_albedo();
  if (index >= given.size()) {
    if (!stated && count > 1)
      throw InputError(
          format("{} does not say the albedo of its ground; give 'albedos', one for each of the {} runs",
                 run.source(), count));
    return std::max(0.0, stated.value_or(0.0));
  }
  if (stated && std::abs(*stated - given[index]) > kSameAlbedo)
    throw InputError(
        format("{} is over ground of albedo {:.3g}, and 'albedos' says {:g}; expected the same, in the order "
               "of the runs",
               run.source(), *stated, given[index]));
  return given[index];
}

atmosphere::ImportedRuns read_runs(const io::DocumentSources& sources, const io::ImportedDocument& source,
                                   std::optional<double> sun_zenith_rad) {
  atmosphere::ImportedRuns runs;
  for (std::size_t k = 0; k < source.files.size(); ++k) {
    with_position(sources, source.files[k].position, [&] {
      io::ImportOptions options;
      options.sun_zenith_rad = sun_zenith_rad;
      if (!source.uvspec_inputs.empty()) options.uvspec_input = source.uvspec_inputs[k].path;
      for (ImportedPath& path : with_ground_irradiance(io::import_paths(source.files[k].path, options)))
        (atmosphere::sees_ground(path) ? runs.runs : runs.lights).push_back(std::move(path));
    });
  }
  const auto names_of = [&] {
    std::vector<std::string> names;
    for (const ImportedPath& run : runs.runs) names.push_back(run.source());
    return list_names(names, "and", 6);
  };
  if (runs.runs.empty())
    throw InputError(
        "the files hold no path from the ground to a sensor; expected one to three runs with radiance or "
        "transmittance");
  if (runs.runs.size() > kMostRuns)
    throw InputError(
        format("the files hold {} paths: {}; expected one to three, over grounds of different albedo, for "
               "one line of sight",
               runs.runs.size(), names_of()));
  if (!source.albedos.empty() && source.albedos.size() != runs.runs.size())
    throw InputError(format("'albedos' has {} numbers and the files hold {} runs: {}; expected one for each",
                            source.albedos.size(), runs.runs.size(), names_of()));
  for (std::size_t k = 0; k < runs.runs.size(); ++k)
    runs.albedo.push_back(albedo_of(runs.runs[k], k, runs.runs.size(), source.albedos));
  return runs;
}

std::optional<atmosphere::SunAbove> sun_above(const scene::Scene& scene) {
  if (!scene.sun || !scene.sun->is_up()) return std::nullopt;
  return atmosphere::SunAbove{scene.sun->direction.z, scene.sun->irradiance};
}

void check_light(const io::DocumentSources& sources, const io::LightDocument& written,
                 const atmosphere::ImportedLight& light) {
  if (const std::optional<io::SunDocument>& sun = written.sun;
      sun && light.own_irradiance && (sun->irradiance || sun->distance_au))
    throw io::document_error(
        sources, sun->position,
        "the Sun's irradiance follows from the imported runs: leave out its 'spectrum' and 'distance'");
  if (!light.sky.empty() && !std::holds_alternative<io::NoSky>(written.sky))
    throw io::document_error(sources, written.position,
                             "the sky's irradiance follows from the imported runs: leave out 'sky'");
}

void warn(const io::LightDocument& written, const AtmosphereSubject& subject,
          const atmosphere::ImportedRuns& runs, const atmosphere::ImportedLight& light,
          const atmosphere::ImportedAtmosphere& air, LogSink& log) {
  for (const std::string& remark : light.remarks) log.warn(remark);
  if (light.sky.empty() && std::holds_alternative<io::NoSky>(written.sky))
    log.warn(format(
        "{} does not tell the diffuse irradiance of the ground: the sky is black (give light.sky, a run over "
        "ground of albedo above 0, or a column of diffuse_irradiance)",
        light.source));
  std::vector<std::string> names;
  for (const std::size_t c : air.unmatched_channels()) names.push_back(subject.channels[c].name);
  if (!names.empty())
    log.warn(
        format("channels that are none of {}: {}; they are interpolated between its channels, which blurs "
               "absorption",
               light.source, list_names(names, "and", 5)));
  const std::optional<double>& zenith_rad = runs.runs.front().geometry.zenith_rad;
  if (!zenith_rad) return;
  // A run's zenith angle is that of the line of sight from the sensor.
  const double camera_rad = sensor::nadir_angle_rad(subject.camera.middle_ray()),
               run_rad = std::numbers::pi - *zenith_rad;
  if (std::abs(camera_rad - run_rad) > kSameView_rad)
    log.warn(format("the camera looks {:.1f} deg from the nadir and the line of sight of {} {:.1f} deg",
                    camera_rad * 180.0 / std::numbers::pi, runs.runs.front().source(),
                    run_rad * 180.0 / std::numbers::pi));
}

}  // namespace

std::unique_ptr<atmosphere::ImportedAtmosphere> assemble_imported(
    const io::ImportedDocument& written, const io::LightDocument& light, const AtmosphereSubject& subject,
    std::span<const radiometry::Spectrum> surfaces, radiometry::NodeDemands demands, LogSink* log) {
  return with_position(subject.sources, written.position, [&] {
    demands.most_nodes = kMostImportedNodes;
    demands.tolerance = kImportedTolerance;
    const std::optional<atmosphere::SunAbove> sun = sun_above(subject.scene);
    const atmosphere::ImportedRuns runs = read_runs(
        subject.sources, written, sun ? std::optional(subject.scene.sun->zenith_rad()) : std::nullopt);
    const atmosphere::ImportedLight imported = atmosphere::imported_light(runs, sun);
    check_light(subject.sources, light, imported);
    auto air = std::make_unique<atmosphere::ImportedAtmosphere>(
        imported, atmosphere::ImportedAtmosphere::Inputs{subject.channels, surfaces, demands});
    if (log != nullptr) warn(light, subject, runs, imported, *air, *log);
    return air;
  });
}

}  // namespace ifov::session
