#include "io/document/samplers/sampler_model.h"
#include "io/document/sampling_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
SchemaType<SamplingDocument> sampling_type() {
  Record<SamplingDocument> record("sampling",
                                  "How many rays, and where; accuracy sampling if none is given.");
  record.at_most_one();
  for (const SamplerModel* model : sampler_models())
    record.one(std::string(model->key), &SamplingDocument::method, model->type(), std::string(model->what));
  record
      .with_default("tile", &SamplingDocument::tile_px, integer(1, 4096), "64",
                    "pixels along a side of the tiles that are computed at once")
      .with_default(
          "mirror_reflections", &SamplingDocument::mirror_reflections, integer(0, 8), "8",
          "flat mirrors, one after the other, by way of which sunlight is sought; where more may matter, "
          "pixels are marked. With 0 neither sunlight nor what shines is sought by way of any mirror, round ones "
          "included")
      .optional(
          "max_depth", &SamplingDocument::max_depth, integer(1, 10000),
          "surfaces a path may meet, for light that is cut short on purpose; without it no light is lost");
  return record.type();
}

}  // namespace ifov::io
