#include "io/quantities/temperature_quantity.h"

#include "io/quantities/layer_values.h"
#include "truth/pixel_fluxes.h"
#include "truth/pixel_temperature.h"
#include "truth/temperature.h"

namespace ifov::io::quantities {
namespace {

constexpr std::string_view kBands[] = {"temperature", "standard deviation"};
constexpr std::string_view kPixelBands[] = {
    "mean temperature",       "standard deviation over the pixel", "lowest", "highest",
    "half-width of the mean", "share with a temperature"};

constexpr std::string_view kFluxBands[] = {"direct sunlight absorbed",
                                           "skylight absorbed",
                                           "sunlight absorbed by way of the scene",
                                           "long-wave of the sky absorbed",
                                           "long-wave of the scene absorbed",
                                           "long-wave emitted",
                                           "convection",
                                           "latent heat",
                                           "heat from inside",
                                           "conduction from the solid",
                                           "standard error of direct sunlight absorbed",
                                           "standard error of skylight absorbed",
                                           "standard error of sunlight absorbed by way of the scene",
                                           "standard error of long-wave of the sky absorbed",
                                           "standard error of long-wave of the scene absorbed",
                                           "standard error of long-wave emitted",
                                           "standard error of convection",
                                           "standard error of latent heat",
                                           "standard error of heat from inside",
                                           "standard error of conduction from the solid",
                                           "share with a solved temperature"};

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

constinit const Quantity kFluxes{
    .name = "fluxes",
    .what = "heat that the surfaces in each pixel gain whose temperature is solved, with standard errors",
    .unit = "W m-2",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::pixel,
    .type = EnviType::float32,
    .bands = Quantity::Bands::named,
    .band_names = kFluxBands,
    .needs = {.solved = true},
    .collector = &truth::kPixelFluxes,
    .values = put_layer<truth::kPixelFluxes, float>};

}  // namespace ifov::io::quantities
