#include "session/runs/worker.h"

#include <filesystem>
#include <mutex>

#include "cluster/tile_client.h"
#include "core/error.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_folder.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "session/loaded/parts.h"
#include "session/runs/plan_assembly.h"
#include "session/runs/rank_messages.h"
#include "session/runs/refinement.h"
#include "session/runs/time_limit.h"
#include "session/session.h"

namespace ifov::session {
namespace {

using cluster::Fault;
using cluster::Tag;

class StoringSink final : public render::TileSink {
 public:
  StoringSink(io::TileStore& store, const io::RunPlan& plan) : store_(store), plan_(plan) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    store_.put(static_cast<std::uint32_t>(render::tile_index(tile.tile.x0, tile.tile.y0, plan_.image.width_px,
                                                             plan_.tile_px, plan_.image.sweep_lines)),
               tile);
  }

 private:
  io::TileStore& store_;
  const io::RunPlan& plan_;
};

/// Tiles of other programs, documents or machines would not fit; and those that the first rank cannot see are lost.
void require_same(const SharedRun& run, io::RunPlan own, bool knows_files) {
  if (!knows_files) own.files = run.plan.files;
  // These are not of the document; the first rank alone knows the run's folder.
  own.keeps_memory = run.plan.keeps_memory;
  own.base = run.plan.base;
  std::string message;
  for (const std::string& line : io::differences(run.plan, own)) message += format("\n  {}", line);
  if (!message.empty())
    throw InputError(format("its tiles would not fit those of the first rank, there and here:{}", message));
  const std::filesystem::path file = io::plan_file(run.folder);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) || io::read_plan(file).key() != run.plan.key())
    throw SystemError(format(
        "'{}', which the first rank wrote, is not to be seen from here: the output folder (--output) must be on "
        "a file system that all machines share, and all ranks must start in the same folder",
        file.string()));
}

/// Warnings go to the first rank in the end.
class Warnings final : public LogSink {
 public:
  explicit Warnings(std::string rank) : rank_(std::move(rank)) {}
  void info(const std::string&) override {}
  void warn(const std::string& message) override {
    const std::scoped_lock lock(mutex_);
    all_.push_back(format("{}: {}", rank_, message));
  }
  /// When nobody warns any more.
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::string rank_;
  std::mutex mutex_;
  std::vector<std::string> all_;
};

class Worker {
 public:
  Worker(cluster::Communicator& communicator, const WorkerOptions& options)
      : communicator_(communicator),
        options_(options),
        threads_(options.threads > 0 ? options.threads : communicator.usual_threads()) {}

  /// False where the run is over before it began.
  bool load() {
    if (!wait_for(Tag::load)) return false;
    Loaded loaded;
    loaded.threads = threads_;
    try {
      LoadOptions load;
      load.scene_cache = options_.scene_cache;
      load.threads = threads_;
      load.cancel = options_.cancel;
      session_.emplace(Session::load_file(options_.document, options_.overrides, nullptr, load));
      plan_ = assemble_plan(session_->parts(), reads_files());
    } catch (...) {
      loaded.fault = cluster::current_fault();
    }
    communicator_.send(0, Tag::loaded, payload_of(loaded));
    return !loaded.fault;
  }

  void render() {
    if (!wait_for(Tag::begin)) return;
    cluster::TileClient tiles(communicator_, threads_, options_.cancel);
    Warnings warnings(communicator_.name(communicator_.rank()));
    int packs = 0;
    Fault fault;
    try {
      packs = render(shared_run_in(payload_), tiles, warnings);
    } catch (...) {
      fault = cluster::current_fault();
    }
    tiles.farewell(tiles.was_stopped() ? Fault{} : fault, packs, warnings.all());
  }

 private:
  /// Until that message comes, or the run is over.
  bool wait_for(Tag tag) {
    while (true) {
      cluster::Message message = communicator_.receive(nullptr);
      payload_ = std::move(message.payload);
      if (message.tag == tag) return true;
      if (message.tag == Tag::end) return false;
    }
  }

  bool reads_files() const { return communicator_.is_first_on_node(communicator_.rank()); }

  /// How many packs it has written.
  int render(const SharedRun& run, cluster::TileClient& tiles, LogSink& log) {
    require_same(run, plan_, reads_files());
    std::optional<TimeLimit::Clock::time_point> end;
    if (run.seconds_left)
      end = TimeLimit::Clock::now() + std::chrono::duration_cast<TimeLimit::Clock::duration>(
                                          std::chrono::duration<double>(*run.seconds_left));
    const TimeLimit limit(end, tiles.token());
    io::TileStore store(io::state_folder(run.folder) / "tiles", run.plan.key(), run.start,
                        communicator_.rank());
    StoringSink sink(store, run.plan);
    render::RenderControl control;
    control.threads = threads_;
    control.cancel = limit.token();
    control.progress = &tiles;
    control.source = &tiles;
    render::RenderJob job = session_->parts().job();
    set_contents(run.plan, job);
    const std::unique_ptr<io::KeptTiles> earlier = open_kept(run.folder, run.plan, &log);
    job.earlier = earlier.get();
    try {
      render::render_image(job, control, sink);
    } catch (const Cancelled&) {
      if (!limit.reached()) throw;
    }
    store.close();
    return store.packs();
  }

  cluster::Communicator& communicator_;
  const WorkerOptions& options_;
  int threads_;
  std::optional<Session> session_;
  io::RunPlan plan_;
  cluster::Payload payload_;
};

}  // namespace

void run_worker(cluster::Communicator& communicator, const WorkerOptions& options) {
  {
    Worker worker(communicator, options);
    if (worker.load()) worker.render();
  }
  communicator.wait_for_end();
}

}  // namespace ifov::session
