#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/profile/profile.h"
#include "core/format.h"
#include "io/document/cloud_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {

SchemaType<std::vector<CloudDocument>> clouds_type() {
  Record<CloudDocument> record(
      "cloud",
      "A level layer of droplets or of ice crystals, the same everywhere: sunlight, sky and paths go through it, and it glows.");
  record
      .required("kind", &CloudDocument::kind, word_type({"water", "ice"}),
                "droplets, or rough crystals of many shapes")
      .required("base", &CloudDocument::base_km, quantity(kLength, {}, 1e-3), "above mean sea level")
      .required("top", &CloudDocument::top_km, quantity(kLength, {}, 1e-3), "above mean sea level")
      .exactly_one()
      .one("optical_depth", &CloudDocument::optical_depth,
           number(Range::between(0.0, atmosphere::kThickestCloud)), "vertical, at 0.55 um")
      .one("water_path", &CloudDocument::water_path_g_m2, quantity(kCloudWater, Range::at_least(0.0, "g/m2")),
           "of liquid water or of ice in a vertical column")
      .optional(
          "effective_radius", &CloudDocument::effective_radius_um,
          quantity(kWavelength, Range::between(1.0, 200.0, "um")),
          "3/4 of volume over mean projected area; 10 um of droplets and 30 um of crystals if nothing is said")
      .with_default("variance", &CloudDocument::effective_variance, number(Range::between(0.005, 0.33)),
                    "0.1", "of the radius about the effective one, over its square: a gamma distribution")
      .check([](const CloudDocument& cloud, const DocumentNode& node) {
        if (cloud.top_km > atmosphere::kTopOfAtmosphereKm)
          node.given("top").fail(format("the cloud reaches to {:g} km, above the air, which ends at {:g} km",
                                        cloud.top_km, atmosphere::kTopOfAtmosphereKm));
        if (!(cloud.top_km > cloud.base_km))
          node.given("top").fail(format("the cloud ends at {:g} km, not above its base at {:g} km",
                                        cloud.top_km, cloud.base_km));
      });
  return list(record.type(), 1, 20);
}

}  // namespace ifov::io
