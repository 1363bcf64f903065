#include "cluster/tile_server.h"

#include <algorithm>
#include <chrono>

#include "cluster/backoff.h"
#include "core/error.h"

namespace ifov::cluster {
namespace {

using Clock = std::chrono::steady_clock;

/// A rank that has nothing to do waits for half of this, once for a tile that takes many times as long.
constexpr std::chrono::milliseconds kLongestBackoff{5};
/// A launcher that ends a run kills who has not left within a second.
constexpr auto kPatience = std::chrono::milliseconds(500);

double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

TileServer::TileServer(Communicator& communicator, TileSchedule schedule, const CancelToken* user)
    : communicator_(communicator),
      user_(user),
      schedule_(std::move(schedule)),
      thread_([this] { serve(); }) {}

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

std::map<int, FinalReport> TileServer::finish(const std::function<void()>& wait) {
  std::unique_lock lock(mutex_);
  std::optional<Clock::time_point> end;
  while (!all_gone() && (!end || Clock::now() < *end)) {
    if (user_ != nullptr && user_->cancelled() && !end) end = Clock::now() + kPatience;
    wake_.wait_for(lock, std::chrono::milliseconds(100));
    lock.unlock();
    wait();
    lock.lock();
  }
  if (user_ != nullptr && user_->cancelled()) throw Cancelled();
  if (failed_) raise(final_reports_[*failed_].fault, communicator_.name(*failed_));
  return final_reports_;
}

void TileServer::serve() {
  Backoff backoff;
  std::unique_lock lock(mutex_);
  while (!leaving_) {
    lock.unlock();
    bool any = false;
    while (std::optional<Message> message = communicator_.poll()) {
      answer(std::move(*message));
      any = true;
    }
    lock.lock();
    if (user_ != nullptr && user_->cancelled()) stop_all();
    if (any) backoff.restart();
    if (!leaving_) wake_.wait_for(lock, backoff.next(kLongestBackoff), [&] { return leaving_; });
  }
}

void TileServer::answer(Message message) {
  const std::unique_lock lock(mutex_);
  Payload& payload = message.payload;
  if (message.tag == Tag::farewell) {
    FinalReport farewell;
    farewell.fault = take_fault(payload);
    farewell.packs = payload.take<int>();
    farewell.warnings = payload.take<std::vector<std::string>>();
    progress_[message.rank] = payload.take<Progress>();
    final_reports_[message.rank] = farewell;
    if (farewell.fault) {
      if (!failed_ && !stopped_) failed_ = message.rank;
      stop_all();
    }
    wake_.notify_all();
    return;
  }
  if (message.tag != Tag::ask) return;
  const int idle = payload.take<int>(), threads = payload.take<int>();
  progress_[message.rank] = payload.take<Progress>();
  for (const TileCost& cost : payload.take<std::vector<TileCost>>()) schedule_.finished(cost);
  if (idle < 0) return;  // a report, and no more
  if (stopped_ || schedule_.left() == 0) {
    communicator_.send(message.rank, Tag::no_more, {});
    return;
  }
  Payload tiles;
  tiles.put(schedule_.take(idle, threads));
  communicator_.send(message.rank, Tag::tiles, tiles);
}

void TileServer::stop_all() {
  if (stopped_) return;
  stopped_ = true;
  token_.cancel();
  std::vector<int> at_work;
  for (int rank = 1; rank < communicator_.size(); ++rank)
    if (!final_reports_.contains(rank)) at_work.push_back(rank);
  communicator_.send_all(at_work, Tag::stop, {});
}

bool TileServer::all_gone() const {
  return final_reports_.size() + 1 == static_cast<std::size_t>(communicator_.size());
}

}  // namespace ifov::cluster
