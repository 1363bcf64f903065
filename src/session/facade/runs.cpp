#include "ifov/runs.h"

#include <optional>

#include "cluster/communicator.h"
#include "session/facade/access.h"
#include "session/facade/run_outcome.h"
#include "session/runs/coordinator.h"
#include "session/runs/merge.h"
#include "session/runs/worker.h"
#include "session/series/series_status.h"

namespace ifov {

RunStatus run_status(const std::filesystem::path& folder) { return session::status_of_any(folder); }

Outcome merge(const std::vector<std::filesystem::path>& folders, const MergeOptions& options) {
  session::RunResult result = session::merge_runs(folders, options);
  const std::size_t left = result.tiles_left;
  result.tiles_left = 0;  // gaps were asked for
  Outcome outcome = session::outcome_of(std::move(result), {});
  outcome.tiles_left = left;
  return outcome;
}

struct Ranks::Inside {
  std::unique_ptr<cluster::Communicator> communicator;
  std::optional<session::Coordinator> coordinator;  ///< of the rank that leads
};

session::Coordinator* FacadeAccess::coordinator(const Ranks* ranks) {
  return ranks != nullptr && ranks->inside_->coordinator ? &*ranks->inside_->coordinator : nullptr;
}

Ranks::Ranks(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Ranks::~Ranks() = default;

std::unique_ptr<Ranks> Ranks::join() {
  std::unique_ptr<cluster::Communicator> communicator = cluster::Communicator::join();
  if (!communicator) return nullptr;
  auto inside = std::make_unique<Inside>();
  if (communicator->leads()) inside->coordinator.emplace(*communicator);
  inside->communicator = std::move(communicator);
  return std::unique_ptr<Ranks>(new Ranks(std::move(inside)));
}

bool Ranks::leads() const { return inside_->communicator->leads(); }

void Ranks::work(const std::filesystem::path& file, const Work& work) const {
  session::WorkerOptions options{.document = file.string(),
                                 .overrides = {},
                                 .threads = work.threads,
                                 .scene_cache = work.scene_cache,
                                 .cancel = work.cancel};
  for (const std::string& written : work.set) options.overrides.push_back(io::read_override(written));
  session::run_worker(*inside_->communicator, options);
}

std::string mpi_library() { return cluster::mpi_library(); }

}  // namespace ifov
