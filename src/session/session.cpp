#include "session/session.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/version.h"
#include "io/document/document.h"
#include "io/scene_cache/scene_cache.h"
#include "materials/bsdf/hemisphere.h"
#include "radiometry/spectral_nodes.h"
#include "render/accuracy_tolerance.h"
#include "render/air_budget.h"
#include "render/channel_brightness.h"
#include "render/node_budget.h"
#include "sampling/region_interval.h"
#include "sensor/psf_wings.h"
#include "session/air_statements.h"
#include "session/assembly/air/atmosphere_assembly.h"
#include "session/assembly/air/atmosphere_cache.h"
#include "session/assembly/air/imported_assembly.h"
#include "session/assembly/air/node_tolerance.h"
#include "session/assembly/air/weather_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/whole/scene_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/assembly/whole/surroundings_assembly.h"
#include "session/loaded/parts.h"
#include "session/sense/light_warnings.h"
#include "session/sense/place_lines.h"
#include "session/sense/sense_warnings.h"
#include "session/statements.h"
#include "transport/emitter_mirrors.h"
#include "transport/emitters.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

namespace {

/// The footprint of a pixel, and what of its PSF lies beyond.
void place_response(Parts& parts) {
  const std::unique_ptr<sensor::Psf> psf = assemble_psf(parts.document);
  const double fill_factor = parts.document.sensor.fill_factor;
  parts.footprint =
      std::make_unique<sampling::PixelFootprint>(sensor::make_footprint(psf.get(), fill_factor));
  if (psf == nullptr) return;
  if (psf->has_wings() && parts.plan.knows_errors)
    parts.wings = std::make_unique<sensor::PsfWings>(*psf, fill_factor);
  else
    parts.psf_cut = 1.0 - psf->kept();
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

/// What a model makes of light at some angles, and of what: nodes have to hold all of it.
void add_directional(const materials::Bsdf& bsdf, std::vector<radiometry::Spectrum>& surfaces) {
  constexpr double kCosines[] = {1.0, 0.5, 0.1};
  surfaces.insert(surfaces.end(), bsdf.spectra().begin(), bsdf.spectra().end());
  for (const double cosine : kCosines)
    for (const materials::Side side : {materials::Side::reflected, materials::Side::transmitted})
      if (side == materials::Side::reflected || bsdf.may_transmit())
        surfaces.push_back(materials::directional_hemispherical(bsdf, side, cosine));
}

/// Spectral nodes for what light can do in the scene (how often it is reflected, and how hot surfaces are), behind the
/// atmosphere where one is modelled.
void build_nodes(Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept) {
  const scene::Scene& scene = parts.scene;
  std::vector<radiometry::Spectrum> surfaces;
  for (const materials::Material& material : scene.materials) {
    surfaces.push_back(material.reflectance);
    if (!material.bsdf->is_separable()) add_directional(*material.bsdf, surfaces);
    if (!material.transmittance) continue;
    surfaces.push_back(*material.transmittance);
    // What a leaf emits is what it neither reflects nor transmits.
    if (parts.document.atmosphere.modelled)
      surfaces.push_back(radiometry::sum(material.reflectance, *material.transmittance));
  }
  if (scene.sun) surfaces.push_back(scene.sun->transmittance);
  if (scene.view_path.transmittance) surfaces.push_back(*scene.view_path.transmittance);

  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  const AirSubject subject{parts.document, scene, *parts.camera, parts.channels, request};
  radiometry::NodeDemands demands;
  demands.tolerance = node_tolerance(scene, parts.channels, request, demands.tolerance);
  if (const std::optional<int>& depth = parts.document.sampling.max_depth)
    demands.reflections = std::clamp(*depth, 1, demands.reflections);
  const scene::TemperatureRange emitted = scene.temperatures().value_or(scene::TemperatureRange{});
  demands.coldest_k = emitted.coldest_k;
  demands.hottest_k = emitted.hottest_k;
  demands.all_glow = parts.document.atmosphere.modelled && scene.all_emit();
  if (parts.document.atmosphere.modelled) {
    parts.atmosphere = assemble_atmosphere(subject, surfaces, demands,
                                           {options.threads, kept, atmosphere_progress(options), log});
    parts.nodes = &parts.atmosphere->nodes();
    parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.atmosphere);
    return;
  }
  if (parts.document.atmosphere.imported) {
    parts.imported = assemble_imported(subject, surfaces, demands, log);
    parts.nodes = &parts.imported->nodes();
    parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.imported);
    return;
  }
  const radiometry::Spectrum sun = scene.sun ? scene.sun->irradiance : radiometry::Spectrum();
  parts.own_nodes = std::make_unique<radiometry::SpectralNodes>(radiometry::SpectralNodes::build(
      parts.channels, sun, surfaces, demands, scene.sky.radiance ? &*scene.sky.radiance : nullptr));
  parts.nodes = parts.own_nodes.get();
  parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.nodes);
}

void tell_of_emitters(const transport::SpectralScene& scene, LogSink& log) {
  const transport::Emitters* emitters = scene.emitters();
  if (emitters == nullptr) return;
  if (emitters->count() > 0)
    log.info(
        format("emitters: faces that outshine the scene and whose light is sought: {}", emitters->count()));
  if (emitters->leaves_some())
    log.warn(
        format("light of some surfaces that outshine the scene is found by chance alone: it is not sought "
               "from planes "
               "and terrain, nor from more than {} faces",
               transport::Emitters::kMost));
  if (emitters->count() > 0 && transport::EmitterMirrors::leave_some(scene.scene()))
    log.warn(
        "light of surfaces that outshine the scene is sought by way of one flat mirror, not of bent ones or "
        "of several "
        "in turn: what those throw of it on other surfaces is found by chance alone, and pixels near them "
        "may be less "
        "sure than they say");
}

/// Passes on what is said, and keeps the warnings.
class KeptWarnings final : public LogSink {
 public:
  KeptWarnings(LogSink* next, std::vector<std::string>& warnings) : next_(next), warnings_(warnings) {}
  void info(const std::string& message) override {
    if (next_ != nullptr) next_->info(message);
  }
  void warn(const std::string& message) override {
    {
      const std::scoped_lock lock(mutex_);
      warnings_.push_back(message);
    }
    if (next_ != nullptr) next_->warn(message);
  }

 private:
  LogSink* next_;
  std::mutex mutex_;
  std::vector<std::string>& warnings_;
};

/// Whether the document can mean what was loaded.
void make_sense(Parts& parts, LogSink& log) {
  const SceneLook look = look_at(parts);
  parts.places = place_lines(parts, look);
  for (const std::string& line : parts.places) log.info(line);
  require_light(parts, look);
  warn_of_places(parts, look, log);
  warn_of_standing(parts, log);
  warn_of_values(parts, look, log);
}

}  // namespace

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session Session::load(const io::Document& document, LogSink* outer_log, const LoadOptions& options) {
  auto parts = std::make_unique<Parts>(document);
  Parts& p = *parts;
  const auto phase = [&](const char* what) {
    if (options.progress != nullptr) options.progress->phase(what);
  };
  KeptWarnings kept(outer_log, p.warnings);
  LogSink* const log = &kept;
  std::optional<io::SceneCache> cache;
  if (options.scene_cache)
    cache.emplace(std::filesystem::path(document.file_name).replace_extension(".ifovcache"), version(), log);
  phase("scene");
  AssembledScene assembled = assemble_scene(document, log, cache ? &*cache : nullptr);
  p.scene = std::move(assembled.scene), p.map_scales = std::move(assembled.map_scales);
  p.placed = std::move(assembled.placed), p.map_offset_m = assembled.map_offset_m;
  if (cache) p.known_files = cache->known_files();
  p.weather = assemble_weather(document);
  p.channels = assemble_channels(document);
  p.camera = assemble_camera(document, p.scene);
  p.plan = assemble_sampling(document, p.channels);
  p.assumed_surroundings = assume_surroundings(document, *p.camera, p.scene).value_or("");
  if (!p.assumed_surroundings.empty()) log->info(p.assumed_surroundings);
  with_position(document, document.sensor.psf_position, [&] { place_response(p); });
  std::optional<AtmosphereCache> solutions;
  if (cache && document.atmosphere.modelled) solutions.emplace(*cache);
  const auto save = [&] {
    if (solutions) solutions->save();
    if (cache) cache->save();
  };
  phase(document.atmosphere.modelled ? "atmosphere" : "spectra");
  try {
    with_position(document, document.sensor.position,
                  [&] { build_nodes(p, log, options, solutions ? &*solutions : nullptr); });
  } catch (...) {
    save();
    throw;
  }
  save();
  if (!p.atmosphere && p.nodes->worst_error() > kChannelError)
    log->warn(format("the nodes of the channels integrate some product of spectra only within {:.2g} %",
                     100.0 * p.nodes->worst_error()));
  warn_of_light_left_out(p, *log);
  p.brightness = std::make_unique<render::ChannelBrightness>(*p.nodes);
  if (p.atmosphere) p.air = render::air_half_widths(*p.spectral_scene, *p.atmosphere);
  if (!p.atmosphere) p.node_errors = render::node_half_widths(*p.spectral_scene);
  p.tolerance = p.tolerance_of(p.plan);
  warn_of_air_errors(p, *log);
  p.info = image_info(document, *p.camera, p.channels, p.scene, p.map_offset_m);
  p.info.footprint_px = sampling::response_area_px(*p.footprint);
  for (std::size_t c = 0; c < p.air.size(); ++c) p.info.channels[c].air = p.air[c];
  tell_of_emitters(*p.spectral_scene, *log);
  log->info(format("sensor: {} x {} pixels, {} channels in {} spectral nodes", p.info.width_px,
                   p.info.height_px, p.channels.size(), p.nodes->node_count()));
  phase("first look");
  make_sense(p, *log);
  return Session(std::move(parts));
}

const std::vector<std::string>& Session::warnings() const { return parts_->warnings; }

std::string Session::description() const { return describe(*parts_); }

}  // namespace ifov::session
