#include "io/quantities/part_quantities.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "render/parts/part_columns.h"
#include "render/tile_sink.h"
#include "render/truth_layers.h"

namespace ifov::io::quantities {
namespace {

using transport::LightPart;

/// Of a layer that holds all of them; of a gap of the image, which has none, not numbers.
void put_part(const FinishedTile& of, const char* name, LightPart part, ValueSink& sink) {
  const std::size_t channels = of.image.channels.size(), pixels = of.tile.samples.size();
  std::vector<float> values(pixels * channels, std::numeric_limits<float>::quiet_NaN());
  if (const sampling::TileLayer* const layer = of.tile.layer(name)) {
    const std::span<const float> all = layer->values<float>();
    const std::size_t row = transport::kLightParts * channels,
                      first = static_cast<std::size_t>(part) * channels;
    for (std::size_t p = 0; p < pixels; ++p)
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(p * row + first), channels,
                  values.begin() + static_cast<std::ptrdiff_t>(p * channels));
  }
  sink.put(values);
}

template <LightPart kPart>
constexpr Quantity part(std::string_view name, std::string_view what) {
  return {.name = name,
          .what = what,
          .unit = kPart == LightPart::transmittance ? "1" : "",
          .role = Quantity::Role::truth,
          .statistic = Quantity::Statistic::mean,
          .type = EnviType::float32,
          .bands = Quantity::Bands::channels,
          .band_names = {},
          .needs = {.parts = true},
          .values = [](const FinishedTile& of, ValueSink& sink) {
            put_part(of, render::PartLayers::kMean, kPart, sink);
          }};
}

template <LightPart kPart>
constexpr Quantity error_of(std::string_view name, std::string_view what) {
  Quantity quantity = part<kPart>(name, what);
  quantity.role = Quantity::Role::error;
  quantity.statistic = Quantity::Statistic::standard_error;
  quantity.needs.errors = true;
  quantity.values = [](const FinishedTile& of, ValueSink& sink) {
    put_part(of, render::PartLayers::kStandardError, kPart, sink);
  };
  return quantity;
}

}  // namespace

constinit const Quantity kEmittedRadiance =
    part<LightPart::emitted>("emitted_radiance", "part of the radiance that the surface seen emits");
constinit const Quantity kEmittedRadianceError = error_of<LightPart::emitted>(
    "emitted_radiance_standard_error", "standard error of the part of the radiance that the surface emits");
constinit const Quantity kSunRadiance = part<LightPart::sun>(
    "sun_radiance", "part of the radiance that is sunlight which fell straight on the surface seen");
constinit const Quantity kSunRadianceError = error_of<LightPart::sun>(
    "sun_radiance_standard_error", "standard error of the part of the radiance that is sunlight");
constinit const Quantity kSkyRadiance = part<LightPart::sky>(
    "sky_radiance", "part of the radiance that is light of the sky which fell straight on the surface seen");
constinit const Quantity kSkyRadianceError = error_of<LightPart::sky>(
    "sky_radiance_standard_error", "standard error of the part of the radiance that is light of the sky");
constinit const Quantity kSceneRadiance = part<LightPart::scene>(
    "scene_radiance",
    "part of the radiance that came to the surface seen from other surfaces and from lamps");
constinit const Quantity kSceneRadianceError = error_of<LightPart::scene>(
    "scene_radiance_standard_error", "standard error of the part of the radiance that is light of the scene");
constinit const Quantity kPathRadiance = part<LightPart::path>(
    "path_radiance", "part of the radiance that the air before the surface seen adds, and the sky itself");
constinit const Quantity kPathRadianceError = error_of<LightPart::path>(
    "path_radiance_standard_error", "standard error of the part of the radiance that is light of the air");
constinit const Quantity kTransmittance = part<LightPart::transmittance>(
    "transmittance", "what the air leaves of light on its way from the surface seen to the sensor");
constinit const Quantity kTransmittanceError =
    error_of<LightPart::transmittance>("transmittance_standard_error", "standard error of the transmittance");

constinit const Quantity kEmissivity{
    .name = "emissivity",
    .what = "emissivity, towards the sensor, of what the middle of each pixel sees",
    .unit = "1",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::middle,
    .type = EnviType::float32,
    .bands = Quantity::Bands::channels,
    .band_names = {},
    .needs = {.emissivity = true},
    .values = [](const FinishedTile& of, ValueSink& sink) {
      if (const sampling::TileLayer* const layer = of.tile.layer(render::kEmissivityLayer))
        sink.put(layer->values<float>());
      else
        sink.put(std::vector<float>(of.tile.samples.size() * of.image.channels.size(),
                                    std::numeric_limits<float>::quiet_NaN()));
    }};

}  // namespace ifov::io::quantities
