#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "transport/mirrors/mirror_paths.h"

namespace ifov::transport {

class SpectralScene;

/// What sunlight mirrors throw on surfaces, for labels: so that the rims of such light, and the gradients in it, are
/// found like those of shadows. Of flat mirrors it says which images of which points of the disc are seen, of round ones how bright all are together, in steps of two.
class MirrorLight {
 public:
  /// Null where no mirror throws the Sun, or nothing is sought by way of mirrors (`reflections` 0). Keeps references to the scene and to the Sun's images in its flat mirrors.
  static std::unique_ptr<MirrorLight> find(const SpectralScene& scene, const SunImages& images,
                                           int reflections);
  MirrorLight(const MirrorLight&) = delete;
  MirrorLight& operator=(const MirrorLight&) = delete;

  /// A surface point that `seen` met, where `outward` is the side that light must come to.
  void ask(std::uint32_t owner, const math::Ray& seen, const geometry::SurfacePoint& hit, math::Vec3 outward);
  /// That mirrors may throw light on a point at some times alone, told of each that was asked for.
  template <class Add>
  void answer_changing(const Add& add) {
    for (const Asked& point : asked_) add(point.owner, 1, true);
    ways_.clear();
    asked_.clear();
  }
  /// The state of each point that was asked for and that mirrors throw some light on: add(owner, state, uneven), the
  /// same 64 bits for points of the same state; `uneven` where light of one state differs from place to place.
  template <class Add>
  void answer(sampling::RayCounts& counts, const Add& add) {
    trace(counts);
    for (const Asked& point : asked_)
      if (const State state = state_of(point); state.bits != 0) add(point.owner, state.bits, state.uneven);
    asked_.clear();
  }

 private:
  static constexpr std::size_t kMostImages = 24;  // in flat mirrors, that are judged
  struct Way : MirrorPath {
    std::uint32_t asked = 0;
    double light = 0.0;  // of a round mirror
  };
  struct Asked {
    std::uint32_t owner = 0;
    double round_light = 0.0;                      // in parts of the Sun's irradiance
    std::array<std::uint8_t, kMostImages> seen{};  // points of the disc, by image
  };
  MirrorLight(const SpectralScene& scene, const SunImages& images);
  void trace(sampling::RayCounts& counts);
  struct State {
    std::uint64_t bits = 0;
    bool uneven = false;
  };
  State state_of(const Asked& point) const;

  const SpectralScene& scene_;
  const SunMirrors& mirrors_;
  const SunImages& images_;
  std::vector<std::vector<math::Vec3>> disc_points_;  // by image
  MirrorTracer tracer_;
  std::vector<Way> ways_;
  std::vector<Asked> asked_;
};

}  // namespace ifov::transport
