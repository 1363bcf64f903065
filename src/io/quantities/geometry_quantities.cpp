#include "io/quantities/geometry_quantities.h"

#include "io/quantities/layer_values.h"
#include "truth/gsd.h"
#include "truth/orientation.h"
#include "truth/range.h"
#include "truth/time.h"

namespace ifov::io::quantities {
namespace {

constexpr std::string_view kRangeBands[] = {"range"}, kNormalBands[] = {"east", "north", "up"},
                           kSlopeBands[] = {"slope", "aspect"}, kGsdBands[] = {"across", "along"},
                           kTimeBands[] = {"time"};

}  // namespace

constinit const Quantity kRange{.name = "range",
                                .what = "distance from the sensor to what the middle of each pixel sees",
                                .unit = "m",
                                .role = Quantity::Role::truth,
                                .statistic = Quantity::Statistic::middle,
                                .type = EnviType::float64,
                                .bands = Quantity::Bands::named,
                                .band_names = kRangeBands,
                                .collector = &truth::kRange,
                                .values = put_layer<truth::kRange, double>};

constinit const Quantity kNormal{.name = "normal",
                                 .what = "normal of what the middle of each pixel sees",
                                 .unit = "1",
                                 .role = Quantity::Role::truth,
                                 .statistic = Quantity::Statistic::middle,
                                 .type = EnviType::float32,
                                 .bands = Quantity::Bands::named,
                                 .band_names = kNormalBands,
                                 .collector = &truth::kNormal,
                                 .values = put_layer<truth::kNormal, float>};

constinit const Quantity kSlope{.name = "slope",
                                .what = "slope of what the middle of each pixel sees, and where it faces",
                                .unit = "deg",
                                .role = Quantity::Role::truth,
                                .statistic = Quantity::Statistic::middle,
                                .type = EnviType::float32,
                                .bands = Quantity::Bands::named,
                                .band_names = kSlopeBands,
                                .collector = &truth::kSlope,
                                .values = put_layer<truth::kSlope, float>};

constinit const Quantity kGsd{.name = "gsd",
                              .what = "size of each pixel on what its middle sees",
                              .unit = "m",
                              .role = Quantity::Role::truth,
                              .statistic = Quantity::Statistic::middle,
                              .type = EnviType::float32,
                              .bands = Quantity::Bands::named,
                              .band_names = kGsdBands,
                              .collector = &truth::kGsd,
                              .values = put_layer<truth::kGsd, float>};

constinit const Quantity kTime{
    .name = "time",
    .what = "time from the acquisition time to when the middle of each pixel was seen",
    .unit = "s",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::middle,
    .type = EnviType::float64,
    .bands = Quantity::Bands::named,
    .band_names = kTimeBands,
    .collector = &truth::kTime,
    .values = put_layer<truth::kTime, double>};

}  // namespace ifov::io::quantities
