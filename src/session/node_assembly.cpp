#include "session/node_assembly.h"

#include <algorithm>
#include <chrono>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "io/document/document.h"
#include "radiometry/spectral_nodes.h"
#include "session/assembly/atmosphere/adjacency_assembly.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/assembly/atmosphere/imported_assembly.h"
#include "session/assembly/atmosphere/node_tolerance.h"
#include "session/assembly/shared/colour_guess.h"
#include "session/loaded/parts.h"
#include "session/surface_spectra.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

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

}  // namespace

namespace {

void make_nodes(Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept) {
  const io::Document& document = parts.document;
  const scene::Scene& scene = parts.scene;
  // What surfaces make of polarized light is radiance, too: a pane at Brewster's angle shows half as much again of skylight, or half.
  const bool told = parts.polarimetry != nullptr, polarized = told || polarizes(scene);
  const std::vector<radiometry::Spectrum> surfaces = spectra_of_surfaces(
      {scene, parts.channels, parts.colour_guesses, polarized, document.atmosphere.modelled.has_value()});

  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  const AtmosphereSubject subject{document.sources, scene,   *parts.camera,
                                  parts.channels,   request, told || (polarized && scene.sun.has_value())};
  radiometry::NodeDemands demands;
  constexpr double kShare = 0.1;  // less is not spoken of in intervals (NodeHalfWidth)
  demands.tolerance = node_tolerance(scene, parts.channels, request, kShare, demands.tolerance);
  if (const std::optional<int>& depth = document.sampling.max_depth)
    demands.reflections = std::clamp(*depth, 1, demands.reflections);
  const scene::TemperatureRange emitted = scene.temperatures().value_or(scene::TemperatureRange{});
  demands.coldest_k = emitted.coldest_k;
  demands.hottest_k = emitted.hottest_k;
  demands.lamps = spectra_of_lamps(scene);
  demands.all_glow = document.atmosphere.modelled && scene.all_emit();
  if (document.atmosphere.modelled) {
    parts.atmosphere =
        assemble_atmosphere(document.atmosphere, document.scene.origin, *parts.sensor, subject, surfaces,
                            demands, {options.threads, kept, atmosphere_progress(options), log});
    parts.nodes = &parts.atmosphere->nodes();
    parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.atmosphere, polarized);
    AssembledAdjacency adjacency =
        assemble_adjacency(*document.atmosphere.modelled, document.scene.origin, subject, *parts.atmosphere,
                           *parts.spectral_scene, options.threads);
    parts.spectral_scene->set_adjacent(std::move(adjacency.ground));
    parts.ground_in_air = std::move(adjacency.statement);
    if (log != nullptr) log->info(parts.ground_in_air);
    return;
  }
  if (document.atmosphere.imported) {
    parts.imported =
        assemble_imported(*document.atmosphere.imported, document.light, subject, surfaces, demands, log);
    parts.nodes = &parts.imported->nodes();
    parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.imported, polarized);
    return;
  }
  const radiometry::Spectrum sun = scene.sun ? scene.sun->irradiance : radiometry::Spectrum();
  parts.own_nodes = std::make_unique<radiometry::SpectralNodes>(radiometry::SpectralNodes::build(
      parts.channels, sun, surfaces, demands, scene.sky.radiance ? &*scene.sky.radiance : nullptr));
  parts.nodes = parts.own_nodes.get();
  parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.nodes, polarized);
}

}  // namespace

void assemble_nodes(Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept) {
  make_nodes(parts, log, options, kept);
}

void warn_of_node_errors(const Parts& parts, LogSink& log) {
  if (!parts.atmosphere && parts.nodes->worst_error() > kChannelError)
    log.warn(format("the nodes of the channels integrate some product of spectra only within {:.2g} %",
                    100.0 * parts.nodes->worst_error()));
}

}  // namespace ifov::session
