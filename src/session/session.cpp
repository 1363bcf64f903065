#include "session/session.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/version.h"
#include "session/air_statements.h"
#include "session/atmosphere_assembly.h"
#include "session/atmosphere_cache.h"
#include "session/imported_assembly.h"
#include "session/parts.h"
#include "session/scene_assembly.h"
#include "session/sensor_assembly.h"
#include "session/statements.h"
#include "session/weather_assembly.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

/// Beyond this wavelength light is mostly emitted.
constexpr double kThermal_um = 5.0;

/// Where light is mostly emitted, a surface without a temperature is as dark as space.
void warn_of_cold_surfaces(const Session::Parts& parts, LogSink& log) {
  const bool thermal = std::any_of(parts.channels.begin(), parts.channels.end(),
                                   [](const auto& channel) { return channel.centre_um > kThermal_um; });
  if (!thermal) return;
  std::string names;
  for (std::size_t s = 0; s < parts.scene.states.size(); ++s) {
    const std::uint32_t index = parts.scene.states[s].material;
    const materials::Material& material = parts.scene.materials[index];
    const bool mapped = std::any_of(parts.scene.coverings.begin(), parts.scene.coverings.end(), [&](const auto& c) {
      for (std::size_t k = 0; k < c.temperatures.size(); ++k)
        if (c.states[k] == s && c.temperatures[k]) return true;
      return std::any_of(c.patterns.begin(), c.patterns.end(), [&](const auto& pattern) {
        const std::vector<std::uint32_t> mixed = pattern->mixed_materials();
        return pattern->temperatures() && std::find(mixed.begin(), mixed.end(), index) != mixed.end();
      });
    });
    if (parts.scene.states[s].temperature_k > 0.0 || mapped || material.curve_of) continue;
    names += (names.empty() ? "'" : ", '") + material.name + "'";
  }
  if (!names.empty())
    log.warn(format("there are thermal channels, and no temperature for {}: what has none emits nothing", names));
}

/// Channels integrate within this of a full integration.
constexpr double kChannelError = 1e-3;

/// Tells how many of the atmosphere's solutions are there, and ends the work when asked to.
std::function<void(std::size_t, std::size_t)> atmosphere_progress(const LoadOptions& options) {
  if (options.progress == nullptr && options.cancel == nullptr) return {};
  return [options, start = std::chrono::steady_clock::now()](std::size_t done, std::size_t total) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    if (options.progress == nullptr) return;
    Progress progress;
    progress.pixels_done = static_cast<std::int64_t>(done);
    progress.pixels_total = static_cast<std::int64_t>(total);
    progress.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    options.progress->report(progress);
  };
}

/// Spectral nodes for what light can do in the scene (how often it is reflected, and how hot surfaces are), behind the
/// atmosphere where one is modelled.
void build_nodes(Session::Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept) {
  const scene::Scene& scene = parts.scene;
  std::vector<radiometry::Spectrum> surfaces;
  for (const materials::Material& material : scene.materials) {
    surfaces.push_back(material.reflectance);
    if (material.transmittance) surfaces.push_back(*material.transmittance);
  }
  if (scene.sun) surfaces.push_back(scene.sun->transmittance);
  if (scene.view_path.transmittance) surfaces.push_back(*scene.view_path.transmittance);

  radiometry::NodeDemands demands;
  if (const std::optional<int>& depth = parts.document.sampling.max_depth)
    demands.reflections = std::clamp(*depth, 1, demands.reflections);
  double coldest_k = std::numeric_limits<double>::infinity(), hottest_k = 0.0;
  const auto include = [&](double temperature_k) {
    if (temperature_k <= 0.0) return;
    coldest_k = std::min(coldest_k, temperature_k);
    hottest_k = std::max(hottest_k, temperature_k);
  };
  for (const scene::SurfaceState& state : scene.states) include(state.temperature_k);
  include(scene.surroundings.temperature_k);
  include(scene.sky.temperature_k.value_or(0.0));
  for (const scene::Covering& covering : scene.coverings)
    for (const auto& map : covering.temperatures)
      if (map) {
        include(map->minimum_k());
        include(map->maximum_k());
      }
  if (hottest_k > 0.0) {
    demands.coldest_k = coldest_k;
    demands.hottest_k = hottest_k;
  } else {
    demands.coldest_k = demands.hottest_k = 0.0;
  }
  if (parts.document.atmosphere.modelled) {
    parts.atmosphere = assemble_atmosphere(
        parts, surfaces, demands, {options.threads, kept, atmosphere_progress(options), log});
    parts.nodes = &parts.atmosphere->nodes();
    parts.spectral_scene = std::make_unique<render::SpectralScene>(scene, *parts.atmosphere);
    return;
  }
  if (parts.document.atmosphere.imported) {
    parts.imported = assemble_imported(parts, surfaces, demands, log);
    parts.nodes = &parts.imported->nodes();
    parts.spectral_scene = std::make_unique<render::SpectralScene>(scene, *parts.imported);
    return;
  }
  const radiometry::Spectrum sun = scene.sun ? scene.sun->irradiance : radiometry::Spectrum();
  parts.own_nodes = std::make_unique<radiometry::SpectralNodes>(
      radiometry::SpectralNodes::build(parts.channels, sun, surfaces, demands));
  parts.nodes = parts.own_nodes.get();
  parts.spectral_scene = std::make_unique<render::SpectralScene>(scene, *parts.nodes);
}

}  // namespace

render::RenderJob Session::Parts::job(const SamplingPlan& sampling, const render::AccuracyTolerance* limits) const {
  render::RenderJob job{*spectral_scene, *camera, *footprint, *sampling.sampler};
  job.tolerance = limits;
  job.air = air;
  if (document.sampling.max_depth) job.transport.maximum_scatterings = *document.sampling.max_depth;
  job.label_detail = sampling.request ? render::LabelDetail::sun_state : render::LabelDetail::material;
  job.seed = document.seed;
  job.tile_px = document.sampling.tile_px;
  job.seed_objects = sampling.seed_objects;
  job.drivers = sampling.drivers;
  return job;
}

std::unique_ptr<render::AccuracyTolerance> Session::Parts::tolerance_of(const SamplingPlan& sampling) const {
  if (!sampling.request) return nullptr;
  return std::make_unique<render::AccuracyTolerance>(*sampling.request, *brightness, spectral_scene->white_reflected(),
                                                     static_cast<std::int64_t>(camera->width_px()) *
                                                         camera->height_px(),
                                                     spectral_scene->path_radiance(), air);
}

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session Session::load(const io::Document& document, LogSink* log, const LoadOptions& options) {
  auto parts = std::make_unique<Parts>();
  Parts& p = *parts;
  p.document = document;
  std::optional<io::SceneCache> cache;
  if (options.scene_cache)
    cache.emplace(std::filesystem::path(document.file_name).replace_extension(".ifovcache"), version(), log);
  p.scene = assemble_scene(document, log, p.map_scales, cache ? &*cache : nullptr);
  if (cache) p.known_files = cache->known_files();
  p.weather = assemble_weather(document);
  p.channels = assemble_channels(document);
  p.camera = assemble_camera(document, p.scene);
  p.footprint = std::make_unique<sampling::PixelFootprint>(assemble_footprint(document));
  p.plan = assemble_sampling(document, p.channels);
  std::optional<AtmosphereCache> solutions;
  if (cache && document.atmosphere.modelled) solutions.emplace(*cache);
  const auto save = [&] {
    if (solutions) solutions->save();
    if (cache) cache->save();
  };
  try {
    with_position(document, document.sensor.position,
                  [&] { build_nodes(p, log, options, solutions ? &*solutions : nullptr); });
  } catch (...) {
    save();
    throw;
  }
  save();
  if (log != nullptr && !p.atmosphere && p.nodes->worst_error() > kChannelError)
    log->warn(format("the nodes of the channels integrate some product of spectra only within {:.2g} %",
                     100.0 * p.nodes->worst_error()));
  if (log != nullptr) warn_of_cold_surfaces(p, *log);
  p.brightness = std::make_unique<render::ChannelBrightness>(*p.nodes);
  if (p.atmosphere) p.air = render::air_half_widths(*p.spectral_scene, *p.atmosphere);
  p.tolerance = p.tolerance_of(p.plan);
  if (log != nullptr) warn_of_air_errors(p, *log);
  p.info = image_info(document, *p.camera, p.channels, p.scene);
  for (std::size_t c = 0; c < p.air.size(); ++c) p.info.channels[c].air = p.air[c];
  if (log != nullptr)
    log->info(format("sensor: {} x {} pixels, {} channels in {} spectral nodes", p.info.width_px, p.info.height_px,
                     p.channels.size(), p.nodes->node_count()));
  return Session(std::move(parts));
}

std::string Session::description() const { return describe(*parts_); }

}  // namespace ifov::session
