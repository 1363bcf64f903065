#include "studies/common/study_rendering.h"

#include <chrono>

#include "io/document/document.h"
#include "render/image_renderer.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "studies/common/image_store.h"

namespace ifov::studies {

RenderTimes render_document(const std::string& text, const std::filesystem::path& folder,
                            const RenderChoices& choices, ImageStore& image) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const Clock::time_point start = Clock::now();
  const io::Document document = io::parse_document(text, (folder / "study.json").string());
  const session::Session session = session::Session::load(document, nullptr);
  const Clock::time_point loaded = Clock::now();
  const session::Session::Parts& parts = session.parts();
  const render::RenderJob own = parts.job();
  render::RenderJob job{own.scene,
                        own.camera,
                        own.footprint,
                        choices.sampler != nullptr ? *choices.sampler : own.sampler,
                        own.tolerance,
                        own.transport,
                        own.label_detail,
                        own.seed,
                        own.tile_px,
                        own.pilot_rays,
                        own.steering_channels,
                        own.air};
  job.nodes = own.nodes;
  job.groups = own.groups;
  job.wings = own.wings;
  job.cut = own.cut;
  job.outshining = own.outshining;
  image.begin(parts.info);
  render::RenderControl control;
  control.threads = choices.threads;
  control.cancel = choices.cancel;
  control.tile_order = choices.tile_order;
  render::render_image(job, control, image);
  return {seconds(loaded - start), seconds(Clock::now() - loaded)};
}

}  // namespace ifov::studies
