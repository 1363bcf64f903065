#include "core/thread_pool.h"

#include <pthread.h>
#include <tbb/global_control.h>

#include <mutex>
#include <new>

#include "core/error.h"

namespace ifov {
namespace {

struct Pool {
  Pool();
  std::mutex mutex;  ///< held while the process forks
  int uses = 0;
  tbb::task_scheduler_handle threads;  ///< null: none have been made
  bool is_without_threads = false;     ///< for good: they stayed behind in the parent
  bool are_left_behind = false;        ///< by the fork under way
};

/// Never destroyed: threads may still be at work when the program ends.
Pool& pool() {
  static auto* const kept = new Pool;
  return *kept;
}

void end_threads() {
  Pool& own = pool();
  own.mutex.lock();
  // Ending them fails where threads of the program have used them, too, and are still there.
  own.are_left_behind = own.uses > 0 || (own.threads && !tbb::finalize(own.threads, std::nothrow));
}

void go_on() { pool().mutex.unlock(); }

void begin_child() {
  Pool& own = pool();
  own.is_without_threads |= own.are_left_behind;
  own.mutex.unlock();
}

Pool::Pool() { pthread_atfork(end_threads, go_on, begin_child); }

}  // namespace

PoolUse::PoolUse() {
  Pool& own = pool();
  const std::lock_guard lock(own.mutex);
  if (own.is_without_threads)
    throw SystemError(
        "this process was forked from one in which ifov was at work, and has none of its threads; fork before or after "
        "that, or start a process of its own");
  if (!own.threads) own.threads = tbb::task_scheduler_handle{tbb::attach{}};
  ++own.uses;
}

PoolUse::~PoolUse() {
  const std::lock_guard lock(pool().mutex);
  --pool().uses;
}

}  // namespace ifov
