#include "io/quantities/radiance_quantities.h"

#include <cmath>
#include <vector>

#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "render/tolerance/node_budget.h"

namespace ifov::io::quantities {
namespace {

void put_radiance(const FinishedTile& of, ValueSink& sink) { sink.put(of.tile.mean); }

void put_standard_error(const FinishedTile& of, ValueSink& sink) {
  const auto &geometry = of.tile.variance_geometry, &path = of.tile.variance_path;
  std::vector<float> error(geometry.size());
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = std::sqrt(geometry[i] + path[i]);
  sink.put(error);
}

void put_half_width(const FinishedTile& of, ValueSink& sink) { sink.put(of.tile.half_width); }

void put_atmosphere_half_width(const FinishedTile& of, ValueSink& sink) {
  const auto& channels = of.image.channels;
  const sampling::TileLayer* const layer = of.tile.layer(render::StokesLayers::kBefore);
  const std::span<const float> before = layer == nullptr ? std::span<const float>{} : layer->values<float>();
  std::vector<float> air(of.tile.mean.size(), 0.0f);
  for (std::size_t i = 0; i < air.size(); ++i)
    if (const auto& channel = channels[i % channels.size()]; channel.air)
      air[i] = static_cast<float>(channel.air->of(of.tile.mean[i], before.empty() ? 0.0 : before[i]));
  sink.put(air);
}

void put_model_error(const FinishedTile& of, ValueSink& sink) {
  const auto& channels = of.image.channels;
  const sampling::TileLayer* const layer = of.tile.layer(render::StokesLayers::kBefore);
  const std::span<const float> before = layer == nullptr ? std::span<const float>{} : layer->values<float>();
  std::vector<float> model(of.tile.mean.size(), 0.0f);
  for (std::size_t i = 0; i < model.size(); ++i)
    if (const auto& channel = channels[i % channels.size()]; channel.air)
      model[i] = static_cast<float>(channel.air->of_model(of.tile.mean[i], before.empty() ? 0.0 : before[i]));
  sink.put(model);
}

void put_thermal_half_width(const FinishedTile& of, ValueSink& sink) {
  if (const sampling::TileLayer* const layer = of.tile.layer(render::kThermalLayer))
    sink.put(layer->values<float>());
  else
    sink.put(std::vector<float>(of.tile.mean.size(), 0.0f));
}

}  // namespace

constinit const Quantity kRadiance{.name = "radiance",
                                   .what = "radiance",
                                   .unit = "",
                                   .role = Quantity::Role::radiance,
                                   .statistic = Quantity::Statistic::mean,
                                   .type = EnviType::float32,
                                   .bands = Quantity::Bands::channels,
                                   .band_names = {},
                                   .usual = Quantity::Usual::yes,
                                   .values = put_radiance};

constinit const Quantity kStandardError{.name = "standard_error",
                                        .what = "standard error of radiance",
                                        .unit = "",
                                        .role = Quantity::Role::error,
                                        .statistic = Quantity::Statistic::standard_error,
                                        .type = EnviType::float32,
                                        .bands = Quantity::Bands::channels,
                                        .band_names = {},
                                        .needs = {.errors = true, .variances = true},
                                        .values = put_standard_error};

constinit const Quantity kHalfWidth{.name = "half_width",
                                    .what = "half-width of the radiance's interval",
                                    .unit = "",
                                    .role = Quantity::Role::error,
                                    .statistic = Quantity::Statistic::half_width,
                                    .type = EnviType::float32,
                                    .bands = Quantity::Bands::channels,
                                    .band_names = {},
                                    .usual = Quantity::Usual::yes,
                                    .needs = {.errors = true},
                                    .values = put_half_width};

constinit const Quantity kAtmosphereHalfWidth{
    .name = "air_half_width",
    .what = "part of the half-width that the air's computation adds",
    .unit = "",
    .role = Quantity::Role::error,
    .statistic = Quantity::Statistic::half_width,
    .type = EnviType::float32,
    .bands = Quantity::Bands::channels,
    .band_names = {},
    .needs = {.errors = true, .air = true},
    .values = put_atmosphere_half_width};

constinit const Quantity kAtmosphereModelError{
    .name = "air_model_error",
    .what =
        "how far the radiance may be off because the model of the air is not the air, of clouds as far as droplets and crystals are not what they are taken for",
    .unit = "",
    .role = Quantity::Role::error,
    .statistic = Quantity::Statistic::half_width,
    .type = EnviType::float32,
    .bands = Quantity::Bands::channels,
    .band_names = {},
    .needs = {.errors = true, .air = true},
    .values = put_model_error};

constinit const Quantity kThermalHalfWidth{.name = "thermal_half_width",
                                           .what = "what solved temperatures may be off by, as radiance",
                                           .unit = "",
                                           .role = Quantity::Role::error,
                                           .statistic = Quantity::Statistic::half_width,
                                           .type = EnviType::float32,
                                           .bands = Quantity::Bands::channels,
                                           .band_names = {},
                                           .needs = {.errors = true, .solved = true},
                                           .values = put_thermal_half_width};

}  // namespace ifov::io::quantities
