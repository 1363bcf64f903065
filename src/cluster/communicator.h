#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cluster/payload.h"
#include "core/run_control.h"

namespace ifov::cluster {

/// What a message is about.
enum class Tag : int {
  load,      ///< from the first rank: read the scene now
  loaded,    ///< to the first rank: it is read, or cannot be
  begin,     ///< from the first rank: what the run is
  ask,       ///< to the first rank: tiles, please; and what has been done
  tiles,     ///< from the first rank: these; none: ask again when a thread is idle
  no_more,   ///< from the first rank: there are none left
  stop,      ///< from the first rank: leave what you are at
  farewell,  ///< to the first rank: all my tiles are on disk, or why they are not
  end,       ///< from the first rank: the run is over
};

struct Message {
  int rank = 0;  ///< that sent it
  Tag tag{};
  Payload payload;
};

/// The ranks of a run under MPI. The first one leads: all messages go to it or come from it. May be used from any
/// thread; no call takes a core while it waits, other than joining and leaving. Errors within MPI end the program,
/// as MPI has it.
class Communicator {
 public:
  /// Null where the program was not started as one of several; MPI is then never touched. Throws SystemError where
  /// it was, and the build has no MPI.
  static std::unique_ptr<Communicator> join();
  /// The first rank tells the others that the run is over. All leave together.
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return static_cast<int>(names_.size()); }
  bool leads() const { return rank_ == 0; }
  /// "rank 3 on node7"
  const std::string& name(int rank) const { return names_[static_cast<std::size_t>(rank)]; }
  /// The first one on its machine.
  bool is_first_on_node(int rank) const { return first_on_node_[static_cast<std::size_t>(rank)]; }
  /// The cores that this rank may use, shared with the ranks that may use the same.
  int usual_threads() const { return usual_threads_; }

  void send(int to, Tag tag, const Payload& payload);
  /// To several at once; returns when all have it on its way.
  void send_all(const std::vector<int>& to, Tag tag, const Payload& payload);
  /// A message, if one has come.
  std::optional<Message> poll();
  /// The next message. Throws Cancelled; `cancel` may be null.
  Message receive(const CancelToken* cancel);
  /// On the others: until the first one says that the run is over.
  void wait_for_end();

 private:
  Communicator();
  struct Mpi;
  std::unique_ptr<Mpi> mpi_;
  int rank_ = 0, usual_threads_ = 1;
  std::vector<std::string> names_;
  std::vector<bool> first_on_node_;
  std::atomic<bool> ended_{false};
};

/// "Open MPI 4.1.4"; empty in a build without.
std::string mpi_library();

}  // namespace ifov::cluster
