#include "simulation.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <queue>

#include "cluster/tile_schedule.h"

namespace ifov::bench {
namespace {

double of_shares(const TileCosts& tiles, int ranks) {
  std::vector<double> sums(static_cast<std::size_t>(ranks));
  for (std::size_t k = 0; k < tiles.seconds.size(); ++k) sums[k % sums.size()] += tiles.seconds[k];
  return *std::max_element(sums.begin(), sums.end());
}

/// Replays what the ranks say to each other. The first one renders too, and takes its tiles without a message.
class Replay {
 public:
  Replay(const TileCosts& tiles, int ranks, const MessageTimes& messages, bool one_at_a_time)
      : tiles_(tiles),
        messages_(messages),
        one_at_a_time_(one_at_a_time),
        schedule_(all(tiles), tiles.columns, ranks),
        ranks_(static_cast<std::size_t>(ranks)) {}

  double run() {
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank) events_.push({0.0, Kind::idle, rank});
    double end_s = 0.0;
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      switch (event.kind) {
        case Kind::idle:
          end_s = std::max(end_s, event.time_s);
          become_idle(event);
          break;
        case Kind::ask: answer(event); break;
        case Kind::tiles: receive(event); break;
      }
    }
    return end_s;
  }

 private:
  enum class Kind { idle, ask, tiles };
  struct Event {
    double time_s = 0.0;
    Kind kind{};
    std::size_t rank = 0;
    bool operator<(const Event& other) const { return time_s > other.time_s; }
  };
  struct Rank {
    std::deque<int> queue;
    std::vector<int> on_the_way;
    std::vector<cluster::TileCost> finished, told;
    std::size_t low_water = 0;
    int current = -1, asked_idle = 0;
    bool asked = false, only_when_idle = false, no_more = false, idle = false;
  };

  static std::vector<int> all(const TileCosts& tiles) {
    std::vector<int> list(tiles.seconds.size());
    std::iota(list.begin(), list.end(), 0);
    return list;
  }
  double cost_s(int tile) const { return tiles_.seconds[static_cast<std::size_t>(tile)]; }

  std::vector<int> take(int idle) {
    if (!one_at_a_time_) return schedule_.take(idle, 1);
    if (next_row_ == static_cast<int>(tiles_.seconds.size())) return {};
    return {next_row_++};
  }
  std::optional<int> take_one() {
    if (!one_at_a_time_) return schedule_.take_one();
    return none_left() ? std::nullopt : std::optional(next_row_++);
  }
  bool none_left() const {
    return one_at_a_time_ ? next_row_ == static_cast<int>(tiles_.seconds.size()) : schedule_.left() == 0;
  }

  void become_idle(const Event& event) {
    Rank& rank = ranks_[event.rank];
    if (rank.current >= 0) rank.finished.push_back({rank.current, cost_s(rank.current)});
    rank.current = -1;
    rank.idle = true;
    if (event.rank == 0) {
      for (const cluster::TileCost& cost : rank.finished) schedule_.finished(cost);
      rank.finished.clear();
      if (const std::optional<int> tile = take_one()) rank.queue.push_back(*tile);
    }
    go_on(event);
  }

  void go_on(const Event& event) {
    Rank& rank = ranks_[event.rank];
    if (rank.idle && !rank.queue.empty()) {
      rank.idle = false;
      rank.current = rank.queue.front();
      rank.queue.pop_front();
      events_.push({event.time_s + cost_s(rank.current), Kind::idle, event.rank});
    }
    const bool wants = one_at_a_time_
                           ? rank.idle
                           : rank.queue.size() <= rank.low_water && (rank.idle || !rank.only_when_idle);
    if (event.rank == 0 || rank.asked || rank.no_more || !wants) return;
    rank.asked = true;
    rank.asked_idle = rank.idle ? 1 : 0;
    rank.told.swap(rank.finished);
    rank.finished.clear();
    events_.push({event.time_s + 0.5 * messages_.round_trip_s, Kind::ask, event.rank});
  }

  void answer(const Event& event) {
    Rank& rank = ranks_[event.rank];
    served_s_ = std::max(served_s_, event.time_s) + messages_.service_s;
    for (const cluster::TileCost& cost : rank.told) schedule_.finished(cost);
    rank.no_more = none_left();
    rank.on_the_way = take(rank.asked_idle);
    events_.push({served_s_ + 0.5 * messages_.round_trip_s, Kind::tiles, event.rank});
  }

  void receive(const Event& event) {
    Rank& rank = ranks_[event.rank];
    rank.queue.insert(rank.queue.end(), rank.on_the_way.begin(), rank.on_the_way.end());
    rank.low_water = rank.on_the_way.size() / 2;
    rank.only_when_idle = rank.on_the_way.empty();
    rank.asked = false;
    go_on(event);
  }

  const TileCosts& tiles_;
  MessageTimes messages_;
  bool one_at_a_time_;
  cluster::TileSchedule schedule_;
  std::vector<Rank> ranks_;
  std::priority_queue<Event> events_;
  int next_row_ = 0;
  double served_s_ = 0.0;
};

}  // namespace

double makespan_s(const TileCosts& tiles, int ranks, const MessageTimes& messages, Scheduling scheduling) {
  if (scheduling == Scheduling::shares) return of_shares(tiles, ranks);
  return Replay(tiles, ranks, messages, scheduling == Scheduling::rows).run();
}

}  // namespace ifov::bench
