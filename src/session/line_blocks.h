#pragma once

#include <functional>

namespace ifov {
class CancelToken;
}

namespace ifov::session {

/// Calls block(first, end) for a cube's lines, some at a time, on at most `threads` threads (0: all cores). Cancelled between blocks.
void for_line_blocks(int lines, int threads, const CancelToken* cancel,
                     const std::function<void(int first, int end)>& block);

}  // namespace ifov::session
