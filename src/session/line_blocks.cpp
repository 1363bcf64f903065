#include "session/line_blocks.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "core/run_control.h"

namespace ifov::session {

void for_line_blocks(int lines, int threads, const CancelToken* cancel,
                     const std::function<void(int first, int end)>& block) {
  constexpr int kLines = 16;
  parallel_for((lines + kLines - 1) / kLines, threads, [&](std::int64_t part) {
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
    const int first = static_cast<int>(part) * kLines;
    block(first, std::min(lines, first + kLines));
  });
}

}  // namespace ifov::session
