#include "truth/time.h"

namespace ifov::truth {
namespace {

void collect_times(const MiddleRays& rays, std::span<double> values) {
  for (std::size_t k = 0; k < rays.rays.size(); ++k) values[k] = rays.rays[k].time_s;
}

}  // namespace

constinit const Collector kTime{"time", 1, collect_times};

}  // namespace ifov::truth
