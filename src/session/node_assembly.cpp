#include "session/node_assembly.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "io/document/document.h"
#include "materials/bsdf/hemisphere.h"
#include "radiometry/spectral_nodes.h"
#include "scene/lamp.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/assembly/atmosphere/imported_assembly.h"
#include "session/assembly/atmosphere/node_tolerance.h"
#include "session/assembly/shared/colour_guess.h"
#include "session/loaded/parts.h"
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

/// What a model makes of light at some angles, and of what: nodes have to hold all of it.
void add_directional(const materials::Bsdf& bsdf, bool polarized,
                     std::vector<radiometry::Spectrum>& surfaces) {
  constexpr double kCosines[] = {1.0, 0.5, 0.1};
  surfaces.insert(surfaces.end(), bsdf.spectra().begin(), bsdf.spectra().end());
  for (const double cosine : kCosines)
    for (const materials::Side side : {materials::Side::reflected, materials::Side::transmitted})
      if (side == materials::Side::reflected || bsdf.may_transmit())
        surfaces.push_back(materials::directional_hemispherical(bsdf, side, cosine));
  // Elements of its matrix change their signs; light behind polarizers does not.
  if (!polarized || !bsdf.polarizes()) return;
  const auto elements = bsdf.polarization_spectra();
  double most = 0.0;
  for (const radiometry::Spectrum& element : elements)
    most = std::max({most, std::abs(element.minimum()), std::abs(element.maximum())});
  constexpr std::size_t kEvery = 8;
  for (std::size_t k = 0; k < elements.size() && most > 0.0; k += kEvery) {
    std::vector<double> passed;
    for (const double value : elements[k].values()) passed.push_back(0.5 + 0.5 * value / most);
    surfaces.push_back(
        elements[k].is_constant()
            ? radiometry::Spectrum::constant(passed[0])
            : radiometry::Spectrum({elements[k].wavelength_um().begin(), elements[k].wavelength_um().end()},
                                   std::move(passed), elements[k].outside(), elements[k].name()));
  }
}

/// By material: whether nodes need not be judged by it. Spectra that pictures are mixed of are many and of one form, a sigmoid of a
/// parabola: in each channel those stand for the others that vary most there, by themselves and for their brightness.
std::vector<bool> corners_left_out(const Parts& parts) {
  constexpr std::size_t kOfChannel = 12;
  constexpr int kLooks = 9;
  std::vector<bool> left_out(parts.scene.materials.size(), false);
  std::vector<std::uint32_t> corners;
  for (const ColourGuess& guess : parts.colour_guesses)
    corners.insert(corners.end(), guess.corners.begin(), guess.corners.end());
  for (const std::uint32_t corner : corners) left_out[corner] = true;
  for (const radiometry::Channel& channel : parts.channels) {
    std::vector<std::pair<double, std::uint32_t>> by_variance, by_share;
    for (const std::uint32_t corner : corners) {
      const radiometry::Spectrum& reflectance = parts.scene.materials[corner].reflectance;
      double sum = 0.0, squares = 0.0;
      for (int k = 0; k < kLooks; ++k) {
        const double value = reflectance.at(channel.centre_um +
                                            channel.fwhm_um * (static_cast<double>(k) / (kLooks - 1) - 0.5));
        sum += value / kLooks, squares += value * value / kLooks;
      }
      const double variance = squares - sum * sum;
      by_variance.emplace_back(-variance, corner);
      by_share.emplace_back(sum > 0.0 ? -variance / (sum * sum) : 0.0, corner);
    }
    for (auto* ranked : {&by_variance, &by_share}) {
      const std::size_t count = std::min(kOfChannel, ranked->size());
      std::partial_sort(ranked->begin(), ranked->begin() + static_cast<std::ptrdiff_t>(count), ranked->end());
      for (std::size_t k = 0; k < count; ++k) left_out[(*ranked)[k].second] = false;
    }
  }
  return left_out;
}

/// Whether two spectra are the same but for a factor.
bool same_shape(const radiometry::Spectrum& a, const radiometry::Spectrum& b) {
  const auto equal = [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(y); };
  if (!std::ranges::equal(a.wavelength_um(), b.wavelength_um(), equal)) return false;
  const double of_a = b.maximum(), of_b = a.maximum();
  return std::ranges::equal(a.values(), b.values(),
                            [&](double x, double y) { return equal(x * of_a, y * of_b); });
}

/// A street of lamps has one light.
void add_lamps(const scene::Scene& scene, radiometry::NodeDemands& demands) {
  for (const scene::Lamp& lamp : scene.lamps)
    if (std::ranges::none_of(demands.lamps,
                             [&](const auto& known) { return same_shape(known, lamp.radiance); }))
      demands.lamps.push_back(lamp.radiance);
}

}  // namespace

void assemble_nodes(Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept) {
  const io::Document& document = parts.document;
  const scene::Scene& scene = parts.scene;
  const bool polarized = parts.polarimetry != nullptr;
  std::vector<radiometry::Spectrum> surfaces;
  const std::vector<bool> left_out = corners_left_out(parts);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (left_out[m]) continue;
    const materials::Material& material = scene.materials[m];
    surfaces.push_back(material.reflectance);
    if (!material.bsdf->is_separable()) add_directional(*material.bsdf, polarized, surfaces);
    if (!material.transmittance) continue;
    surfaces.push_back(*material.transmittance);
    // What a leaf emits is what it neither reflects nor transmits.
    if (document.atmosphere.modelled)
      surfaces.push_back(radiometry::sum(material.reflectance, *material.transmittance));
  }
  if (scene.sun) surfaces.push_back(scene.sun->transmittance);
  if (scene.view_path.transmittance) surfaces.push_back(*scene.view_path.transmittance);

  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  const AtmosphereSubject subject{document.sources, scene, *parts.camera, parts.channels, request, polarized};
  radiometry::NodeDemands demands;
  demands.tolerance = node_tolerance(scene, parts.channels, request, demands.tolerance);
  if (const std::optional<int>& depth = document.sampling.max_depth)
    demands.reflections = std::clamp(*depth, 1, demands.reflections);
  const scene::TemperatureRange emitted = scene.temperatures().value_or(scene::TemperatureRange{});
  demands.coldest_k = emitted.coldest_k;
  demands.hottest_k = emitted.hottest_k;
  add_lamps(scene, demands);
  demands.all_glow = document.atmosphere.modelled && scene.all_emit();
  if (document.atmosphere.modelled) {
    parts.atmosphere =
        assemble_atmosphere(document.atmosphere, document.scene.origin, document.sensor, subject, surfaces,
                            demands, {options.threads, kept, atmosphere_progress(options), log});
    parts.nodes = &parts.atmosphere->nodes();
    parts.spectral_scene = std::make_unique<transport::SpectralScene>(scene, *parts.atmosphere, polarized);
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

void warn_of_node_errors(const Parts& parts, LogSink& log) {
  if (!parts.atmosphere && parts.nodes->worst_error() > kChannelError)
    log.warn(format("the nodes of the channels integrate some product of spectra only within {:.2g} %",
                    100.0 * parts.nodes->worst_error()));
}

}  // namespace ifov::session
