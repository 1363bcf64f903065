#pragma once

#include <filesystem>
#include <optional>

#include "cluster/fault.h"
#include "cluster/payload.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_store.h"

namespace ifov::session {

/// What the first rank of a run tells the others, once it has the run's folder.
struct SharedRun {
  io::RunPlan plan;
  std::filesystem::path folder;
  io::StoreStart start;
  std::optional<double> seconds_left;  ///< until tracing has to end
};

cluster::Payload payload_of(const SharedRun& run);
SharedRun shared_run_in(cluster::Payload& payload);

/// What a rank says when it has read the scene.
struct Loaded {
  cluster::Fault fault;
  int threads = 0;
};

cluster::Payload payload_of(const Loaded& loaded);
Loaded loaded_in(cluster::Payload& payload);

}  // namespace ifov::session
