#include "session/facade/tiles_in_memory.h"

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/error.h"
#include "ifov/tile.h"
#include "io/product_parts/map_info.h"
#include "io/run_state/run_plan.h"
#include "render/image_renderer.h"
#include "render/tile_grid.h"
#include "sampling/reason_words.h"
#include "sampling/tile.h"
#include "session/facade/other_sampling.h"
#include "session/facade/tile_quantities.h"
#include "session/image_errors.h"
#include "session/loaded/parts.h"
#include "session/messages.h"
#include "session/runs/plan_assembly.h"
#include "session/runs/time_limit.h"
#include "session/told_tiles.h"

namespace ifov::session {
namespace {

/// Shows finished tiles to a program, and counts them.
class HandingOver final : public render::TileSink {
 public:
  HandingOver(ifov::TileSink& program, const io::RunPlan& plan)
      : program_(program), plan_(plan), quantities_(plan) {}
  void begin(const render::ImageInfo&) override { program_.begin(describe_image(plan_)); }
  void write(const sampling::TileResult& tile) override {
    const QuantityValues values = quantities_.of(tile);
    program_.write({.x_px = tile.tile.x0,
                    .y_px = tile.tile.y0,
                    .width_px = tile.tile.width(),
                    .height_px = tile.tile.height(),
                    .channels = tile.columns,
                    .radiance = tile.mean,
                    .half_width = tile.half_width,
                    .samples = tile.samples,
                    .reasons = tile.reasons,
                    .quantities = values.spans()});
    const std::scoped_lock lock(mutex_);
    ++count_;
    sampling::add_reasons(tile.reasons, reasons_);
  }
  std::size_t count() const { return count_; }
  const sampling::ReasonCounts& reasons() const { return reasons_; }

 private:
  ifov::TileSink& program_;
  const io::RunPlan& plan_;
  const AskedQuantities quantities_;
  std::mutex mutex_;
  std::size_t count_ = 0;
  sampling::ReasonCounts reasons_{};
};

/// Hands progress on, and keeps the last of it for a run that time ends.
class LastProgress final : public ProgressSink {
 public:
  LastProgress(ProgressSink* next, std::int64_t pixels) : next_(next) { last_.pixels_total = pixels; }
  void report(const Progress& progress) override {
    last_ = progress;
    if (next_ != nullptr) next_->report(progress);
  }
  const Progress& last() const { return last_; }

 private:
  ProgressSink* next_;
  Progress last_;
};

}  // namespace

ImageDescription describe_image(const io::RunPlan& plan) {
  const render::ImageInfo& image = plan.image;
  ImageDescription description{.width_px = image.width_px, .height_px = image.height_px, .channels = {}};
  for (const render::ChannelInfo& channel : image.channels)
    description.channels.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  description.materials = image.materials;
  if (image.has_map) description.geotransform = io::geotransform(image);
  if (image.has_map) description.crs = io::coordinate_system_text(image);
  description.seed = plan.identity.seed;
  description.accuracy_asked = plan.identity.accuracy_asked;
  description.confidence = plan.identity.confidence;
  return description;
}

RunResult render_tiles(const Session& session, const TileOptions& options, const io::Document* sampling,
                       TileSink& sink) {
  const Session::Parts& parts = session.parts();
  io::RunPlan plan = assemble_plan(parts, false);
  const std::optional<OtherSampling> other =
      sampling != nullptr ? std::optional<OtherSampling>(std::in_place, parts, *sampling) : std::nullopt;
  if (other) other->tell(plan);
  plan.cubes = quantities_named(options.quantities);
  HandingOver program(sink, plan);
  OneValue one_value(program);
  ImageErrors image_errors(one_value);
  const TimeLimit limit(options.deadline, options.cancel);
  LastProgress progress(options.progress,
                        static_cast<std::int64_t>(plan.image.width_px) * plan.image.height_px);
  render::RenderJob job = other ? other->job(parts) : parts.job();
  set_contents(plan, job);
  render::RenderControl control;
  control.threads = options.threads;
  control.cancel = limit.token();
  control.progress = &progress;
  if (options.progress != nullptr) options.progress->phase("");
  image_errors.begin(plan.image);
  try {
    render::render_image(job, control, image_errors);
  } catch (const Cancelled&) {
    if (!limit.reached()) throw;
  }
  RunResult result;
  result.summary.totals = progress.last();
  result.summary.accuracy_statement = accuracy_statement(plan, progress.last(), program.reasons(),
                                                         "the time limit came first", image_errors.errors());
  result.summary.judged = plan.judged;
  result.summary.one_value = one_value.holds() && !plan.image.views;
  result.tiles_done = program.count();
  result.tiles_left = plan.grid().size() - program.count();
  return result;
}

}  // namespace ifov::session
