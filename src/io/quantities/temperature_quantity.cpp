#include "io/quantities/temperature_quantity.h"

#include "io/quantities/layer_values.h"
#include "truth/temperature.h"

namespace ifov::io::quantities {
namespace {

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
                                      .values = put_layer<truth::kTemperature, float>};

}  // namespace ifov::io::quantities
