#include "io/quantities/sunlight_quantities.h"

#include "io/quantities/layer_values.h"
#include "truth/sky_view.h"
#include "truth/sunlight.h"

namespace ifov::io::quantities {
namespace {

constexpr std::string_view kAngleBands[] = {"sun zenith", "sun azimuth", "incidence"},
                           kShadowBands[] = {"shadow"}, kSkyViewBands[] = {"sky view", "half-width"};

}  // namespace

constinit const Quantity kSunAngles{
    .name = "sun_angles",
    .what = "direction to the Sun, and its angle to the normal of what the middle of each pixel sees",
    .unit = "deg",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::middle,
    .type = EnviType::float32,
    .bands = Quantity::Bands::named,
    .band_names = kAngleBands,
    .collector = &truth::kSunAngles,
    .values = put_layer<truth::kSunAngles, float>};

constinit const Quantity kShadow{.name = "shadow",
                                 .what = "whether the Sun is hidden from what the middle of each pixel sees",
                                 .unit = "1",
                                 .role = Quantity::Role::truth,
                                 .statistic = Quantity::Statistic::middle,
                                 .type = EnviType::float32,
                                 .bands = Quantity::Bands::named,
                                 .band_names = kShadowBands,
                                 .collector = &truth::kShadow,
                                 .values = put_layer<truth::kShadow, float>};

constinit const Quantity kSkyView{
    .name = "sky_view",
    .what =
        "share of the sky that what the middle of each pixel sees has before it, weighed by cosines, and the half-width of its 95 % interval",
    .unit = "1",
    .role = Quantity::Role::truth,
    .statistic = Quantity::Statistic::middle,
    .type = EnviType::float32,
    .bands = Quantity::Bands::named,
    .band_names = kSkyViewBands,
    .collector = &truth::kSkyView,
    .values = put_layer<truth::kSkyView, float>};

}  // namespace ifov::io::quantities
