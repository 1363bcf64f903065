#include "session/facade/other_sampling.h"

#include "core/error.h"
#include "io/document/document.h"
#include "io/run_state/run_plan.h"
#include "render/image_renderer.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "session/loaded/parts.h"

namespace ifov::session {

OtherSampling::OtherSampling(const Parts& parts, const io::Document& document)
    : document_(document),
      plan_(assemble_sampling(document.sources, document.sampling, document.sensor, parts.told_channels,
                              parts.responses.get())) {
  if (plan_.knows_errors && !parts.plan.knows_errors)
    throw InputError(
        "sampling: the scene was loaded for single rays, which know no error; load it with another sampling");
  check_image_size(document.sources, document.sampling,
                   static_cast<std::int64_t>(parts.info.width_px) * parts.info.height_px);
  tolerance_ = parts.tolerance_of(plan_);
}

OtherSampling::~OtherSampling() = default;

void OtherSampling::tell(io::RunPlan& plan) const {
  plan.identity.seed = document_.seed;
  plan.identity.sampler = plan_.method;
  plan.identity.accuracy_asked = plan_.accuracy_asked;
  if (tolerance_) plan.identity.confidence = tolerance_->confidence();
  plan.judged = tolerance_ != nullptr;
  plan.image_wide = plan_.request && plan_.request->image_wide;
  plan.knows_errors = plan_.knows_errors;
  plan.tile_px = document_.sampling.tile_px;
}

render::RenderJob OtherSampling::job(const Parts& parts) const {
  render::RenderJob job = parts.job(plan_, tolerance_.get());
  if (document_.sampling.max_depth) job.transport.maximum_scatterings = *document_.sampling.max_depth;
  job.transport.mirror_reflections = document_.sampling.mirror_reflections;
  job.seed = document_.seed;
  job.tile_px = document_.sampling.tile_px;
  return job;
}

}  // namespace ifov::session
