#include "ifov/simulation.h"

#include "core/call_scope.h"
#include "core/error.h"
#include "ifov/tile.h"
#include "io/files/inputs.h"
#include "io/run_state/run_plan.h"
#include "sampling/reasons.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/facade/rays.h"
#include "session/facade/run_outcome.h"
#include "session/facade/tiles_in_memory.h"
#include "session/loaded/parts.h"
#include "session/preview.h"
#include "session/runs/coordinator.h"
#include "session/runs/forecast.h"
#include "session/runs/plan_assembly.h"
#include "session/runs/run.h"
#include "session/session.h"

namespace ifov {
namespace {

void require_threads(int threads) {
  if (threads < 0) throw InputError(format("threads: {} was asked for; 0 takes all cores", threads));
}

/// What the command line cannot be given together.
void require_sense(const RenderOptions& options) {
  require_threads(options.threads);
  if (!options.keep_tiles && (options.start != RunStart::fresh || options.keep || options.refine))
    throw InputError(
        "keep_tiles: without finished tiles there is nothing to resume, restart, keep or refine");
  if (!options.keep_tiles && options.ranks != nullptr)
    throw InputError(
        "--no-state: several ranks put their tiles together in the run's folder; leave it out, or start one");
  if (options.share.number < 1 || options.share.count < options.share.number)
    throw InputError(format("share: found {}/{}; expected which share of how many, such as 1/64 to 64/64",
                            options.share.number, options.share.count));
}

}  // namespace

struct Simulation::Inside {
  session::Session session;
  std::shared_ptr<const io::Inputs> inputs;  ///< files are looked at again when they are rendered

  session::RunRequest request(const RenderOptions& options) const;
};

session::RunRequest Simulation::Inside::request(const RenderOptions& options) const {
  require_sense(options);
  session::RunRequest request;
  request.options.threads = options.threads;
  request.options.output_folder = options.folder;
  request.options.cancel = options.cancel;
  request.options.progress = options.progress;
  request.options.log = options.log;
  request.start = options.start;
  request.keep_tiles = options.keep_tiles;
  request.keep_finished = options.keep;
  request.refine = options.refine;
  request.anyway = options.anyway;
  request.share = {options.share.number, options.share.count};
  request.deadline = options.deadline;
  request.coordinator = FacadeAccess::coordinator(options.ranks);
  return request;
}

Simulation::Simulation(std::unique_ptr<const Inside> inside) : inside_(std::move(inside)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Simulation Simulation::load(const Document& document, const LoadOptions& options) {
  return FacadeAccess::load(document, options, nullptr);
}

Simulation FacadeAccess::load(const Document& document, const LoadOptions& options,
                              session::SharedScene* shared) {
  require_threads(options.threads);
  const auto& source = FacadeAccess::inside(document);
  if (options.ranks != nullptr && source.inputs->assets)
    throw InputError("ranks: the others have no assets; several ranks load what is in files alone");
  const Call call{source.inputs, options.cancel};
  const CallScope scope(call);
  const session::LoadOptions load{.scene_cache = options.scene_cache,
                                  .threads = options.threads,
                                  .cancel = options.cancel,
                                  .progress = options.progress,
                                  .shared = shared};
  session::Coordinator* const coordinator = FacadeAccess::coordinator(options.ranks);
  session::Session session = coordinator != nullptr
                                 ? coordinator->load(source.document, options.log, load)
                                 : session::Session::load(source.document, options.log, load);
  return Simulation(
      std::make_unique<const Simulation::Inside>(Simulation::Inside{std::move(session), source.inputs}));
}

ImageDescription Simulation::image() const {
  return session::describe_image(session::assemble_plan(inside_->session.parts(), false));
}

std::string Simulation::description() const { return inside_->session.description(); }

const std::vector<std::string>& Simulation::warnings() const { return inside_->session.warnings(); }

Outcome Simulation::render(const RenderOptions& options) const {
  const Call call{
      inside_->inputs};  // what is finished is put away undisturbed: the run itself asks options.cancel
  const CallScope scope(call);
  return session::outcome_of(session::render_run(inside_->session, inside_->request(options)), warnings());
}

Forecast Simulation::forecast(const RenderOptions& options) const {
  const Call call{inside_->inputs};
  const CallScope scope(call);
  return session::forecast_run(inside_->session, inside_->request(options));
}

Preview Simulation::preview(const PreviewOptions& options) const {
  require_threads(options.threads);
  return session::make_preview(inside_->session.parts(), options);
}

std::vector<RayHit> Simulation::cast(std::span<const std::array<double, 3>> origins_m,
                                     std::span<const std::array<double, 3>> directions, int threads) const {
  require_threads(threads);
  return session::cast_rays(inside_->session.parts(), origins_m, directions, threads);
}

Outcome Simulation::render_tiles(TileSink& sink, const TileOptions& options) const {
  require_threads(options.threads);
  const io::Document* const sampling =
      options.sampling != nullptr ? &FacadeAccess::inside(*options.sampling).document : nullptr;
  return session::outcome_of(session::render_tiles(inside_->session, options, sampling, sink), warnings());
}

std::string_view reason_name(int bit) {
  const auto place = static_cast<std::size_t>(bit);
  return bit >= 0 && place < sampling::kReasonNames.size() ? sampling::kReasonNames[place]
                                                           : std::string_view();
}

}  // namespace ifov
