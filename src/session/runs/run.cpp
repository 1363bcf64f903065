#include "session/runs/run.h"

#include <mutex>
#include <new>
#include <optional>

#include "cluster/tile_server.h"
#include "core/error.h"
#include "core/machine_memory.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_state.h"
#include "render/image_renderer.h"
#include "render/series/image_of_time.h"
#include "session/loaded/parts.h"
#include "session/messages.h"
#include "session/runs/coordinator.h"
#include "session/runs/plan_assembly.h"
#include "session/runs/rank_messages.h"
#include "session/runs/refinement.h"
#include "session/runs/resource_check.h"
#include "session/runs/run_keeping.h"
#include "session/runs/run_products.h"
#include "session/runs/runs_together.h"
#include "session/runs/stop_request.h"
#include "session/runs/tile_assembly.h"
#include "session/runs/time_limit.h"
#include "session/session.h"

namespace ifov::session {
namespace {

/// What assembly takes is set aside of a time limit: this, and the products' bytes at these rates.
constexpr double kAssembly_s = 1.0, kCached_bytes_per_s = 60e6, kDirect_bytes_per_s = 150e6;
constexpr const char* kTimeLimit = "the time limit came first";

/// One start of a run.
class Run {
 public:
  Run(const Session& session, const RunRequest& request)
      : parts_(session.parts()),
        options_(request.options),
        deadline_(request.deadline),
        folder_(request.folder(session)),
        coordinator_(request.coordinator),
        goes_on_(request.start == RunStart::resume),
        plan_(assemble_plan(parts_)) {
    plan_.share = request.share;
    if (request.keep_finished) require_refinable(parts_);
    plan_.keeps_memory = request.keep_finished;
    if (request.refine) plan_refinement(folder_, parts_, plan_);
    if (request.start == RunStart::resume) resume_refinement(folder_, plan_);
    if (!request.anyway) require_room(request);
    if (!request.keep_tiles) return;
    state_.emplace(folder_, plan_, request.start, options_.log);
    plan_ = state_->plan();
  }

  /// Where the surroundings fail, the message says that nothing is lost.
  template <class Action>
  auto keeping(Action&& action) const {
    try {
      return action();
    } catch (const SystemError& error) {
      throw SystemError(kept(error.what()));
    } catch (const std::bad_alloc&) {
      throw SystemError(kept(memory_ran_out()));
    }
  }

  RunResult go() {
    return keeping([&] {
      take_finished();
      trace();
      return close();
    });
  }

  // The same of one time among several, whose tiles come from render_times().
  void begin() {
    take_finished();
    job_.emplace(parts_.job());
    set_contents(plan_, *job_);
    progress_.emplace(totals_, options_.progress, nullptr);
    sink_.emplace(plan_, &*assembly_, state_ ? &*state_ : nullptr, tiles_);
  }
  render::ImageOfTime image() {
    render::ImageOfTime image{*job_, &*sink_, &*progress_, std::vector<bool>(tiles_.done.size())};
    for (const int tile : tiles_left()) image.wanted[static_cast<std::size_t>(tile)] = true;
    return image;
  }
  /// Where tiles may be asked to end early, and when they must.
  std::filesystem::path stop_file() const {
    return state_ ? io::stop_file(folder_) : std::filesystem::path();
  }
  TimeLimit::Clock::duration time_for_products() const {
    const io::ProductBytes bytes = io::product_bytes(plan_);
    return std::chrono::duration_cast<TimeLimit::Clock::duration>(
        std::chrono::duration<double>(kAssembly_s + static_cast<double>(bytes.cached) / kCached_bytes_per_s +
                                      static_cast<double>(bytes.direct) / kDirect_bytes_per_s));
  }
  RunResult end(double elapsed_s) {
    const double before_s = totals_.elapsed_s;
    totals_ = progress_->last();
    totals_.elapsed_s = before_s + elapsed_s;
    return close();
  }

 private:
  std::string kept(const std::string& what) const {
    if (!state_ || (tiles_.count() == 0 && coordinator_ == nullptr)) return what;
    return format("{}\nFinished tiles are kept in {}: put this right and go on with --resume.", what,
                  state_->path().string());
  }

  RunResult close() {
    const int packs = state_ ? state_->close() : 0;
    if (coordinator_ != nullptr) state_->find(0, packs);
    return finish();
  }

  void take_finished() {
    const std::vector<sampling::PixelRect> grid = plan_.grid();
    tiles_.done.resize(grid.size());
    for (std::size_t k = 0; k < grid.size(); ++k)
      if (plan_.share.has(k)) totals_.pixels_total += grid[k].count();
    if (plan_.share.is_whole()) products_.emplace(plan_, folder_, goes_on_);
    if (state_ && products_) {
      io::RunState::Cubes cubes;
      cubes.read_values = [this](sampling::TileResult& tile, const auto& is_right) {
        return products_->read_values(tile, is_right);
      };
      // What other ranks trace comes into the cubes at the end.
      if (coordinator_ == nullptr) cubes.lines_written = [this] { return products_->lines_written(); };
      state_->use(std::move(cubes));
    }
    if (state_) count_finished();
    assembly_.emplace(
        plan_, tiles_.done,
        [this](std::size_t index, sampling::TileResult& tile) { return state_->read_tile(index, tile); },
        products_ ? &*products_ : nullptr);
  }

  void count_finished() {
    tiles_ = state_->read([](const sampling::TileResult&) {});
    if (tiles_.count() > 0 && options_.log != nullptr)
      options_.log->info(format("{}: {} of {} tiles are done already", folder_.string(), tiles_.count(),
                                tiles_.done.size()));
    totals_.pixels_done = tiles_.pixels;
    totals_.pixels_converged = tiles_.converged;
    totals_.rays = tiles_.rays;
    totals_.worst_error_ratio = tiles_.worst_ratio;
    totals_.elapsed_s = tiles_.elapsed_s;
  }

  std::vector<int> tiles_left() const {
    std::vector<int> left;
    for (std::size_t k = 0; k < tiles_.done.size(); ++k)
      if (!tiles_.done[k] && plan_.share.has(k)) left.push_back(static_cast<int>(k));
    return left;
  }

  /// What is known before the first ray.
  void require_room(const RunRequest& request) const {
    const int threads = coordinator_ != nullptr ? coordinator_->threads(options_.threads) : options_.threads;
    const std::uint64_t disk = (plan_.share.is_whole() ? io::product_bytes(plan_).all() : 0) +
                               (request.keep_tiles ? io::state_bytes(plan_, coordinator_ == nullptr) : 0);
    const std::vector<std::string> lines = shortages(folder_, disk, least_memory_bytes(plan_, threads));
    if (lines.empty()) return;
    std::string message;
    for (const std::string& line : lines) message += line + "\n";
    throw SystemError(message + "Nothing was begun. --anyway begins all the same; --dry-run says more.");
  }

  void trace() {
    const std::vector<int> left = tiles_left();
    if (left.empty()) return;
    if (options_.progress != nullptr) options_.progress->phase("");
    std::optional<TimeLimit::Clock::time_point> end = deadline_;
    if (end && products_) *end -= time_for_products();
    const StopRequest stop(stop_file(), options_.cancel);
    const std::unique_ptr<cluster::TileServer> server =
        coordinator_ != nullptr ? begin_workers(left, end, stop.token()) : nullptr;
    const TimeLimit limit(end, server ? server->token() : stop.token());
    LastProgress progress(totals_, options_.progress, server.get());
    // What other ranks trace comes out of their packs at the end, and then all comes line by line.
    KeepingSink sink(plan_, server ? nullptr : &*assembly_, state_ ? &*state_ : nullptr, tiles_);
    render::RenderControl control;
    control.threads = coordinator_ != nullptr ? coordinator_->threads(options_.threads) : options_.threads;
    control.cancel = limit.token();
    control.progress = &progress;
    control.tile_order = left;
    control.source = server ? static_cast<render::TileSource*>(server.get()) : &*assembly_;
    bool stopped = false;
    render::RenderJob job = parts_.job();
    set_contents(plan_, job);
    const std::unique_ptr<io::KeptTiles> earlier = open_kept(folder_, plan_, options_.log);
    job.earlier = earlier.get();
    try {
      render::render_image(job, control, sink);
    } catch (const Cancelled&) {
      stopped = !limit.reached();
      if (stopped && !server) throw;
    }
    std::map<int, cluster::FinalReport> farewells;
    if (server) farewells = server->finish([&] { progress.report_others(); });
    if (stopped) throw Cancelled();
    totals_ = progress.last();
    for (const auto& [rank, farewell] : farewells) {
      if (options_.log != nullptr)
        for (const std::string& word : farewell.warnings) options_.log->warn(word);
      take_from(rank, farewell.packs);
    }
    if (const std::size_t missing = tiles_left().size(); server && missing > 0 && !limit.reached())
      throw SystemError(format("{} tiles of other ranks cannot be read back", missing));
  }

  std::unique_ptr<cluster::TileServer> begin_workers(const std::vector<int>& left,
                                                     const std::optional<TimeLimit::Clock::time_point>& end,
                                                     const CancelToken* stop) {
    SharedRun run{plan_, folder_, state_->store_start(), std::nullopt};
    if (end) run.seconds_left = std::chrono::duration<double>(*end - TimeLimit::Clock::now()).count();
    return coordinator_->begin(run, left, stop);
  }

  /// What another rank has written.
  void take_from(int rank, int packs) {
    const io::TilesDone tiles = state_->find(rank, packs);
    for (std::size_t k = 0; k < tiles.done.size(); ++k) tiles_.done[k] = tiles_.done[k] || tiles.done[k];
    sampling::add_counts(tiles.reasons, tiles_.reasons);
    Progress work;
    work.pixels_done = tiles.pixels;
    work.pixels_converged = tiles.converged;
    work.rays = tiles.rays;
    work.worst_error_ratio = tiles.worst_ratio;
    add_work(totals_, work);
  }

  RunResult finish() {
    const std::size_t left = tiles_left().size();
    RunResult result;
    if (options_.progress != nullptr) options_.progress->phase("products");
    if (products_) {
      if (const std::size_t unread = assembly_->finish(tiles_.done, options_.threads, sampling::Reason::time);
          unread > 0)
        throw SystemError(format("{} tiles cannot be read back", unread));
      result.summary = products_->finish(totals_, tiles_.reasons, options_.threads, kTimeLimit);
    } else {
      result.summary.folder = folder_;
      result.summary.totals = totals_;
      result.summary.accuracy_statement = accuracy_statement(plan_, totals_, tiles_.reasons, kTimeLimit);
    }
    result.tiles_done = tiles_.count();
    result.tiles_left = left;
    if (left == 0 && products_ && state_) {
      if (plan_.keeps_memory)
        state_->keep();
      else
        state_->remove();
    }
    return result;
  }

  const Parts& parts_;
  const RunOptions& options_;
  std::optional<TimeLimit::Clock::time_point> deadline_;
  std::filesystem::path folder_;
  Coordinator* coordinator_;
  bool goes_on_;
  io::RunPlan plan_;
  std::optional<RunProducts> products_;  ///< none for a share of the tiles
  std::optional<io::RunState> state_;    ///< its thread asks the products
  std::optional<TileAssembly> assembly_;
  io::TilesDone tiles_;
  Progress totals_;
  // Of begin().
  std::optional<render::RenderJob> job_;
  std::optional<LastProgress> progress_;
  std::optional<KeepingSink> sink_;
};

}  // namespace

struct OneRun::Inside : Run {
  using Run::Run;
};

OneRun::OneRun(const Session& session, const RunRequest& request)
    : run_(std::make_unique<Inside>(session, request)) {}
OneRun::~OneRun() = default;
void OneRun::keeping(const std::function<void()>& action) const { run_->keeping(action); }
void OneRun::begin() { run_->begin(); }
render::ImageOfTime OneRun::image() { return run_->image(); }
std::filesystem::path OneRun::stop_file() const { return run_->stop_file(); }
std::chrono::steady_clock::duration OneRun::time_for_products() const { return run_->time_for_products(); }
RunResult OneRun::end(double elapsed_s) { return run_->end(elapsed_s); }

RunResult render_run(const Session& session, const RunRequest& request) { return Run(session, request).go(); }

RunSummary Session::render(const RunOptions& options) const {
  RunRequest request;
  request.options = options;
  return render_run(*this, request).summary;
}

}  // namespace ifov::session
