#pragma once

#include <memory>

#include "core/run_control.h"

namespace ifov {

/// What one call of a program has besides its arguments and every thread that works for it has to know: whether it is
/// cancelled, and what it may read (io/files/inputs.h). Functions deep below ask for it instead of each passing it on. Two
/// calls in two threads have nothing of it in common.
struct Call {
  /// What a higher room keeps here.
  class Data {
   public:
    virtual ~Data() = default;
  };
  std::shared_ptr<const Data> inputs;   ///< null: nothing is said
  const CancelToken* cancel = nullptr;  ///< null: nobody cancels
};

/// The call that this thread works for.
const Call& current_call();

/// Makes a call, which must outlive it, that of this thread until it goes. parallel_for() takes it along to its threads.
class CallScope {
 public:
  explicit CallScope(const Call& call);
  ~CallScope();
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;

 private:
  const Call* before_;
};

/// Throws Cancelled where this thread's call is cancelled. Costs little: for loops whose turns take microseconds.
void stop_if_cancelled();

}  // namespace ifov
