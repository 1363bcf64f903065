#include "session/runs/team.h"

#include "io/document/document.h"

namespace ifov::session {

using cluster::Parcel;
using cluster::Tag;

Parcel parcel_of(const TeamRun& run) {
  Parcel parcel;
  parcel.put(io::to_json(run.plan));
  parcel.put(run.folder.string());
  parcel.put(run.start);
  parcel.put(run.seconds_left.has_value());
  parcel.put(run.seconds_left.value_or(0.0));
  return parcel;
}

TeamRun team_run_in(Parcel& parcel) {
  TeamRun run;
  run.plan = io::plan_in(parcel.take<std::string>(), "what the first rank says of the run");
  run.folder = parcel.take<std::string>();
  run.start = parcel.take<io::StoreStart>();
  const bool limited = parcel.take<bool>();
  const auto seconds = parcel.take<double>();
  if (limited) run.seconds_left = seconds;
  return run;
}

Parcel parcel_of(const Loaded& loaded) {
  Parcel parcel;
  put(parcel, loaded.fault);
  parcel.put(loaded.threads);
  return parcel;
}

Loaded loaded_in(Parcel& parcel) {
  Loaded loaded;
  loaded.fault = cluster::take_fault(parcel);
  loaded.threads = parcel.take<int>();
  return loaded;
}

Session Team::load(const io::Document& document, LogSink* log, const LoadOptions& options) {
  std::vector<int> all, first_on_node, rest;
  for (int rank = 1; rank < world_.size(); ++rank) {
    all.push_back(rank);
    (world_.is_first_on_node(rank) ? first_on_node : rest).push_back(rank);
  }
  LoadOptions own = options;
  own.threads = threads(options.threads);
  all_threads_ = own.threads;
  if (!options.scene_cache) {
    world_.send_all(all, Tag::load, {});
    Session session = Session::load(document, log, own);
    wait_for_loaded(all.size(), options.cancel);
    return session;
  }
  Session session = Session::load(document, log, own);
  have_loaded(first_on_node, options.cancel);
  have_loaded(rest, options.cancel);
  return session;
}

void Team::have_loaded(const std::vector<int>& ranks, const CancelToken* cancel) {
  world_.send_all(ranks, Tag::load, {});
  wait_for_loaded(ranks.size(), cancel);
}

void Team::wait_for_loaded(std::size_t count, const CancelToken* cancel) {
  for (std::size_t k = 0; k < count; ++k) {
    cluster::Message message = world_.receive(cancel);
    const Loaded loaded = loaded_in(message.parcel);
    if (loaded.fault) raise(loaded.fault, world_.name(message.rank));
    all_threads_ += loaded.threads;
  }
}

std::unique_ptr<cluster::TileServer> Team::begin(const TeamRun& run, const std::vector<int>& tiles,
                                                 const CancelToken* cancel) {
  std::vector<int> others;
  for (int rank = 1; rank < world_.size(); ++rank) others.push_back(rank);
  world_.send_all(others, Tag::begin, parcel_of(run));
  const int columns = (run.plan.image.width_px + run.plan.tile_px - 1) / run.plan.tile_px;
  return std::make_unique<cluster::TileServer>(world_, cluster::TileSchedule(tiles, columns, all_threads_), cancel);
}

}  // namespace ifov::session
