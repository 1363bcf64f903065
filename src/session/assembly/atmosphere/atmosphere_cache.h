#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "atmosphere/sensor/kept_solutions.h"
#include "io/scene_cache/scene_cache.h"

namespace ifov::session {

/// The atmosphere's solutions in a scene cache: one record that holds each by the hash of what it depends on.
/// Where the record makes no sense nothing is known, and the cache's log is told.
class AtmosphereCache final : public atmosphere::KeptSolutions {
 public:
  explicit AtmosphereCache(io::SceneCache& cache);

  bool find(std::span<const double> question, std::span<double> answer) override;
  void keep(std::span<const double> question, std::span<const double> answer) override;

  /// Puts what was found or kept into the cache, if any of it is new and it is enough to be worth it.
  void save();

 private:
  using Key = std::array<std::uint64_t, 2>;
  struct Solution {
    std::vector<double> answer;
    bool used = false;
  };
  bool read(std::span<const std::byte> record);

  io::SceneCache& cache_;
  std::mutex mutex_;
  std::map<Key, Solution> solutions_;
  bool changed_ = false;
};

}  // namespace ifov::session
