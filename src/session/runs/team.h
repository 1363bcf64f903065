#pragma once

#include <functional>
#include <map>
#include <optional>

#include "cluster/tile_server.h"
#include "cluster/world.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_store.h"
#include "session/session.h"

namespace ifov::session {

/// What the first rank of a run tells the others, once it has the run's folder.
struct TeamRun {
  io::RunPlan plan;
  std::filesystem::path folder;
  io::StoreStart start;
  std::optional<double> seconds_left;  ///< until tracing has to end
};

cluster::Parcel parcel_of(const TeamRun& run);
TeamRun team_run_in(cluster::Parcel& parcel);

/// What a rank says when it has read the scene.
struct Loaded {
  cluster::Fault fault;
  int threads = 0;
};

cluster::Parcel parcel_of(const Loaded& loaded);
Loaded loaded_in(cluster::Parcel& parcel);

/// The other ranks of a run, as the first one sees them; help_run() is what they do.
class Team {
 public:
  explicit Team(cluster::World& world) : world_(world) {}

  /// Loads here and on all ranks. With a scene cache each machine reads the scene's files once: first this rank, then
  /// the first one on each other machine, then all others find what they need in the cache. Throws what keeps any rank
  /// from it, which is named.
  Session load(const io::Document& document, LogSink* log, const LoadOptions& options);

  /// How many threads this rank has, where the user wants `threads` (0: as many as are usual).
  int threads(int wanted) const { return wanted > 0 ? wanted : world_.usual_threads(); }
  int all_threads() const { return all_threads_; }

  /// From here on the others render tiles, and ask for more.
  std::unique_ptr<cluster::TileServer> begin(const TeamRun& run, const std::vector<int>& tiles,
                                             const CancelToken* cancel);

 private:
  void have_loaded(const std::vector<int>& ranks, const CancelToken* cancel);
  void wait_for_loaded(std::size_t count, const CancelToken* cancel);

  cluster::World& world_;
  int all_threads_ = 0;
};

}  // namespace ifov::session
