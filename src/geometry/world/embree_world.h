#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/growing_box.h"
#include "geometry/oriented_extent.h"
#include "geometry/world.h"
#include "geometry/world/chunked_mesh.h"
#include "geometry/world/embree_scene.h"
#include "geometry/world/instance_set.h"
#include "geometry/world/piece_walk.h"
#include "geometry/world/presence_table.h"
#include "geometry/world/primitive_sets.h"
#include "geometry/world/prototype_plan.h"
#include "geometry/world/ray_packet.h"
#include "geometry/world/surface_survey.h"
#include "geometry/world/world_builder.h"
#include "geometry/world/world_content.h"

namespace ifov::geometry {

/// The world on Embree. The scene is moved about the centre of its bounds in double before it becomes float;
/// bodies that stand in several places become Embree instances about their own centres, all others lie in the
/// scene itself; height fields are met block by block in their own frames, planes beside Embree.
class EmbreeWorld final : public World, private HoleTest {
 public:
  EmbreeWorld(WorldContent content, const BuildOptions& options);

  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const override;
  void intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  Bounds bounds() const override { return bounds_; }
  Heights heights() const override { return heights_; }
  std::size_t object_count() const override { return objects_.size(); }
  PlacedObject object(std::size_t number) const override;
  bool has_corners(std::size_t number) const override {
    return !cut_outs_.empty() || figures_[objects_[number].of].has_corners;
  }
  std::span<const Presence> presences() const override { return visits_.presences; }
  const Presence* presence(std::uint32_t object) const override { return visits_.of(object); }
  std::size_t triangle_count() const override { return triangle_count_; }
  Storage storage() const override;
  void visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const override;
  std::vector<double> surface_areas_m2(std::size_t materials) const override;
  const SurfaceSurvey* survey() const override { return survey_.get(); }
  const SurfaceSurvey* lobe_survey() const override { return lobe_survey_.get(); }

 private:
  class SurfaceWalk;
  /// A body with its own Embree scene.
  struct Prototype {
    TriangleSet triangles;
    AnalyticSet analytic;
    std::unique_ptr<ChunkedMesh> chunked;  ///< instead of `triangles`
    EmbreeScene scene;
  };
  /// A mesh kept for its texture coordinates or normals.
  struct Attributes {
    MeshLists mesh;
    math::Point3 centre_m;  ///< of the body: where the frame of its set has its origin
  };
  struct PlaneObject {
    double z_m = 0.0;  ///< about the scene's centre
    std::uint32_t object = 0, material = 0;
    math::Transform object_from_scene;
  };
  /// What placed objects of a template have in common, in its own frame.
  struct Figure {
    math::Point3 centre_m, pilot_point_m;
    double radius_m = 0.0;
    World::Bounds bounds{};
    HalfSides half_sides_m{};
    math::Point3 set_origin_m;  ///< of the frame of its set
    bool has_corners = false;
  };
  struct Object {
    std::uint32_t of = 0;            ///< template
    std::uint32_t where = kNoIndex;  ///< into transforms_, or an instance number
    bool pilot_ray = true, is_instance = false;
  };

  void choose_chunked(WorldContent& content, const PrototypePlan& plan, const std::vector<bool>& instanced,
                      LargeMeshes how);
  void note_figures(const WorldContent& content, const PrototypePlan& plan);
  void note_objects(const WorldContent& content, const std::vector<bool>& instanced);
  void note_presences(const WorldContent& content);
  void find_bounds(const WorldContent& content, const PieceWalk& walk, const std::vector<bool>& instanced,
                   std::vector<double>& shrink);
  void find_heights(const WorldContent& content, GrowingBox box);
  double box_padding_m() const;
  void build_prototypes(WorldContent& content, const std::vector<bool>& instanced,
                        const std::vector<double>& shrink);
  void place_pieces(WorldContent& content, const PieceWalk& walk, const PrototypePlan& plan,
                    const std::vector<bool>& instanced);
  void place_fields(const WorldContent& content);
  void build_scene(InstanceStorage instances);
  void note_storage(const PrototypePlan& plan);
  /// visit_surfaces() of what is no instance.
  void visit_copied(const WantedMaterials& wanted, const PieceVisitor& visitor) const;
  /// By template: area of its surfaces by slot, in the frame of its body; empty where it has no set of its own.
  std::vector<std::vector<double>> slot_areas() const;

  // Queries of one packet; `count` lanes are in use. False where no lane needs Embree.
  bool load(RayPacket& packet, std::span<const math::Ray> rays, double* shift, RTCRay8& embree,
            int* valid) const;
  void meet_planes(RayPacket& packet, std::size_t count) const;
  void finish(const RayPacket& packet, std::size_t k, const math::Ray& ray, double shift,
              SurfacePoint& hit) const;
  void finish_plane(const Candidate& c, SurfacePoint& hit) const;
  void finish_triangle(const Candidate& c, SurfacePoint& hit) const;
  void finish_field(const Candidate& c, SurfacePoint& hit) const;
  void finish_analytic(const RayPacket& packet, std::size_t k, SurfacePoint& hit) const;
  void apply_attributes(const Attributes& kept, const math::Transform& mesh_from_scene, math::Point3 in_mesh,
                        std::uint32_t triangle, SurfacePoint& hit) const;
  double analytic_offset(const SurfacePoint& hit) const;
  InstanceTable table() const;
  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits, const HoleTest* holes) const;
  bool is_open(const RayPacket& packet, std::size_t k, const TriangleSet& set, std::uint32_t instance,
               std::uint32_t prim, double t, double seen) const override;
  const HoleTest* holes() const { return cut_outs_.empty() ? nullptr : this; }

  std::atomic<std::int64_t> embree_bytes_{0};  // above the device, which writes to it
  std::int64_t built_embree_bytes_ = 0;        // before the first ray
  EmbreeDevice device_;
  std::vector<std::unique_ptr<Prototype>> prototypes_;  ///< by template; null where it needs none
  TriangleSet triangles_;
  AnalyticSet analytic_;
  LateFailure late_failure_;
  std::vector<bool> is_chunked_;                       ///< by template
  std::vector<std::unique_ptr<ChunkedMesh>> chunked_;  ///< in the scene itself
  InstanceSet instance_set_;
  std::vector<PlacedField> fields_;
  EmbreeScene scene_;  ///< null where everything is planes
  std::vector<PlaneObject> planes_;

  math::Point3 centre_m_;  ///< of the scene's bounds: Embree's origin
  Bounds bounds_{};
  Heights heights_;
  Bounds padded_{};       ///< about the centre, widened
  double scale_m_ = 0.0;  ///< largest coordinate about the centre
  double window_m_ = 0.0;
  double same_m_ = 0.0;  ///< surfaces nearer to each other than this lie in one place
  double triangle_offset_m_ = 0.0;

  std::vector<Figure> figures_;  ///< by template
  std::vector<Object> objects_;
  PresenceTable visits_;                     ///< without runs: everything is always there
  std::vector<math::Transform> transforms_;  ///< of objects that are no instances: scene from object

  // By Embree's instance number.
  std::vector<math::Transform> set_from_scene_;
  std::vector<Piece> instances_;
  // By the owner of a primitive in the shared sets.
  std::vector<Piece> copies_;
  std::vector<std::uint32_t> copy_map_of_;  ///< into body_from_scene_; kNoIndex without attributes
  std::vector<math::Transform> body_from_scene_;

  std::vector<std::uint32_t> materials_;
  std::vector<std::shared_ptr<const CutOut>> cut_outs_;  ///< by material; empty: nothing has holes
  std::vector<Attributes> attributes_;
  /// By template: into attributes_, or kNoIndex; empty: none at all.
  std::vector<std::uint32_t> attributes_of_;
  std::size_t triangle_count_ = 0;
  Storage storage_;
  std::unique_ptr<const SurfaceSurvey> survey_, lobe_survey_;
};

}  // namespace ifov::geometry
