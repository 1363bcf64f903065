#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/call_scope.h"
#include "core/run_apart.h"
#include "core/thread_pool.h"

#ifdef __SANITIZE_THREAD__
#include <atomic>
#endif

namespace ifov {
namespace {

/// That what comes before a loop is seen by its pieces, and what those do by what comes after it. The library
/// sees to that by means that the thread sanitizer cannot see; it is told here, and learns nothing of pieces
/// among each other.
class LoopOrder {
#ifdef __SANITIZE_THREAD__
 public:
  LoopOrder() { begun_.store(true, std::memory_order_release); }
  ~LoopOrder() { ended_.load(std::memory_order_acquire); }
  struct Piece {
    explicit Piece(LoopOrder& loop) : order(loop) { order.begun_.load(std::memory_order_acquire); }
    ~Piece() { order.ended_.fetch_add(1, std::memory_order_release); }
    LoopOrder& order;
  };

 private:
  std::atomic<bool> begun_{false};
  std::atomic<std::int64_t> ended_{0};
#else
 public:
  struct Piece {
    explicit Piece(LoopOrder&) {}
  };
#endif
};

/// The library lets no more threads work than cores unless it is told, once and for all, and of several such limits the
/// smallest holds for the whole process. So it is told the most that anybody asks for; how many work for a loop is the loop's
/// own arena's to say.
void allow_many_threads() {
  constexpr std::size_t kMostThreads = 4096;
  static const auto* const kept =
      new tbb::global_control(tbb::global_control::max_allowed_parallelism, kMostThreads);
  static_cast<void>(kept);  // threads may still be at work when the program ends
}

}  // namespace

int usual_threads() { return tbb::info::default_concurrency(); }

void parallel_for(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body) {
  allow_many_threads();
  const PoolUse use;
  tbb::task_arena arena(threads > 0 ? threads : usual_threads());
  const Call& call = current_call();
  LoopOrder order;
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, count, 1),
        [&](const auto& range) {
          [[maybe_unused]] const LoopOrder::Piece piece(order);
          const CallScope scope(call);
          for (std::int64_t i = range.begin(); i < range.end(); ++i) {
            stop_if_cancelled();
            body(i);
          }
        },
        tbb::simple_partitioner());
  });
}

void run_apart(const std::function<void()>& body) {
  tbb::task_group_context apart(tbb::task_group_context::isolated);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        0, 1, [&](int) { body(); }, tbb::simple_partitioner(), apart);
  });
}

}  // namespace ifov
