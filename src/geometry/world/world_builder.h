#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/body.h"
#include "geometry/cut_out.h"
#include "geometry/height_field.h"
#include "geometry/placements.h"
#include "geometry/presence.h"
#include "geometry/shapes.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// A shape or prototype known to a builder.
struct ShapeId {
  std::uint32_t value = 0;
};

/// A shape (or prototype) as part of a prototype: one copy, or one for each entry of a list.
struct Part {
  ShapeId what;
  math::Transform prototype_from_part;
  /// The prototype's material slot for each slot of the part; empty: all 0.
  std::vector<std::uint32_t> slots;
  std::shared_ptr<const Placements> list = nullptr;  ///< copies stand at prototype_from_part * list->at(k)
};

/// How instances are kept: as nodes of the ray tracer (faster rays), or in a table of our own (a third of the
/// memory, and of the time to build). The hits are the same.
enum class InstanceStorage { by_number, nodes, table };

/// When the trees of large meshes are made: with the world, or chunk by chunk as rays come near (quick to begin with).
/// The hits are the same.
enum class LargeMeshes { by_number, at_once, by_chunk };

struct BuildOptions {
  int threads = 0;                                         ///< 0: all cores
  InstanceStorage instances = InstanceStorage::by_number;  ///< up to a million nodes, else a table
  LargeMeshes large_meshes = LargeMeshes::by_number;  ///< up to 2^21 stored triangles at once, else by chunk
  /// By material: whether its surfaces are listed (World::survey); empty: none.
  std::vector<bool> surveyed{};
  /// The same for World::lobe_survey.
  std::vector<bool> lobes{};
  /// By material: the holes of its triangles; null, or beyond the end: it has none. Planes, height fields and analytic shapes
  /// are never cut.
  std::vector<std::shared_ptr<const CutOut>> cut_outs{};
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

  /// The same for a body made before, by body_of().
  ShapeId add_body(Body body);

  /// A terrain that is traced in its grid. It cannot be a part, nor be placed many times at once.
  ShapeId add_height_field(std::shared_ptr<const HeightField> field);

  /// Several parts that are placed as one object; planes cannot be parts. Parts may be prototypes themselves, to any
  /// depth.
  ShapeId add_prototype(std::span<const Part> parts);

  /// Objects placed so far: the number of the next.
  std::uint32_t object_count() const;

  /// What is placed from now on is there at these times only; null: always.
  void set_presence(std::shared_ptr<const Presence> presence);

  /// Number of material slots that `place` expects; 1 for every shape but meshes and prototypes.
  std::size_t slot_count(ShapeId what) const;

  /// Returns the instance number: 0, 1, 2, ... in the order of placing. `material_of_slot` has slot_count
  /// entries. `pilot_ray`: whether a ray is sent at the object where it is compact (false for a leaf or a part
  /// of something larger that is placed on its own). Planes may be moved and turned about the vertical, not
  /// tilted.
  std::uint32_t place(ShapeId what, const math::Transform& scene_from_object,
                      std::span<const std::uint32_t> material_of_slot, bool pilot_ray = true);

  /// The same for one object for each entry of a list, at scene_from_list * list->at(k). Returns the number of the
  /// first; the others follow.
  std::uint32_t place_many(ShapeId what, const math::Transform& scene_from_list,
                           std::shared_ptr<const Placements> list,
                           std::span<const std::uint32_t> material_of_slot, bool pilot_ray = true);

  /// The builder is empty afterwards. Lists of placings are not kept.
  std::unique_ptr<World> build(const BuildOptions& options = {});
  std::unique_ptr<World> build(int threads) { return build(BuildOptions{.threads = threads}); }

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace ifov::geometry
