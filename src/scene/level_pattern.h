#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "materials/parameter_map.h"
#include "scene/scene.h"

namespace ifov::scene {

/// Replaces a state by those of the levels next to what maps say of its parameters, side by side and weighed linearly: two for one
/// parameter, four for two.
class LevelPattern final : public Pattern {
 public:
  struct Member {
    std::uint32_t state = 0, material = 0;
  };
  /// One axis or two; `members` by level, those of the last axis next to each other. `states_of`: whose place the members take in
  /// answers of replacing(), where `state` itself is brought in by another pattern.
  LevelPattern(std::uint32_t state, std::uint32_t states_of, std::vector<materials::ParameterAxis> axes,
               std::vector<Member> members);
  void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const override;
  std::vector<std::uint32_t> replacing(std::uint32_t state) const override;
  void add_maps(std::vector<const materials::NumberedMap*>& maps) const override;

 private:
  std::uint32_t state_, states_of_;
  std::vector<materials::ParameterAxis> axes_;
  std::vector<Member> members_;
};

}  // namespace ifov::scene
