#include "session/assembly/atmosphere/atmosphere_cache.h"

#include <cmath>
#include <cstring>

#include "io/scene_cache/scene_cache.h"

namespace ifov::session {
namespace {

constexpr const char* kRecord = "atmosphere";
/// Fewer are solved as quickly as they are read.
constexpr std::size_t kLeastKept = 48;
constexpr std::size_t kHead = 3;  // two halves of the key, and how many numbers follow

}  // namespace

AtmosphereCache::AtmosphereCache(io::SceneCache& cache) : cache_(cache) {
  const auto record = cache_.find(kRecord);
  if (!record || read(*record)) return;
  cache_.reject(kRecord);
  solutions_.clear();
}

bool AtmosphereCache::read(std::span<const std::byte> record) {
  while (!record.empty()) {
    std::array<std::uint64_t, kHead> head;
    if (record.size() < sizeof head) return false;
    std::memcpy(head.data(), record.data(), sizeof head);
    record = record.subspan(sizeof head);
    if (head[2] > record.size() / sizeof(double)) return false;
    std::vector<double> answer(head[2]);
    std::memcpy(answer.data(), record.data(), answer.size() * sizeof(double));
    record = record.subspan(answer.size() * sizeof(double));
    for (const double value : answer)
      if (!std::isfinite(value)) return false;
    solutions_[{head[0], head[1]}] = {std::move(answer), false};
  }
  return true;
}

bool AtmosphereCache::find(std::span<const double> question, std::span<double> answer) {
  const Key key = io::content_hash(std::as_bytes(question));
  const std::scoped_lock lock(mutex_);
  const auto found = solutions_.find(key);
  if (found == solutions_.end() || found->second.answer.size() != answer.size()) return false;
  std::copy(found->second.answer.begin(), found->second.answer.end(), answer.begin());
  found->second.used = true;
  return true;
}

void AtmosphereCache::keep(std::span<const double> question, std::span<const double> answer) {
  const Key key = io::content_hash(std::as_bytes(question));
  const std::scoped_lock lock(mutex_);
  solutions_[key] = {{answer.begin(), answer.end()}, true};
  changed_ = true;
}

void AtmosphereCache::save() {
  std::erase_if(solutions_, [](const auto& entry) { return !entry.second.used; });
  if (!changed_ || solutions_.size() < kLeastKept) return;
  std::vector<std::byte> bytes;
  for (const auto& [key, solution] : solutions_) {
    const std::array<std::uint64_t, kHead> head{key[0], key[1], solution.answer.size()};
    const std::span<const std::byte> first = std::as_bytes(std::span(head)),
                                     rest = std::as_bytes(std::span(solution.answer));
    bytes.insert(bytes.end(), first.begin(), first.end());
    bytes.insert(bytes.end(), rest.begin(), rest.end());
  }
  const std::span<const std::byte> piece = bytes;
  cache_.replace(kRecord, {}, std::span(&piece, 1));
}

}  // namespace ifov::session
