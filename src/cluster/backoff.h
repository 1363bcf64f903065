#pragma once

#include <algorithm>
#include <chrono>

namespace ifov::cluster {

/// How long to sleep between two polls for messages. Each poll takes some 20 us from a core on which tiles are rendered, so
/// they must be few; and what has been asked must not wait for long. So pauses are short after a message and double from
/// there: while messages keep coming, one waits for less than the time since the last.
class Backoff {
 public:
  using Length = std::chrono::microseconds;
  static constexpr Length kShortest{50};

  void restart() { next_ = kShortest; }
  Length next(Length longest) {
    const Length length = std::min(next_, longest);
    next_ = 2 * length;
    return length;
  }

 private:
  Length next_ = kShortest;
};

}  // namespace ifov::cluster
