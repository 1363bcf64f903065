#pragma once

#include <cstdint>
#include <functional>

namespace ifov {

/// Calls body(index) for every index in [0, count), each once, on at most `threads` threads (0: all cores).
/// The first exception stops the rest and is rethrown here. No order is promised: results must not depend on it.
void parallel_for(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body);

/// How many threads 0 stands for: the cores that this process may use.
int usual_threads();

}  // namespace ifov
