#include "io/run_state/tile_store.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.h"
#include "io/files/own_files.h"
#include "io/products/part_file.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io {
namespace {

constexpr double kLeastGather_s = 1e-3, kMostGather_s = 1.0, kGatherShare = 0.05;
constexpr std::size_t kPackBytes = std::size_t{8} << 20;
constexpr std::size_t kMostWaitingBytes = std::size_t{64} << 20;

/// Different for any two starts, whatever the clock says.
std::uint64_t start_mark() {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return static_cast<std::uint64_t>(now) * 1000003u + static_cast<std::uint64_t>(getpid());
}

int first_free_number(const std::filesystem::path& folder) {
  int number = 0;
  for (const auto& pack : packs_in(folder)) number = std::max(number, std::atoi(pack.filename().c_str()) + 1);
  return number;
}

}  // namespace

std::string pack_name(const StoreStart& start, int rank, int number) {
  return rank == 0 ? format("{:06d}{}", number, kPackEnding)
                   : format("{:06d}.{:x}.{}{}", number, start.mark, rank, kPackEnding);
}

TileStore::TileStore(std::filesystem::path folder, std::uint64_t run)
    : TileStore(folder, run, {start_mark(), first_free_number(folder)}, 0) {}

TileStore::TileStore(std::filesystem::path folder, std::uint64_t run, const StoreStart& start, int rank)
    : folder_(std::move(folder)),
      run_(run),
      start_(start),
      rank_(rank),
      began_(std::chrono::steady_clock::now()) {
  refuse_link(folder_.parent_path());
  refuse_link(folder_);
  require_space(folder_, 0);
  writer_ = std::thread([this] { work(); });
}

TileStore::~TileStore() {
  try {
    close();
  } catch (const std::exception&) {
    // The run ends for a reason of its own, which is said; what is on disk stays.
  }
}

double TileStore::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void TileStore::put(std::uint32_t index, const sampling::TileResult& tile) {
  Record record = encode_tile(tile, {index, start_.mark, run_, elapsed_s()});
  std::unique_lock lock(mutex_);
  room_.wait(lock, [&] { return waiting_bytes_ < kMostWaitingBytes || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_bytes_ += record.size();
  waiting_.push_back({std::move(record), tile.tile.y1});
  wake_.notify_one();
}

void TileStore::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  if (writer_.joinable()) writer_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void TileStore::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::chrono::duration<double> gather(
        std::clamp(kGatherShare * elapsed_s(), kLeastGather_s, kMostGather_s));
    wake_.wait_for(lock, gather, [&] { return closing_ || waiting_bytes_ >= kPackBytes; });
    std::vector<Waiting> tiles;
    tiles.swap(waiting_);
    waiting_bytes_ = 0;
    room_.notify_all();
    lock.unlock();
    try {
      write_pack(tiles);
    } catch (...) {
      lock.lock();
      failure_ = std::current_exception();
      room_.notify_all();
      return;
    }
    lock.lock();
  }
}

void TileStore::write_pack(const std::vector<Waiting>& tiles) {
  PartFile file(folder_ / pack_name(start_, rank_, start_.first_pack + packs_));
  std::vector<iovec> pieces;
  std::uint64_t bytes = 0;
  int line_end = 0;
  for (const Waiting& tile : tiles) {
    pieces.push_back({const_cast<std::byte*>(tile.record.data()), tile.record.size()});
    bytes += tile.record.size();
    line_end = std::max(line_end, tile.line_end);
  }
  written_bytes_ += bytes;
  try {
    // What loses its values soon need not reach the disk before.
    if (written_bytes_ >= kManyBytes && !written_) {
      file.bypass_page_cache();
      file.reserve(bytes);
    }
    file.write_at(0, pieces);
    file.publish();
  } catch (...) {
    file.discard();
    throw;
  }
  ++packs_;
  if (written_) written_(file.final_path(), line_end);
}

}  // namespace ifov::io
