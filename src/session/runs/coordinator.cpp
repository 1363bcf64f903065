#include "session/runs/coordinator.h"

#include "cluster/communicator.h"
#include "cluster/tile_server.h"
#include "io/document/document.h"
#include "session/runs/rank_messages.h"

namespace ifov::session {

using cluster::Tag;

int Coordinator::threads(int wanted) const { return wanted > 0 ? wanted : communicator_.usual_threads(); }

Session Coordinator::load(const io::Document& document, LogSink* log, const LoadOptions& options) {
  std::vector<int> all, first_on_node, rest;
  for (int rank = 1; rank < communicator_.size(); ++rank) {
    all.push_back(rank);
    (communicator_.is_first_on_node(rank) ? first_on_node : rest).push_back(rank);
  }
  LoadOptions own = options;
  own.threads = threads(options.threads);
  all_threads_ = own.threads;
  if (!options.scene_cache) {
    communicator_.send_all(all, Tag::load, {});
    Session session = Session::load(document, log, own);
    wait_for_loaded(all.size(), options.cancel);
    return session;
  }
  Session session = Session::load(document, log, own);
  have_loaded(first_on_node, options.cancel);
  have_loaded(rest, options.cancel);
  return session;
}

void Coordinator::have_loaded(const std::vector<int>& ranks, const CancelToken* cancel) {
  communicator_.send_all(ranks, Tag::load, {});
  wait_for_loaded(ranks.size(), cancel);
}

void Coordinator::wait_for_loaded(std::size_t count, const CancelToken* cancel) {
  for (std::size_t k = 0; k < count; ++k) {
    cluster::Message message = communicator_.receive(cancel);
    const Loaded loaded = loaded_in(message.payload);
    if (loaded.fault) raise(loaded.fault, communicator_.name(message.rank));
    all_threads_ += loaded.threads;
  }
}

std::unique_ptr<cluster::TileServer> Coordinator::begin(const SharedRun& run, const std::vector<int>& tiles,
                                                        const CancelToken* cancel) {
  std::vector<int> others;
  for (int rank = 1; rank < communicator_.size(); ++rank) others.push_back(rank);
  communicator_.send_all(others, Tag::begin, payload_of(run));
  const int columns = (run.plan.image.width_px + run.plan.tile_px - 1) / run.plan.tile_px;
  return std::make_unique<cluster::TileServer>(communicator_,
                                               cluster::TileSchedule(tiles, columns, all_threads_), cancel);
}

}  // namespace ifov::session
