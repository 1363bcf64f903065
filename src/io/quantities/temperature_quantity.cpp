#include "io/quantities/temperature_quantity.h"

#include "io/quantities/layer_values.h"
#include "truth/pixel_temperature.h"
#include "truth/temperature.h"

namespace ifov::io::quantities {
namespace {

constexpr std::string_view kBands[] = {"temperature", "standard deviation"};
constexpr std::string_view kPixelBands[] = {
    "mean temperature",       "standard deviation over the pixel", "lowest", "highest",
    "half-width of the mean", "share with a temperature"};

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

constinit const Quantity kPixelTemperature{
    .name = "pixel_temperature",
    .what = "temperature of the surfaces in each pixel: mean, spread and ends, and the share that has one",
    .unit = "K",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::pixel,
    .type = EnviType::float32,
    .bands = Quantity::Bands::named,
    .band_names = kPixelBands,
    .collector = &truth::kPixelTemperature,
    .values = put_layer<truth::kPixelTemperature, float>};

}  // namespace ifov::io::quantities
