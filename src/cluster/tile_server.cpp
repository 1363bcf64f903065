#include "cluster/tile_server.h"

#include <algorithm>
#include <chrono>

#include "cluster/nap.h"
#include "core/error.h"

namespace ifov::cluster {
namespace {

using Clock = std::chrono::steady_clock;

/// A rank that has nothing to do waits for half of this, once for a tile that takes many times as long.
constexpr std::chrono::milliseconds kLongestNap{5};
/// A launcher that ends a run kills who has not left within a second.
constexpr auto kPatience = std::chrono::milliseconds(500);

double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

TileServer::TileServer(World& world, TileSchedule schedule, const CancelToken* user)
    : world_(world), user_(user), schedule_(std::move(schedule)), thread_([this] { serve(); }) {}

TileServer::~TileServer() {
  std::unique_lock lock(mutex_);
  if (!all_gone()) {
    stop_all();
    wake_.wait_for(lock, kPatience, [&] { return all_gone(); });
  }
  leaving_ = true;
  lock.unlock();
  wake_.notify_all();
  thread_.join();
}

std::optional<int> TileServer::next() {
  const std::lock_guard lock(mutex_);
  const auto was = own_.find(std::this_thread::get_id());
  if (was != own_.end()) {
    schedule_.finished({was->second.tile, now_s() - was->second.seconds});
    own_.erase(was);
  }
  if (stopped_) return std::nullopt;
  const std::optional<int> tile = schedule_.take_one();
  if (tile) own_[std::this_thread::get_id()] = {*tile, now_s()};
  return tile;
}

Progress TileServer::others() const {
  const std::lock_guard lock(mutex_);
  Progress sum;
  for (const auto& [rank, progress] : progress_) {
    sum.pixels_done += progress.pixels_done;
    sum.pixels_converged += progress.pixels_converged;
    sum.rays += progress.rays;
    sum.worst_error_ratio = std::max(sum.worst_error_ratio, progress.worst_error_ratio);
  }
  return sum;
}

std::map<int, Farewell> TileServer::finish(const std::function<void()>& look) {
  std::unique_lock lock(mutex_);
  std::optional<Clock::time_point> end;
  while (!all_gone() && (!end || Clock::now() < *end)) {
    if (user_ != nullptr && user_->cancelled() && !end) end = Clock::now() + kPatience;
    wake_.wait_for(lock, std::chrono::milliseconds(100));
    lock.unlock();
    look();
    lock.lock();
  }
  if (user_ != nullptr && user_->cancelled()) throw Cancelled();
  if (failed_) raise(farewells_[*failed_].fault, world_.name(*failed_));
  return farewells_;
}

void TileServer::serve() {
  Nap nap;
  std::unique_lock lock(mutex_);
  while (!leaving_) {
    lock.unlock();
    bool any = false;
    while (std::optional<Message> message = world_.poll()) {
      answer(std::move(*message));
      any = true;
    }
    lock.lock();
    if (user_ != nullptr && user_->cancelled()) stop_all();
    if (any) nap.restart();
    if (!leaving_) wake_.wait_for(lock, nap.next(kLongestNap), [&] { return leaving_; });
  }
}

void TileServer::answer(Message message) {
  const std::unique_lock lock(mutex_);
  Parcel& parcel = message.parcel;
  if (message.tag == Tag::farewell) {
    Farewell farewell;
    farewell.fault = take_fault(parcel);
    farewell.packs = parcel.take<int>();
    farewell.warnings = parcel.take<std::vector<std::string>>();
    progress_[message.rank] = parcel.take<Progress>();
    farewells_[message.rank] = farewell;
    if (farewell.fault) {
      if (!failed_ && !stopped_) failed_ = message.rank;
      stop_all();
    }
    wake_.notify_all();
    return;
  }
  if (message.tag != Tag::ask) return;
  const int idle = parcel.take<int>(), threads = parcel.take<int>();
  progress_[message.rank] = parcel.take<Progress>();
  for (const TileCost& cost : parcel.take<std::vector<TileCost>>()) schedule_.finished(cost);
  if (idle < 0) return;  // a report, and no more
  if (stopped_ || schedule_.left() == 0) {
    world_.send(message.rank, Tag::no_more, {});
    return;
  }
  Parcel tiles;
  tiles.put(schedule_.take(idle, threads));
  world_.send(message.rank, Tag::tiles, tiles);
}

void TileServer::stop_all() {
  if (stopped_) return;
  stopped_ = true;
  token_.cancel();
  std::vector<int> at_work;
  for (int rank = 1; rank < world_.size(); ++rank)
    if (!farewells_.contains(rank)) at_work.push_back(rank);
  world_.send_all(at_work, Tag::stop, {});
}

bool TileServer::all_gone() const { return farewells_.size() + 1 == static_cast<std::size_t>(world_.size()); }

}  // namespace ifov::cluster
