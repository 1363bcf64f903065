#include "ifov/simulation.h"

#include "core/error.h"
#include "sampling/reasons.h"
#include "session/facade/document_inside.h"
#include "session/facade/run_outcome.h"
#include "session/facade/tiles_in_memory.h"
#include "session/loaded/parts.h"
#include "session/runs/run.h"

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
}

}  // namespace

struct Simulation::Inside {
  session::Session session;
};

Simulation::Simulation(std::unique_ptr<const Inside> inside) : inside_(std::move(inside)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Simulation Simulation::load(const Document& document, const LoadOptions& options) {
  require_threads(options.threads);
  const session::LoadOptions load{.scene_cache = options.scene_cache,
                                  .threads = options.threads,
                                  .cancel = options.cancel,
                                  .progress = options.progress};
  return Simulation(std::make_unique<const Inside>(
      Inside{session::Session::load(document.inside_->document, options.log, load)}));
}

ImageDescription Simulation::image() const { return session::describe_image(inside_->session.parts().info); }

std::string Simulation::description() const { return inside_->session.description(); }

const std::vector<std::string>& Simulation::warnings() const { return inside_->session.warnings(); }

Outcome Simulation::render(const RenderOptions& options) const {
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
  request.deadline = options.deadline;
  return session::outcome_of(session::render_run(inside_->session, request), warnings());
}

Outcome Simulation::render_tiles(TileSink& sink, const TileOptions& options) const {
  require_threads(options.threads);
  return session::outcome_of(session::render_tiles(inside_->session, options, sink), warnings());
}

std::string_view reason_name(int bit) {
  const auto place = static_cast<std::size_t>(bit);
  return bit >= 0 && place < sampling::kReasonNames.size() ? sampling::kReasonNames[place]
                                                           : std::string_view();
}

}  // namespace ifov
