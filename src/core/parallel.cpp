#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ifov {

int usual_threads() { return tbb::info::default_concurrency(); }

void parallel_for(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body) {
  // More threads than cores are allowed (and tested); the library would print a warning without this.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads > 0 ? threads : usual_threads()));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, 1), [&](const auto& range) {
      for (std::int64_t i = range.begin(); i < range.end(); ++i) body(i);
    }, tbb::simple_partitioner());
  });
}

}  // namespace ifov
