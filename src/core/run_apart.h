#pragma once

#include <functional>

namespace ifov {

/// Calls body() within a loop as if it were none of the loop's: the loop's end by an exception does not end what the body
/// does on several threads, and while it waits for these, this thread takes up nothing else of the loop. What the body throws
/// is thrown here. For what outlives the loop.
void run_apart(const std::function<void()>& body);

}  // namespace ifov
