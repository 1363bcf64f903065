#include "render/tolerance/atmosphere_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "materials/bsdf/bsdf.h"
#include "render/polarized/polarimetry.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "transport/sky/adjacent_ground.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// How far Q/I and U/I of path and sky may be off between the directions of their tables
/// (tests/transport/test_polarized_light.cpp).
constexpr double kPathPolarization = 3e-3, kSkyPolarization = 0.02;

/// By channel, from the ground to the sensor.
std::vector<double> transmittances(const transport::SpectralScene& scene) {
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<double> seen(nodes.channel_count(), 0.0);
  for (std::size_t c = 0; c < seen.size(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      seen[c] += nodes.node_weight(n) * scene.view_transmittance()[n];
  return seen;
}

void add_model_error(const atmosphere::ChannelModelError& model, double transmittance,
                     AtmosphereHalfWidth& air) {
  air.model_of_bands = model.of_bands ? 1.0 : 0.0;
  air.model_surface = model.surface;
  air.model_sunlight = model.sunlight;
  air.model_emission = model.emission_less;
  const double scattered = std::max(0.0, air.path_radiance - model.emission);
  air.model_path = (model.scattered + model.by_shape + model.by_clouds) * scattered + model.scattered_floor +
                   model.emission_other;
  if (!(air.white_in_sky > 0.0)) return;
  const double warm = std::min(air.white_in_sky, transmittance * model.sky_emission);
  const double of_warm = model.sky_emission > 0.0 ? model.sky_change / model.sky_emission : 0.0;
  air.model_sky = (of_warm * warm + (model.scattered + model.sky_by_clouds) * (air.white_in_sky - warm)) /
                  air.white_in_sky;
}

}  // namespace

std::vector<AtmosphereHalfWidth> atmosphere_half_widths(const transport::SpectralScene& scene,
                                                        const atmosphere::SensorAtmosphere& atmosphere) {
  std::vector<AtmosphereHalfWidth> all;
  constexpr double kGrey = 0.2, kGrey_k = 288.15;
  const radiometry::SpectralNodes& nodes = scene.nodes();
  const std::vector<double> white = scene.white_reflected(), path = scene.path_radiance();
  std::vector<double> planck(nodes.node_count());
  nodes.planck(kGrey_k, planck);
  const std::vector<double> seen = transmittances(scene);
  for (std::size_t c = 0; c < atmosphere.errors().size(); ++c) {
    const atmosphere::AtmosphereError error = atmosphere.errors()[c].total(),
                                      &by_nodes = atmosphere.errors()[c].nodes;
    AtmosphereHalfWidth& air = all.emplace_back();
    air.path = error.path, air.surface = error.surface, air.sky = error.sky;
    if (const transport::AdjacentGround* adjacent = scene.adjacent_ground())
      air.path += adjacent->path_error[c];
    air.path_radiance = path[c];
    air.nodes_path = by_nodes.path, air.nodes_surface = by_nodes.surface, air.nodes_sky = by_nodes.sky;
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n) {
      air.grey_radiance += nodes.node_weight(n) * (1.0 - kGrey) * planck[n] * scene.view_transmittance()[n];
      air.white_in_sky += nodes.node_weight(n) * scene.sky_radiance()[n] * scene.view_transmittance()[n];
    }
    if (scene.polarized() && atmosphere.polarized()) {
      air.polarization_path = kPathPolarization;
      for (const materials::Material& material : scene.scene().materials)
        if (material.bsdf->polarizes()) air.polarization_sky = kSkyPolarization;
    }
    air.grey_radiance += air.path_radiance + kGrey * white[c];
    add_model_error(atmosphere.errors()[c].model, seen[c], air);
  }
  return all;
}

void pass_optics(const Polarimetry& polarimetry, std::span<AtmosphereHalfWidth> air) {
  for (std::size_t c = 0; c < air.size() && c < polarimetry.optics.size(); ++c) {
    const radiometry::MuellerMatrix& optics = polarimetry.optics[c];
    if (optics(0, 1) != 0.0 || optics(0, 2) != 0.0 || optics(0, 3) != 0.0)
      air[c].passed = polarimetry.passed(c);
  }
}

void widen(std::span<const AtmosphereHalfWidth> air, const AccuracyTolerance* tolerance,
           sampling::TileResult& tile) {
  if (air.empty() || !tile.has_errors()) return;
  const std::size_t columns = static_cast<std::size_t>(tile.columns);
  std::vector<double> mean(columns), limit(columns), more(columns);
  const std::size_t channels = air.size();  // behind them Q, U and V, and I before polarizers (Polarimetry)
  const std::size_t kinds = columns / channels;
  const bool optics = kinds == 2 || kinds == 5;
  const std::size_t told = columns - (optics ? channels : 0);
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    for (std::size_t c = 0; c < columns; ++c) {
      mean[c] = tile.mean[p * columns + c];
      const std::size_t channel = c % channels;
      const double before = optics ? static_cast<double>(tile.mean[p * columns + told + channel]) : 0.0;
      if (c < told)
        more[c] = c < channels ? air[c].all_of(mean[c], before)
                               : air[channel].of_polarization(mean[channel], before);
      tile.add_bound(p * columns + c, more[c]);
    }
    if (tolerance == nullptr) continue;
    tolerance->asked(mean, limit);
    double worst = 0.0;
    bool no_room = false;
    for (std::size_t c = 0; c < columns; ++c) {
      no_room = no_room || more[c] > tolerance->most_bounded() * limit[c];
      const double ratio = tile.joined(p * columns + c, tolerance->joint()) / limit[c];
      worst = std::max(worst, std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
    }
    tile.worst_ratio[p] = static_cast<float>(worst);
    // A little more than the limit is the rounding of the sum.
    constexpr double kRounding = 1e-5;
    // What else kept a pixel from its limit is not the air's fault, unless the air alone would have.
    if (worst > 1.0 + kRounding && (no_room || tile.converged(p))) tile.set(p, sampling::Reason::air);
  }
}

}  // namespace ifov::render
