#include "session/assembly/atmosphere/atmosphere_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/scattering/ground/directional_ground.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "geometry/world.h"
#include "io/document/aerosol_document.h"
#include "io/document/atmosphere_document.h"
#include "io/document/scene_document.h"
#include "io/document/sensor_document.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "session/assembly/atmosphere/aerosol_assembly.h"
#include "session/assembly/atmosphere/cloud_assembly.h"
#include "session/assembly/atmosphere/gas_model_assembly.h"
#include "session/assembly/atmosphere/node_tolerance.h"
#include "session/assembly/shared/with_position.h"
#include "transport/sky/material_ground.h"

namespace ifov::session {
namespace {

/// The error that the nodes of a channel may leave, and how many they are at most: every node is a column that all paths
/// carry, so that sensors of few channels can afford more of them and be nearer to what is asked for.
constexpr double kNodeTolerance = 5e-3, kFinest = 5e-4;
/// Of what is asked for: all of it is in the air's error.
constexpr double kNodeShare = 1.0 / 30.0;
constexpr std::size_t kMostColumns = 256, kUsualNodes = 8, kMostNodes = 64;

double sensor_altitude_km(const io::ModelledAtmosphere& air, const sensor::Camera& camera, double line_px,
                          double ground_km) {
  if (const std::optional<double>& given = air.sensor_altitude_km) return *given;
  const std::optional<double> altitude_m = camera.pose(line_px).altitude_m();
  return altitude_m ? ground_km + 1e-3 * *altitude_m : atmosphere::kTopOfAtmosphereKm;
}

void warn(const AtmosphereSubject& subject, const io::ModelledAtmosphere& modelled,
          const atmosphere::AtmosphereColumn& column, LogSink& log) {
  warn_of_column(modelled, column, log);
  if (!modelled.clouds.empty() && modelled.interval == "with model")
    log.warn(
        "intervals hold the error of the model of the air and of what clouds consist of, not how far level and uniform clouds are "
        "from real ones");
  if (modelled.gas_model && modelled.interval == "with model" && !column.gas_terms()->depth_errors_known())
    log.warn(
        "intervals hold the error of the model of the air, which was found with the built-in bands: the gas model does not say what "
        "its spectra are off by ('ifov gases --depth-error'), and they are taken for as wrong as the bands");
  const std::string narrow = narrow_channels(subject.channels, column.gas_terms());
  if (!narrow.empty()) log.warn(narrow);
}

}  // namespace

void warn_of_column(const io::ModelledAtmosphere& air, const atmosphere::AtmosphereColumn& column,
                    LogSink& log) {
  for (const std::string& remark : column.remarks()) log.warn(format("atmosphere: {}", remark));
  for (const std::string& remark : cloud_remarks(air.clouds, column.profile()))
    log.warn(format("atmosphere: {}", remark));
}

void check_channels(const io::DocumentSources& sources, std::span<const io::ChannelDocument> written,
                    std::span<const radiometry::Channel> channels) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const radiometry::Channel& channel = channels[c];
    const bool line = channel.is_monochromatic();
    const double first_um = line ? channel.centre_um : channel.response.first_um(),
                 last_um = line ? channel.centre_um : channel.response.last_um();
    if (first_um >= kShortest_um && last_um <= kLongest_um) continue;
    throw io::document_error(
        sources, written[c].position,
        format(
            "the channel '{}' reaches from {:.4g} to {:.4g} um, and the modelled atmosphere from {:g} to {:g} um",
            channel.name, first_um, last_um, kShortest_um, kLongest_um));
  }
}

atmosphere::AtmosphereColumn assemble_column(const io::DocumentSources& sources,
                                             const io::ModelledAtmosphere& air,
                                             const io::OriginDocument& origin) {
  atmosphere::AtmosphereDescription description = air.description;
  if (air.aerosol) description.aerosol = assemble_aerosol(sources, *air.aerosol);
  if (!description.air.ground_altitude_km && description.air.levels.empty())
    description.air.ground_altitude_km = std::max(0.0, 1e-3 * origin.height_m);
  if (!air.clouds.empty())
    description.aerosol.clouds =
        assemble_clouds(sources, air.clouds, atmosphere::build_profile(description.air).profile.ground_km());
  description.gas_terms = assemble_gas_model(sources, air, description.air);
  const auto column = [&] { return atmosphere::AtmosphereColumn(description); };
  return air.aerosol && air.aerosol->has_own() ? with_position(sources, air.aerosol->position, column)
                                               : column();
}

atmosphere::SensorGeometry sensor_geometry(const io::DocumentSources& sources,
                                           const io::ModelledAtmosphere& air,
                                           const io::CameraDocument& written, const sensor::Camera& camera,
                                           const std::optional<scene::Sun>& sun, double ground_km) {
  atmosphere::SensorGeometry geometry;
  const math::Ray middle = camera.middle_ray();
  const math::Vec3 up = -middle.direction;
  geometry.view_zenith_rad = sensor::nadir_angle_rad(middle);
  if (!(geometry.view_zenith_rad <= kLowestView_rad))
    throw io::document_error(
        sources, written.position,
        format(
            "under a modelled atmosphere the camera must look down, at most {:.0f} degrees from the nadir; the middle "
            "of its image looks {:.1f} degrees away",
            kLowestView_rad * 180.0 / std::numbers::pi, geometry.view_zenith_rad * 180.0 / std::numbers::pi));
  if (sun && (sun->is_up() || sun->is_twilight())) {
    geometry.sun_zenith_rad = sun->zenith_rad();
    geometry.view_azimuth_rad = std::atan2(up.x, up.y) - sun->azimuth_rad();
  }
  geometry.sensor_altitude_km = sensor_altitude_km(air, camera, camera.middle_line_px(), ground_km);
  if (!(geometry.sensor_altitude_km > ground_km))
    throw InputError(format("the sensor stands at {:g} km, not above the ground at {:g} km",
                            geometry.sensor_altitude_km, ground_km));
  return geometry;
}

atmosphere::SensorAltitudes sensor_altitudes(const io::ModelledAtmosphere& air, const sensor::Camera& camera,
                                             double ground_km) {
  const auto at = [&](double line_px) { return sensor_altitude_km(air, camera, line_px, ground_km); };
  const double middle_km = at(camera.middle_line_px());
  atmosphere::SensorAltitudes altitudes{middle_km, middle_km};
  for (int line = 0; line <= camera.height_px(); ++line) {
    altitudes.low_km = std::min(altitudes.low_km, at(line));
    altitudes.high_km = std::max(altitudes.high_km, at(line));
  }
  return altitudes;
}

atmosphere::LineOfSightRange line_of_sight_range(const sensor::Camera& camera,
                                                 const std::optional<scene::Sun>& sun, double highest_m) {
  constexpr int kPoints = 17;
  constexpr double kMargin_px = 4.0;  // of what samplers look at beyond the image
  std::vector<sampling::FocalPoint> points;
  for (int j = 0; j < kPoints; ++j)
    for (int i = 0; i < kPoints; ++i)
      points.push_back({-kMargin_px + (camera.width_px() + 2.0 * kMargin_px) * i / (kPoints - 1),
                        -kMargin_px + (camera.height_px() + 2.0 * kMargin_px) * j / (kPoints - 1)});
  if (camera.view_list() != nullptr) {
    points.clear();
    for (int k = 0; k < camera.width_px(); ++k) points.push_back({k + 0.5, 0.5});
  }
  std::vector<math::Ray> rays(points.size());
  camera.rays(points, rays);
  math::Vec3 towards = sun ? sun->direction : math::Vec3{1.0, 0.0, 0.0};
  const double level = std::hypot(towards.x, towards.y);
  towards = level > 0.0 ? (1.0 / level) * math::Vec3{towards.x, towards.y, 0.0} : math::Vec3{0.0, 1.0, 0.0};
  const double steepest = std::tan(kLowestView_rad);
  constexpr double kFar = 1e300;
  atmosphere::LineOfSightRange range{kFar, -kFar, kFar, -kFar, 1e-3 * std::max(0.0, highest_m)};
  bool left = false, right = false;
  for (const math::Ray& ray : rays) {
    const math::Vec3 up = -ray.direction;
    const double flat = std::hypot(up.x, up.y);
    const double scale = up.z > 0.0 && flat < steepest * up.z ? 1.0 / up.z : steepest / std::max(flat, 1e-12);
    const double along = scale * (up.x * towards.x + up.y * towards.y),
                 across = scale * (up.x * towards.y - up.y * towards.x);
    range.along_low = std::min(range.along_low, along);
    range.along_high = std::max(range.along_high, along);
    range.across_low = std::min(range.across_low, std::abs(across));
    range.across_high = std::max(range.across_high, std::abs(across));
    left = left || across < 0.0;
    right = right || across > 0.0;
  }
  if (left && right) range.across_low = 0.0;
  return range;
}

std::string narrow_channels(std::span<const radiometry::Channel> channels,
                            const atmosphere::GasTermTable* terms) {
  std::vector<std::size_t> narrow;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (atmosphere::narrower_than_resolved(channels[c], terms)) narrow.push_back(c);
  if (narrow.empty()) return {};
  std::string names;
  constexpr std::size_t kNamed = 4;
  for (std::size_t k = 0; k < std::min(kNamed, narrow.size()); ++k)
    names += format("{}'{}'", k == 0 ? "" : ", ", channels[narrow[k]].name);
  if (narrow.size() > kNamed) names += format(" and {} more", narrow.size() - kNamed);
  if (terms != nullptr)
    return format(
        "channels narrower than what their absorption is resolved to ({:g} cm-1 by the band model, {:g} cm-1 within the gas "
        "model): {}; their absorption is that of a channel of this width",
        atmosphere::kResolution_cm1, terms->step_cm1, names);
  return format(
      "channels narrower than the {:g} cm-1 that the atmosphere's band model resolves: {}; their absorption "
      "is that of a channel of this width (wider channels, or spectra from a line-by-line code under "
      "'tabulated', are right)",
      atmosphere::kResolution_cm1, names);
}

std::unique_ptr<atmosphere::SensorAtmosphere> assemble_atmosphere(
    const io::AtmosphereDocument& written, const io::OriginDocument& origin, const io::SensorDocument& sensor,
    const AtmosphereSubject& subject, std::span<const radiometry::Spectrum> surfaces,
    radiometry::NodeDemands demands, const AtmosphereWork& work) {
  const io::ModelledAtmosphere& modelled = written.modelled.value();
  check_channels(subject.sources, sensor.channels, subject.channels);
  return with_position(subject.sources, written.position, [&] {
    const atmosphere::AtmosphereColumn column = assemble_column(subject.sources, modelled, origin);
    check_gas_model(subject.sources, modelled, sensor.channels, subject.channels, column.gas_terms());
    const double ground_km = column.levels().altitude_km.front();
    atmosphere::SensorAtmosphere::Inputs inputs;
    inputs.channels = subject.channels;
    if (subject.scene.sun) inputs.solar_irradiance = subject.scene.sun->irradiance;
    inputs.surfaces = surfaces;
    inputs.demands = demands;
    inputs.demands.most_nodes = std::clamp(kMostColumns / subject.channels.size(), kUsualNodes, kMostNodes);
    inputs.demands.tolerance =
        inputs.demands.most_nodes > kUsualNodes
            ? std::max(kFinest, node_tolerance(subject.scene, subject.channels, subject.request, kNodeShare,
                                               kNodeTolerance))
            : kNodeTolerance;
    inputs.geometry = sensor_geometry(subject.sources, modelled, sensor.camera, subject.camera,
                                      subject.scene.sun, ground_km);
    const atmosphere::LineOfSightRange range =
        line_of_sight_range(subject.camera, subject.scene.sun, subject.scene.world->heights().high_m);
    inputs.lines_of_sight.emplace(range, column.levels(),
                                  sensor_altitudes(modelled, subject.camera, ground_km));
    inputs.with_errors = true;
    const materials::Material& around = subject.scene.materials[subject.scene.surroundings.material];
    inputs.ground = around.reflectance;
    // Without a Sun azimuths count from the east, as in the scene's light.
    inputs.directional = transport::material_ground(
        around, subject.scene.sun ? subject.scene.sun->azimuth_rad() : 0.5 * std::numbers::pi);
    // What such ground makes of the sky's polarization is radiance, too.
    inputs.polarized = subject.polarized || (inputs.directional && inputs.directional->polarizes());
    inputs.threads = work.threads;
    inputs.kept = work.kept;
    inputs.progress = work.progress;
    auto air = std::make_unique<atmosphere::SensorAtmosphere>(column, inputs);
    if (work.log != nullptr) warn(subject, modelled, column, *work.log);
    return air;
  });
}

}  // namespace ifov::session
