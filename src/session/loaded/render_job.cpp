#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/polarized/polarimetry.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/wings/wing_light.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

render::RenderJob Parts::job() const { return job(plan, tolerance.get()); }

render::RenderJob Parts::job(const SamplingPlan& sampling, const render::AccuracyTolerance* limits) const {
  render::RenderJob job{*spectral_scene, *camera, *footprint, *sampling.sampler};
  job.tolerance = limits;
  job.polarimetry = polarimetry.get();
  job.groups = groups.get();
  job.responses = responses.get();
  for (const auto& of_group : wings) job.wings.push_back(of_group.get());
  job.cut = psf_cut;
  job.outshining = outshining;
  job.nodes = node_errors;
  job.air = air;
  if (document.sampling.max_depth) job.transport.maximum_scatterings = *document.sampling.max_depth;
  job.transport.mirror_reflections = document.sampling.mirror_reflections;
  job.image_wide = sampling.request && sampling.request->image_wide;
  job.label_detail = sampling.request && !sampling.request->image_wide ? render::LabelDetail::sun_state
                                                                       : render::LabelDetail::material;
  job.seed = document.seed;
  job.tile_px = document.sampling.tile_px;
  job.pilot_rays = sampling.pilot_rays;
  job.steering_channels = sampling.steering_channels;
  return job;
}

void Parts::make_tolerance() { tolerance = tolerance_of(plan); }

std::unique_ptr<render::AccuracyTolerance> Parts::tolerance_of(const SamplingPlan& sampling) const {
  if (!sampling.request) return nullptr;
  render::AccuracyRequest request = *sampling.request;
  // Half-widths of what paths carry add up to a channel's by their weights.
  request.error /= most_spread;
  auto limits = std::make_unique<render::AccuracyTolerance>(
      std::move(request), *brightness, spectral_scene->white_reflected(),
      static_cast<std::int64_t>(camera->width_px()) * camera->height_px(), spectral_scene->path_radiance(),
      air);
  if (polarimetry) {
    std::vector<double> passed;
    for (std::size_t c = 0; c < polarimetry->optics.size(); ++c) passed.push_back(polarimetry->passed(c));
    limits->judge_stokes(polarimetry->stokes, std::move(passed));
  }
  limits->leave_room(node_errors, !wings.empty() ? render::kCutShare : 0.0);
  return limits;
}

}  // namespace ifov::session
