#include "session/session.h"

#include <algorithm>
#include <mutex>

#include "core/call_scope.h"
#include "core/version.h"
#include "io/document/document.h"
#include "io/scene_cache/scene_cache.h"
#include "render/tolerance/atmosphere_budget.h"
#include "render/tolerance/channel_brightness.h"
#include "render/tolerance/node_budget.h"
#include "sensor/camera.h"
#include "session/assembly/atmosphere/atmosphere_cache.h"
#include "session/assembly/atmosphere/weather_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/whole/light_assembly.h"
#include "session/assembly/whole/polarized_surfaces.h"
#include "session/assembly/whole/scene_assembly.h"
#include "session/assembly/whole/surroundings_assembly.h"
#include "session/atmosphere_messages.h"
#include "session/loaded/parts.h"
#include "session/loaded/single_views.h"
#include "session/messages.h"
#include "session/node_assembly.h"
#include "session/one_material.h"
#include "session/plausibility/light_warnings.h"
#include "session/plausibility/plausibility.h"
#include "session/response_assembly.h"
#include "session/sensor_notes.h"
#include "session/shared_scene.h"
#include "session/solved/solved_temperatures.h"

namespace ifov::session {

namespace {

constexpr int kTemperaturesAcross =
    24;  // rays along each side of the image, to points whose error is measured

void warn_of_former_keys(const io::Document& document, LogSink& log) {
  for (const io::FormerKey& key : document.former_keys)
    log.warn(format("{}line {}: '{}' is called '{}' now; its former name is read in this version only",
                    key.position.file == document.sources.file_name ? "" : key.position.file + ", ",
                    key.position.line, key.former, key.name));
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

}  // namespace

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Session Session::load_file(const std::string& document, std::span<const io::DocumentOverride> overrides,
                           LogSink* log, const LoadOptions& options) {
  return load(io::read_document(document, overrides), log, options);
}

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
  warn_of_former_keys(document, *log);
  SharedScene alone;
  SharedScene& shared = options.shared != nullptr && SharedScene::serves(document) ? *options.shared : alone;
  std::optional<io::SceneCache> cache;
  // A cache that is saved drops what nobody has asked it for.
  if (options.scene_cache && !shared.is_built())
    cache.emplace(std::filesystem::path(document.sources.file_name).replace_extension(".ifovcache"),
                  version(), log);
  phase("scene");
  const auto assemble = [&](LogSink* to) {
    AssembledScene made =
        assemble_scene(document.sources, document.scene, document.light.lamps, document.time,
                       document.sensor.camera, document.seed, to, cache ? &*cache : nullptr);
    if (cache) shared.known_files = cache->known_files();
    return made;
  };
  AssembledScene assembled = &shared == &alone ? assemble(log) : shared.scene(assemble, log);
  assemble_light({document.sources, document.light, document.atmosphere, document.scene.origin, document.time,
                  surroundings_material(document)},
                 assembled.scene);
  log->info(scene_statement(*assembled.scene.world));
  p.scene = std::move(assembled.scene), p.map_scales = std::move(assembled.map_scales);
  p.colour_guesses = std::move(assembled.colour_guesses);
  p.placed = std::move(assembled.placed), p.map_offset_m = assembled.map_offset_m;
  p.known_files = shared.known_files;
  if (document.weather) p.weather = assemble_weather(document.sources, *document.weather, document.time);
  assemble_sensor(p);
  if (p.polarimetry) check_polarized(document.sources, document.scene, p.scene);
  check_single_views(p);
  p.plan = assemble_sampling(document.sources, document.sampling, document.sensor, p.told_channels,
                             p.responses.get());
  check_image_size(document.sources, document.sampling,
                   static_cast<std::int64_t>(p.camera->width_px()) * p.camera->height_px());
  if (!p.scene.solved.empty())
    p.temperature_errors =
        solve_temperatures(document, p.weather.get(), *p.camera, p.scene, options.unseen_temperatures,
                           shared.classes(), options.threads, log);
  p.assumed_surroundings =
      assume_surroundings(document.light, document.atmosphere, *p.camera, p.scene).value_or("");
  if (!p.assumed_surroundings.empty()) log->info(p.assumed_surroundings);
  with_position(document.sources, document.sensor.psf_position, [&] { assemble_response(p); });
  std::optional<AtmosphereCache> solutions;
  if (cache && document.atmosphere.modelled) solutions.emplace(*cache);
  const auto save = [&] {
    const Call undisturbed{
        current_call().inputs};  // what is worked out is kept also when the call is cancelled
    const CallScope scope(undisturbed);
    if (solutions) solutions->save();
    if (cache) cache->save();
  };
  phase(document.atmosphere.modelled ? "atmosphere" : "spectra");
  try {
    with_position(document.sources, document.sensor.position,
                  [&] { assemble_nodes(p, log, options, solutions ? &*solutions : nullptr); });
  } catch (...) {
    save();
    throw;
  }
  save();
  with_position(document.sources, document.sensor.psf_position, [&] { keep_more_of_psf(p); });
  if (const std::string around = surroundings_statement(p); !around.empty()) log->info(around);
  warn_of_node_errors(p, *log);
  warn_of_light_left_out(p, *log);
  p.brightness = std::make_unique<render::ChannelBrightness>(*p.nodes);
  if (p.atmosphere) p.air = render::atmosphere_half_widths(*p.spectral_scene, *p.atmosphere);
  if (document.atmosphere.modelled && document.atmosphere.modelled->interval == "with model")
    for (render::AtmosphereHalfWidth& air : p.air) {
      air.model_counted = 1.0;
      air.model_under_clouds = document.atmosphere.modelled->clouds.empty() ? 0.0 : 1.0;
    }
  if (p.polarimetry) render::pass_optics(*p.polarimetry, p.air);
  if (!p.atmosphere) p.node_errors = render::node_half_widths(*p.spectral_scene);
  with_position(document.sources, document.sensor.position, [&] { count_temperature_errors(p, *log); });
  p.make_tolerance();
  warn_of_atmosphere_errors(p, *log);
  tell_of_image(p);
  tell_of_emitters(*p.spectral_scene, *log);
  refuse_rare_lobes(document.sources, document.scene, *p.spectral_scene);
  tell_of_highlights(*p.spectral_scene, *log);
  log->info(sensor_statement(p));
  phase("plausibility");
  check_plausibility(p, *log);
  for (std::string& line : sensor_notes(p)) p.locations.push_back(std::move(line));
  return Session(std::move(parts));
}

const std::vector<std::string>& Session::warnings() const { return parts_->warnings; }

std::string Session::description() const { return describe(*parts_); }

}  // namespace ifov::session
