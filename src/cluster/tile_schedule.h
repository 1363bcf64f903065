#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace ifov::cluster {

/// What a tile took.
struct TileCost {
  int tile = 0;
  double seconds = 0.0;
};

/// Decides which tiles are rendered next, and by how many at a time they are handed out. First come scouts, one in 16,
/// spread over the image; then, by what those and all later tiles took, the most expensive of the rest: a tile is taken to
/// cost as much as the most expensive finished one around it, and more than all while a scout near it is at work. So the image
/// ends with cheap tiles, and nobody waits for long (longest processing time first: Graham 1969, "Bounds on
/// multiprocessing timing anomalies"). Serves one thread at a time; what comes out of a tile does not depend on any of
/// this.
class TileSchedule {
 public:
  /// `tiles`: positions in a grid of `columns`; `threads`: of all that will ask.
  TileSchedule(const std::vector<int>& tiles, int columns, int threads);

  void finished(const TileCost& cost);

  /// For one who has `threads` threads, `idle` of which are waiting: as many as will keep them busy for a tenth of a
  /// second, at least one for each idle thread, and fewer towards the end. Where no thread waits and the next tile takes
  /// long, or few are left: none, so that a tile goes to who can begin it.
  std::vector<int> take(int idle, int threads);

  /// For a thread that needs no message to ask.
  std::optional<int> take_one();

  std::size_t left() const { return order_.size() - next_; }

 private:
  struct Entry {
    int tile = -1, x = 0, y = 0;
    float guess_s = 0.0f;  ///< 0: none
  };
  struct Cell {
    float took_s = -1.0f;     ///< below 0: not known
    bool is_awaited = false;  ///< a scout that is not done
  };
  float guess_s(const Entry& entry) const;
  void sort_rest();

  int columns_, rows_ = 0;
  std::size_t threads_;
  std::vector<Entry> order_;  ///< up to next_ they are handed out; scouts come first
  std::size_t next_ = 0, scouts_ = 0;
  std::vector<Cell> cells_;  ///< by place in the grid
  std::size_t known_ = 0, sort_at_ = 0;
  float longest_s_ = 0.0f;
};

}  // namespace ifov::cluster
