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

/// Decides which tiles are rendered next, and by how many at a time they are handed out. First come tiles that are
/// spread over the image, one in 16; then, by what those and all later ones took, the dearest of the rest, where the
/// cost of a tile is guessed from the finished ones around it. So the image ends with cheap tiles, and nobody waits for
/// long (longest processing time first: Graham 1969, "Bounds on multiprocessing timing anomalies"). Serves one thread
/// at a time; what comes out of a tile does not depend on any of this.
class TileSchedule {
 public:
  /// `tiles`: positions in a grid of `columns`; `threads`: of all that will ask.
  TileSchedule(const std::vector<int>& tiles, int columns, int threads);

  void finished(const TileCost& cost);

  /// For one who has `threads` threads, `idle` of which are waiting: as many as will keep them busy for a tenth of a
  /// second, at least one for each idle thread, and fewer towards the end. Where no thread waits and few tiles are
  /// left: none, so that a tile goes to who can begin it.
  std::vector<int> take(int idle, int threads);

  /// For a thread that needs no message to ask.
  std::optional<int> take_one();

  std::size_t left() const { return order_.size() - next_; }

 private:
  struct Place {
    int tile = -1, x = 0, y = 0;
    double guess_s = 0.0;
  };
  double guess_s(const Place& place) const;
  void sort_rest();

  int columns_, threads_;
  std::vector<Place> order_;
  std::size_t next_ = 0, first_ones_ = 0;
  int rows_ = 0;
  std::vector<float> took_s_;  ///< by place in the grid; below 0: not known
  std::size_t known_ = 0, sort_at_ = 0;
  double sum_s_ = 0.0;
};

}  // namespace ifov::cluster
