#include "cluster/launch.h"

#include <cstdlib>
#include <initializer_list>

namespace ifov::cluster {
namespace {

/// The number in an environment variable; 0 where there is none.
int count_in(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : 0;
}

}  // namespace

bool is_one_of_several() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const int ranks = count_in(name); ranks > 0) return ranks > 1;
  return std::getenv("PMIX_RANK") != nullptr && count_in("SLURM_STEP_NUM_TASKS") != 1;
}

}  // namespace ifov::cluster
