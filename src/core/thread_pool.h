#pragma once

namespace ifov {

/// Held by all that works with the process's pool of threads. A fork takes one thread along and no others: before one the pool's
/// threads are ended where nothing is at work, and parent and child each make their own again. Where something is, the parent goes
/// on, and the child has no threads to work with.
class PoolUse {
 public:
  /// Throws SystemError in a process that was forked while something was at work.
  PoolUse();
  ~PoolUse();
  PoolUse(const PoolUse&) = delete;
  PoolUse& operator=(const PoolUse&) = delete;
};

}  // namespace ifov
