#include "render/unsampled_light.h"

#include "render/image_renderer.h"
#include "render/mirrors/glints.h"
#include "render/mirrors/highlights.h"
#include "render/mirrors/mirror_images.h"
#include "render/polarized/stokes_columns.h"
#include "render/unseen/unseen_bends.h"
#include "render/unseen/unseen_emitters.h"
#include "render/unseen/unseen_images.h"
#include "render/unseen/unseen_lobes.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

UnsampledLight::UnsampledLight(const RenderJob& job, int threads, const CancelToken* cancel)
    : job_(job), transport_(job.transport) {
  const double margin_px = job.wings.empty() ? job.reach_px() : WingSpots::kOutside_px;
  const LightTold told(job.polarimetry, job.parts);
  const StokesColumns columns(told, job.scene.nodes());
  for (std::size_t c = 0; c < columns.count(); ++c)
    channels_.push_back(columns.channel_of(static_cast<int>(c)));
  transport_.sought_only = true;
  if (transport_.maximum_scatterings != 0 && Glints::in(job.scene))
    glints_ = std::make_unique<const Glints>(job.scene, job.camera, margin_px, job.seed, told);
  if (transport_.maximum_scatterings < 0 || transport_.maximum_scatterings > 1)
    mirror_images_ =
        MirrorImages::find(job.scene, job.camera, transport_, margin_px, job.seed, threads, cancel, told);
  if (mirror_images_ != nullptr && !mirror_images_->apart().empty())
    transport_.separate_images = &mirror_images_->apart();
  if (mirror_images_ != nullptr)
    unseen_images_ = UnseenImages::find(job.scene, job.camera, *mirror_images_, job.seed);
  // Images in mirrors hold the highlights that they show.
  if (transport_.maximum_scatterings != 0 && Highlights::in(job.scene)) {
    highlights_ = std::make_unique<const Highlights>(job.scene, job.camera, margin_px, job.seed, told);
    transport_.highlights = transport::TransportOptions::Highlights::left_out;
    transport_.large_lobes = &highlights_->large();
    transport_.unsure_lobes = &highlights_->unsure();
  }
  if (transport_.maximum_scatterings == 0) return;
  unseen_emitters_ = UnseenEmitters::find(job.scene, job.camera);
  unseen_lobes_ = UnseenLobes::find(job.scene, job.camera, job.seed);
  unseen_bends_ = UnseenBends::find(job.scene, job.camera, job.seed);
}

UnsampledLight::~UnsampledLight() = default;

}  // namespace ifov::render
