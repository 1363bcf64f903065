#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "geometry/world/surface_survey.h"
#include "transport/shapes/round_mirror.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

/// The round mirrors of a scene by whose outer sides light is sought: in each a light has one image.
class RoundMirrors {
 public:
  /// None are sought where there are more, nor in periodic scenes.
  static constexpr std::size_t kMost = 64;

  RoundMirrors(const scene::Scene& scene, const geometry::SurfaceSurvey& survey);

  std::span<const RoundMirror> all() const { return rounds_; }
  /// About those by which some light is not sought: stretched or hollow ones, or too many.
  std::span<const geometry::SurfaceSurvey::Ball> unsought() const { return unsought_; }

  /// Whether all light that an object's round faces throw is sought.
  bool seeks_all_of(std::uint32_t object) const {
    return std::binary_search(whole_.begin(), whole_.end(), object);
  }
  /// Whether a point lies on the outer side of one of them.
  bool sought(const geometry::SurfacePoint& hit) const {
    return hit.bend == geometry::Bend::round && hit.front && hit.copy_column == 0 && hit.copy_row == 0 &&
           !bends_[hit.material] && std::binary_search(objects_.begin(), objects_.end(), hit.instance);
  }
  /// The place of one of `most` that are picked for a point, in proportion to the share of the view that they take;
  /// `expected`: how often it is picked in the mean. All of them, once each, where there are no more.
  struct Pick {
    std::size_t round = 0;
    double expected = 1.0;
  };
  /// Calls use(pick) for each; random(k) in [0, 1) is drawn for the k-th where there are more.
  template <class Random, class Use>
  void pick(math::Point3 from, std::size_t most, const Random& random, const Use& use) const {
    if (rounds_.size() <= most) {
      for (std::size_t k = 0; k < rounds_.size(); ++k) use(Pick{k, 1.0});
      return;
    }
    const double all = shares(from);
    double passed = 0.0;
    std::size_t picked = 0;
    for (std::size_t k = 0; k < most; ++k) {
      const double position = (static_cast<double>(k) + random(k)) * all / static_cast<double>(most);
      while (picked + 1 < rounds_.size() && position >= passed + rounds_[picked].share_of_view(from))
        passed += rounds_[picked++].share_of_view(from);
      use(Pick{picked, static_cast<double>(most) * rounds_[picked].share_of_view(from) / all});
    }
  }
  /// Of pick().
  double expected(math::Point3 from, std::size_t most, std::size_t round) const {
    return rounds_.size() <= most
               ? 1.0
               : static_cast<double>(most) * rounds_[round].share_of_view(from) / shares(from);
  }

  /// Which of them a ray met, and what is seen there.
  struct Met {
    std::size_t round = 0;
    RoundMirror::Image image;
  };
  std::optional<Met> met(math::Point3 from, const geometry::SurfacePoint& hit) const;

 private:
  double shares(math::Point3 from) const;

  std::vector<bool> bends_;  // by surface assignment: a relief tilts its normals
  std::vector<RoundMirror> rounds_;
  std::vector<std::uint32_t> objects_;  // sorted: all their round faces are among rounds_
  std::vector<std::uint32_t> whole_;    // of them, sorted: those without an inner side
  std::vector<geometry::SurfaceSurvey::Ball> unsought_;
};

}  // namespace ifov::transport
