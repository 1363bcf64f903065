#include "io/quantities/temperature_quantity.h"

#include <limits>
#include <vector>

#include "render/tile_sink.h"
#include "truth/temperature.h"

namespace ifov::io::quantities {
namespace {

void put_temperatures(const FinishedTile& of, ValueSink& sink) {
  const sampling::TileLayer* const layer = of.tile.layer(truth::kTemperature.name);
  if (layer == nullptr)
    return sink.put(std::vector<float>(2 * of.tile.samples.size(), std::numeric_limits<float>::quiet_NaN()));
  sink.put(layer->values<float>());
}

constexpr std::string_view kBands[] = {"temperature", "standard deviation"};

}  // namespace

constinit const Quantity kTemperature{.name = "temperature",
                                      .what = "temperature of what the middle of each pixel sees",
                                      .unit = "K",
                                      .role = Quantity::Role::truth,
                                      .statistic = Quantity::Statistic::middle,
                                      .type = EnviType::float32,
                                      .bands = Quantity::Bands::named,
                                      .band_names = kBands,
                                      .collector = &truth::kTemperature,
                                      .values = put_temperatures};

}  // namespace ifov::io::quantities
