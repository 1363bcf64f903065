#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "session/session.h"

namespace ifov::cluster {
class Communicator;
class TileServer;
}  // namespace ifov::cluster

namespace ifov::session {

struct SharedRun;

/// The other ranks of a run, as the first one sees them; run_worker() is what they do.
class Coordinator {
 public:
  explicit Coordinator(cluster::Communicator& communicator) : communicator_(communicator) {}

  /// Loads here and on all ranks. With a scene cache each machine reads the scene's files once: first this rank, then
  /// the first one on each other machine, then all others find what they need in the cache. Throws what keeps any rank
  /// from it, which is named.
  Session load(const io::Document& document, LogSink* log, const LoadOptions& options);

  /// How many threads this rank has, where the user wants `threads` (0: as many as are usual).
  int threads(int wanted) const;
  int all_threads() const { return all_threads_; }

  /// From here on the others render tiles, and ask for more.
  std::unique_ptr<cluster::TileServer> begin(const SharedRun& run, const std::vector<int>& tiles,
                                             const CancelToken* cancel);

 private:
  void have_loaded(const std::vector<int>& ranks, const CancelToken* cancel);
  void wait_for_loaded(std::size_t count, const CancelToken* cancel);

  cluster::Communicator& communicator_;
  int all_threads_ = 0;
};

}  // namespace ifov::session
