#include "cluster/tile_client.h"

#include <algorithm>
#include <chrono>

#include "cluster/backoff.h"

namespace ifov::cluster {
namespace {

/// Between two polls for messages, where a thread waits for tiles; where more are on their way; and where only the end of
/// the run may come.
constexpr std::chrono::milliseconds kBackoffIdle{1}, kBackoffAsked{5}, kBackoffAtWork{20};
constexpr auto kReportEvery = std::chrono::milliseconds(500);
constexpr int kReportOnly = -1;

}  // namespace

TileClient::TileClient(Communicator& communicator, int threads, const CancelToken* user)
    : communicator_(communicator), threads_(threads), user_(user), told_(Clock::now()), thread_([this] {
        work();
      }) {}

TileClient::~TileClient() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::optional<int> TileClient::next() {
  std::unique_lock lock(mutex_);
  const auto was = begun_.find(std::this_thread::get_id());
  if (was != begun_.end()) {
    const std::chrono::duration<double> took = Clock::now() - was->second.when;
    finished_.push_back({was->second.tile, took.count()});
    begun_.erase(was);
  }
  if (tiles_.empty() && !no_more_) {
    ++idle_;
    wake_.notify_all();
    wake_.wait(lock, [&] { return !tiles_.empty() || no_more_; });
    --idle_;
  }
  if (tiles_.empty()) return std::nullopt;
  const int tile = tiles_.front();
  tiles_.pop_front();
  begun_[std::this_thread::get_id()] = {tile, Clock::now()};
  if (tiles_.size() <= low_water_) wake_.notify_all();
  return tile;
}

void TileClient::report(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  progress_ = progress;
}

bool TileClient::was_stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

void TileClient::farewell(const Fault& fault, int packs, const std::vector<std::string>& warnings) {
  const std::lock_guard lock(mutex_);
  Payload payload;
  put(payload, fault);
  payload.put(packs);
  payload.put(warnings);
  payload.put(progress_);
  communicator_.send(0, Tag::farewell, payload);
}

bool TileClient::wants_more() const {
  return !asked_ && !no_more_ && tiles_.size() <= low_water_ && (idle_ > 0 || !only_when_idle_);
}

void TileClient::work() {
  std::unique_lock lock(mutex_);
  Backoff backoff;
  while (!leaving_) {
    bool any = false;
    while (std::optional<Message> message = communicator_.poll()) {
      take(std::move(*message));
      any = true;
    }
    if (user_ != nullptr && user_->cancelled()) {
      token_.cancel();
      no_more_ = any = true;
    }
    if (any) wake_.notify_all();
    if (wants_more()) {
      ask(idle_);
      asked_ = any = true;
    } else if (!no_more_ && Clock::now() - told_ > kReportEvery) {
      ask(kReportOnly);
    }
    if (any) backoff.restart();
    const int idle = idle_;
    wake_.wait_for(lock,
                   backoff.next(idle > 0 ? kBackoffIdle
                                : asked_ ? kBackoffAsked
                                         : kBackoffAtWork),
                   [&] { return leaving_ || wants_more() || idle_ > idle; });
  }
}

void TileClient::take(Message message) {
  switch (message.tag) {
    case Tag::tiles: {
      const auto tiles = message.payload.take<std::vector<int>>();
      tiles_.insert(tiles_.end(), tiles.begin(), tiles.end());
      low_water_ = tiles.size() / 2;
      only_when_idle_ = tiles.empty();
      asked_ = false;
      break;
    }
    case Tag::no_more: no_more_ = true; break;
    case Tag::stop:
    case Tag::end:
    // Not of this conversation, or to the first rank: something is wrong, and the run had better end.
    case Tag::load:
    case Tag::loaded:
    case Tag::begin:
    case Tag::ask:
    case Tag::farewell: no_more_ = stopped_ = true; token_.cancel();
  }
}

void TileClient::ask(int idle) {
  Payload payload;
  payload.put(idle);
  payload.put(threads_);
  payload.put(progress_);
  payload.put(finished_);
  finished_.clear();
  told_ = Clock::now();
  communicator_.send(0, Tag::ask, payload);
}

}  // namespace ifov::cluster
