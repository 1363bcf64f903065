#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/shapes.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// A shape or prototype known to a builder.
struct ShapeId {
  std::uint32_t value = 0;
};

/// A shape (or prototype) as part of a prototype.
struct Part {
  ShapeId what;
  math::Transform prototype_from_part;
  std::vector<std::uint32_t>
      slots;  ///< the prototype's material slot for each slot of the part; empty: all 0
};

/// Collects shapes and where they stand, then builds the world. Shapes are kept once, however often they are
/// placed. Errors in what it is given are InputError.
class WorldBuilder {
 public:
  WorldBuilder();
  ~WorldBuilder();
  WorldBuilder(const WorldBuilder&) = delete;
  WorldBuilder& operator=(const WorldBuilder&) = delete;

  /// Sizes must be positive and finite, polygons planar and simple, indices of a mesh within its lists.
  ShapeId add_shape(Shape shape);

  /// Several parts that are placed as one object; planes cannot be parts. Parts may be prototypes themselves.
  ShapeId add_prototype(std::span<const Part> parts);

  /// Number of material slots that `place` expects; 1 for every shape but meshes and prototypes.
  std::size_t slot_count(ShapeId what) const;

  /// Returns the instance number: 0, 1, 2, ... in the order of placing. `material_of_slot` has slot_count
  /// entries. `seed`: whether the object, if it is compact, may serve as a seed (false for a leaf or a part
  /// of something larger that is placed on its own). Planes may be moved and turned about the vertical, not
  /// tilted.
  std::uint32_t place(ShapeId what, const math::Transform& scene_from_object,
                      std::span<const std::uint32_t> material_of_slot, bool seed = true);

  /// Builds the world on `threads` threads (0: all cores). The builder is empty afterwards.
  std::unique_ptr<World> build(int threads = 0);

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace ifov::geometry
