#include "core/call_scope.h"

#include "core/error.h"

namespace ifov {
namespace {

const Call kNoCall{};
thread_local const Call* current = &kNoCall;

}  // namespace

const Call& current_call() { return *current; }

CallScope::CallScope(const Call& call) : before_(current) { current = &call; }

CallScope::~CallScope() { current = before_; }

void stop_if_cancelled() {
  if (current->cancel != nullptr && current->cancel->cancelled()) throw Cancelled();
}

}  // namespace ifov
