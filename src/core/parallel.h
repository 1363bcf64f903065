#pragma once

#include <cstdint>
#include <functional>

namespace ifov {

/// Calls body(index) for every index in [0, count), each once, on at most `threads` threads (0: all cores).
/// The first exception stops the rest and is rethrown here. No order is promised: results must not depend on it.
void parallel_for(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body);

/// Calls body() within a loop as if it were none of the loop's: the loop's end by an exception does not end what the body
/// does on several threads, and while it waits for these, this thread takes up nothing else of the loop. What the body throws
/// is thrown here. For what outlives the loop.
void run_apart(const std::function<void()>& body);

/// How many threads 0 stands for: the cores that this process may use.
int usual_threads();

}  // namespace ifov
