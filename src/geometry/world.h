#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/surface_piece.h"
#include "geometry/surface_point.h"
#include "math/ray.h"

namespace ifov::geometry {

class MovingWorld;
struct Presence;
struct SurfaceSurvey;

/// All geometry of a scene, built once and immutable: the only door to the ray tracer. Batches are traced in packets; the answer to
/// a ray does not depend on its neighbours in the batch. Objects that are there for a time only are met by rays of that time.
/// Safe to call from many threads. Queries throw where memory runs out while a tree is made for them.
class World {
 public:
  virtual ~World() = default;

  /// Nearest surface along each ray. Of several objects in one place, but for the rounding of doubles, the one placed
  /// last is met (a road on the plane that it lies in); of one object's surfaces the one with the smallest number.
  virtual void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const = 0;

  /// The same where holes of surfaces (BuildOptions::cut_outs) are closed.
  virtual void intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const {
    intersect(rays, hits);
  }

  /// 1 where anything lies strictly between t_min_m and t_max_m.
  virtual void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const = 0;

  /// Axis-aligned bounds of everything that is bounded, scene frame.
  struct Bounds {
    math::Point3 low_m, high_m;
  };
  virtual Bounds bounds() const = 0;

  /// Lowest and highest point of everything, planes included (those are no part of the bounds); 0 of an empty world.
  struct Heights {
    double low_m = 0.0, high_m = 0.0;
  };
  virtual Heights heights() const = 0;

  /// A placed object, by its instance number, with a bounding sphere (infinite for planes). Seeds of small ones come from here.
  struct PlacedObject {
    math::Point3 centre_m;
    double radius_m = 0.0;
    math::Point3 pilot_point_m;  ///< a point on or in the object that a ray towards it meets (centroid of its
                                 ///< largest face for open meshes, the centre for solids)
    /// From the centre to the sides of the box in the object's own frame, longest first; 0 for planes.
    std::array<math::Vec3, 3> half_sides_m;
    bool compact = false;  ///< one connected thing, not a leaf or part of a larger object
  };
  virtual std::size_t object_count() const = 0;
  virtual PlacedObject object(std::size_t number) const = 0;
  /// Whether an object's outline may turn sharply: no ball, disk, plane or terrain without holes.
  virtual bool has_corners(std::size_t number) const = 0;

  /// The pieces whose materials are wanted (one entry for each surface assignment of the scene), in a fixed order; of a world that
  /// repeats, those of the one world. Planes and height fields have none.
  virtual void visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const = 0;
  /// Area by SurfacePoint::material (`materials` of them), about, m^2: unequal scales count by their mean. A plane
  /// counts as much as all else together and 1 m^2, a height field by its outline.
  virtual std::vector<double> surface_areas_m2(std::size_t materials) const = 0;

  /// What there is of times at which objects are there, and that of one object by its number; null: it always is.
  virtual std::span<const Presence> presences() const { return {}; }
  virtual const Presence* presence(std::uint32_t) const { return nullptr; }
  virtual const MovingWorld* moving() const { return nullptr; }  ///< null: all stands still

  /// As a ray sees them, copies counted.
  virtual std::size_t triangle_count() const = 0;

  /// How all this is kept.
  struct Storage {
    std::size_t stored_triangles = 0;  ///< each of a copied body once
    std::size_t instances = 0;         ///< bodies that stand in the scene by reference
    bool instance_table = false;       ///< kept in a table of our own, not as nodes of the ray tracer
    std::size_t prototypes_apart = 0;  ///< prototypes of prototypes that are not joined into one body
    std::size_t chunks = 0;            ///< of large meshes, whose trees are made when a ray comes near
    std::size_t chunks_made = 0;       ///< those whose trees are there by now
    std::size_t chunk_bytes = 0;       ///< of their trees, about
    std::size_t bytes = 0;             ///< of tables and trees, about; without those of chunks
  };
  virtual Storage storage() const = 0;

  /// Where the surfaces are that were to be surveyed (BuildOptions::surveyed); null: none were.
  virtual const SurfaceSurvey* survey() const { return nullptr; }

  /// The same of BuildOptions::lobes, its meshes' facets among the smooth ones.
  virtual const SurfaceSurvey* lobe_survey() const { return nullptr; }

  /// After how much x and y everything repeats; none: once only (see PeriodicWorld).
  struct Period {
    double x_m = 0.0, y_m = 0.0;
  };
  virtual std::optional<Period> period() const { return std::nullopt; }
};

}  // namespace ifov::geometry
