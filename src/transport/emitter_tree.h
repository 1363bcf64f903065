#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "transport/shapes/emitter_shape.h"

namespace ifov::scene {
class RadiationPattern;
}

namespace ifov::transport {

/// Radiance in groups of channels, in each of which emitters share out their light alike; in units that all emitters share,
/// one a group. A lamp and warm ground have little in common: in the channels where the lamp shines the ground does not.
struct GroupedRadiance {
  static constexpr std::size_t kMost = 4;
  std::array<double, kMost> of{};
};

/// A piece that light is sought from.
struct Emitter {
  EmitterShape shape;
  GroupedRadiance radiance;
  std::int32_t column = 0, row = 0;  ///< of a periodic world: the copy, from the object's own place
  const scene::RadiationPattern* pattern = nullptr;  ///< of a lamp; null: the same in all directions
};

/// Picks one of many emitters for a receiver with a probability about in proportion to what each would send there if nothing
/// stood between: a binary tree whose nodes know the power, the bounding sphere and the cone of normals of what is in
/// them, and leaves of a few emitters that are weighed one by one (Conty Estevez and Kulla 2018, "Importance sampling of
/// many lights with adaptive tree splitting", without the splitting). So among a few emitters the probabilities are as good as
/// EmitterShape::reach_sr. Each group of channels has its own such probabilities, and the choice is by their mean.
class EmitterTree {
 public:
  /// Keeps a view of the emitters, which must outlive it unmoved; at least one. `groups` of their radiance count.
  explicit EmitterTree(std::span<const Emitter> emitters, std::size_t groups = 1);

  struct Choice {
    std::uint32_t emitter = 0;
    double probability = 0.0;  ///< 0: nothing can reach the receiver
    double rest = 0.0;         ///< where `u` lies within the emitter's share, [0, 1): a number as good as `u`
  };
  /// `u` in [0, 1).
  Choice choose(const Receiver& receiver, double u) const;

  /// Of choose() for an emitter.
  double probability(const Receiver& receiver, std::uint32_t emitter) const;

  /// About what all of them would send there, mean of the groups.
  double reach(const Receiver& receiver) const;

 private:
  static constexpr std::size_t kInLeaf = 6;
  struct Node {
    math::Point3 centre_m;
    double radius_m = 0.0;
    std::array<double, GroupedRadiance::kMost> power{};  ///< radiance times area, by group
    math::Vec3 axis;                                     ///< of the cone of normals
    double widest_cosine = -1.0;                         ///< of its half-angle; -1: any direction
    bool one_sided = false;                              ///< of closed meshes: the other side counts little
    std::uint32_t parent = 0, first = 0,
                  count = 0;  ///< of a leaf: within order_; else `first` of two nodes, count 0
  };
  using Probabilities = std::array<double, GroupedRadiance::kMost>;
  struct Weights {
    double of[kInLeaf][GroupedRadiance::kMost];
    Probabilities sum{};
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  void describe(Node& node, std::uint32_t first, std::uint32_t count) const;
  /// Times a node's power: about what it sends there.
  static double importance(const Node& node, const Receiver& receiver);
  /// Of a node, in each group, beside the other one of its parent.
  Probabilities beside(const Node& node, double importance, const Node& other, double others) const;
  double mean(const Probabilities& of_groups) const;
  static double towards(const Emitter& emitter, const Receiver& receiver);
  Weights weights(const Node& leaf, const Receiver& receiver) const;

  std::span<const Emitter> emitters_;
  std::size_t groups_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  ///< by emitter
};

}  // namespace ifov::transport
