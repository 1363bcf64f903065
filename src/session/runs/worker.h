#pragma once

#include <string>
#include <vector>

#include "cluster/communicator.h"
#include "io/json/document_override.h"

namespace ifov::session {

struct WorkerOptions {
  std::string document;
  std::vector<io::DocumentOverride> overrides;
  int threads = 0;  ///< 0: as many as are usual for a rank
  bool scene_cache = true;
  const CancelToken* cancel = nullptr;
};

/// What a rank does that is not the first: reads the scene when it is told to, renders tiles into the run's folder, and
/// returns when the first one says that the run is over. Says nothing; what goes wrong the first rank is told, and
/// throws it.
void run_worker(cluster::Communicator& communicator, const WorkerOptions& options);

}  // namespace ifov::session
