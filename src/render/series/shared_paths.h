#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/field/scene_field.h"

namespace ifov::scene {
class TemperaturesOfTimes;
}

namespace ifov::render {

/// The values of one tile at several times, which differ in how warm surfaces are: a path is found once, for whichever time asks
/// first, the temperatures along it are asked for all times at once, and each time's own scene makes light of it. What a time
/// is told depends on the request and the time alone. One thread.
class SharedPaths {
 public:
  /// Of time `t` `fields[t]`, null where that time is not rendered; `tracer` finds the paths, and is of any of the scenes. Keeps
  /// references. What was found is held up to `most_bytes`, and found again beyond.
  SharedPaths(SceneField& tracer, std::vector<SceneField*> fields,
              const scene::TemperaturesOfTimes& temperatures, std::size_t most_bytes);
  ~SharedPaths();

  /// Where the field of a time takes its values from.
  SharedValues& of(std::size_t time);

 private:
  class OfTime;
  struct Key {
    std::uint64_t sequence, x, y;
    std::uint32_t index;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  class Handles;

  void values(std::size_t time, std::span<const sampling::PathRequest> requests,
              std::span<sampling::Label> labels, std::span<float> values);
  /// Finds paths for a time and, where they are to be held, all after it.
  void find(std::size_t time, std::span<const sampling::PathRequest> requests, bool hold);
  float* row(std::size_t time, std::size_t number) {
    return held_.data() + (number * fields_.size() + time) * columns_;
  }

  SceneField& tracer_;
  std::vector<SceneField*> fields_;
  const scene::TemperaturesOfTimes& temperatures_;
  std::size_t most_bytes_, columns_;
  std::vector<std::unique_ptr<OfTime>> of_time_;
  std::unordered_map<Key, std::uint32_t, KeyHash> number_;
  // By path, those of a call that are not held at the end.
  std::vector<sampling::Label> labels_;
  std::vector<sampling::RayCounts> rays_;
  std::vector<float> held_;
  std::size_t count_ = 0;  ///< of those that are held
  std::vector<sampling::PathRequest> missing_;
  std::vector<std::uint32_t> asked_;  ///< by request: its path
  std::vector<float> values_;
};

}  // namespace ifov::render
