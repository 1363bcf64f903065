#include "session/atmosphere_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "session/with_position.h"

namespace ifov::session {
namespace {

/// Nodes of a channel at most, and the error they may leave: every node is a column that all paths carry.
constexpr std::size_t kMostNodes = 8;
constexpr double kNodeTolerance = 5e-3;
constexpr double kAboveAllAir_km = 100.0;
/// Lines of sight closer to the horizon than this are not those of a plane-parallel atmosphere.
constexpr double kLowestView_rad = 80.0 * std::numbers::pi / 180.0;

atmosphere::SensorGeometry geometry_of(const Session::Parts& parts, double ground_km) {
  const scene::Scene& scene = parts.scene;
  atmosphere::SensorGeometry geometry;
  const sampling::FocalPoint centre{0.5 * parts.camera->width_px(), 0.5 * parts.camera->height_px()};
  math::Ray ray;
  parts.camera->rays({&centre, 1}, {&ray, 1});
  const math::Vec3 up = -ray.direction;
  geometry.view_zenith_rad = std::acos(std::clamp(up.z, -1.0, 1.0));
  if (!(geometry.view_zenith_rad <= kLowestView_rad))
    throw InputError(format("under a modelled atmosphere the camera must look down, at most {:.0f} degrees from the "
                            "nadir; the middle of its image looks {:.1f} degrees away",
                            kLowestView_rad * 180.0 / std::numbers::pi,
                            geometry.view_zenith_rad * 180.0 / std::numbers::pi));
  if (scene.sun && scene.sun->direction.z > 0.0) {
    const math::Vec3 sun = scene.sun->direction;
    geometry.sun_zenith_rad = std::acos(std::clamp(sun.z, -1.0, 1.0));
    geometry.view_azimuth_rad = std::atan2(up.x, up.y) - std::atan2(sun.x, sun.y);
  }
  const bool frame = std::holds_alternative<io::FrameCamera>(parts.document.sensor.camera.model);
  geometry.sensor_altitude_km = frame ? ground_km + 1e-3 * ray.origin_m.z : kAboveAllAir_km;
  if (parts.document.atmosphere.modelled->sensor_altitude_km)
    geometry.sensor_altitude_km = *parts.document.atmosphere.modelled->sensor_altitude_km;
  if (!(geometry.sensor_altitude_km > ground_km))
    throw InputError(format("the sensor stands at {:g} km, not above the ground at {:g} km",
                            geometry.sensor_altitude_km, ground_km));
  return geometry;
}

void warn(const Session::Parts& parts, const atmosphere::AtmosphereColumn& column,
          const atmosphere::SensorAtmosphere& air, LogSink& log) {
  for (const std::string& remark : column.remarks()) log.warn(format("atmosphere: {}", remark));
  const std::vector<std::size_t>& narrow = air.unresolved_channels();
  if (narrow.empty()) return;
  std::string names;
  constexpr std::size_t kNamed = 4;
  for (std::size_t k = 0; k < std::min(kNamed, narrow.size()); ++k)
    names += format("{}'{}'", k == 0 ? "" : ", ", parts.channels[narrow[k]].name);
  if (narrow.size() > kNamed) names += format(" and {} more", narrow.size() - kNamed);
  log.warn(format("channels narrower than the {:g} cm-1 that the atmosphere's band model resolves: {}; their absorption "
                  "is that of a channel of this width (wider channels, or spectra from a line-by-line code under "
                  "'tabulated', are right)",
                  atmosphere::kResolution_cm1, names));
}

}  // namespace

std::unique_ptr<atmosphere::SensorAtmosphere> assemble_atmosphere(const Session::Parts& parts,
                                                                  std::span<const radiometry::Spectrum> surfaces,
                                                                  radiometry::NodeDemands demands, int threads,
                                                                  LogSink* log) {
  const io::Document& document = parts.document;
  return with_position(document, document.atmosphere.position, [&] {
    atmosphere::AtmosphereDescription description = document.atmosphere.modelled->description;
    if (!description.air.ground_altitude_km && description.air.levels.empty())
      description.air.ground_altitude_km = std::max(0.0, 1e-3 * document.scene.origin.height_m);
    const atmosphere::AtmosphereColumn column(description);
    atmosphere::SensorAtmosphere::Inputs inputs;
    inputs.channels = parts.channels;
    if (parts.scene.sun) inputs.solar_irradiance = parts.scene.sun->irradiance;
    inputs.surfaces = surfaces;
    inputs.demands = demands;
    inputs.demands.most_nodes = kMostNodes;
    inputs.demands.tolerance = kNodeTolerance;
    inputs.geometry = geometry_of(parts, column.levels().altitude_km.front());
    inputs.threads = threads;
    auto air = std::make_unique<atmosphere::SensorAtmosphere>(column, inputs);
    if (log != nullptr) warn(parts, column, *air, *log);
    return air;
  });
}

}  // namespace ifov::session
