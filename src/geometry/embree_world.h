#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/embree_scene.h"
#include "geometry/primitive_sets.h"
#include "geometry/ray_packet.h"
#include "geometry/world.h"
#include "geometry/world_content.h"

namespace ifov::geometry {

/// The world on Embree. The scene is moved about the centre of its bounds in double before it becomes float;
/// bodies that stand in several places become Embree instances about their own centres, all others lie in the
/// scene itself; planes are met beside Embree.
class EmbreeWorld final : public World {
 public:
  EmbreeWorld(WorldContent content, int threads);

  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const override;
  Bounds bounds() const override { return bounds_; }
  std::span<const PlacedObject> objects() const override { return objects_; }
  std::size_t triangle_count() const override { return triangle_count_; }

 private:
  /// A body with its own Embree scene.
  struct Prototype {
    TriangleSet triangles;
    AnalyticSet analytic;
    EmbreeScene scene;
  };
  /// A mesh kept for its texture coordinates or normals.
  struct Attributes {
    TriangleMesh mesh;
  };
  struct PlaneObject {
    double z_m = 0.0;  ///< about the scene's centre
    std::uint32_t object = 0;
    math::Transform object_from_scene;
  };

  void place_objects(const WorldContent& content);
  void build_scene(WorldContent& content, const std::vector<bool>& instanced);
  void keep_attributes(WorldContent& content);

  // Queries of one packet; `count` lanes are in use. False where no lane needs Embree.
  bool load(RayPacket& packet, std::span<const math::Ray> rays, double* shift, RTCRay8& embree,
            int* valid) const;
  void meet_planes(RayPacket& packet, std::size_t count) const;
  void finish(const RayPacket& packet, std::size_t k, const math::Ray& ray, double shift,
              SurfacePoint& hit) const;
  void finish_plane(const Candidate& c, SurfacePoint& hit) const;
  void finish_triangle(const Candidate& c, SurfacePoint& hit) const;
  void finish_analytic(const RayPacket& packet, std::size_t k, SurfacePoint& hit) const;
  void apply_attributes(std::uint32_t object, std::uint32_t triangle, SurfacePoint& hit) const;
  double analytic_offset(const SurfacePoint& hit) const;
  InstanceTable table() const;

  EmbreeDevice device_;
  std::vector<std::unique_ptr<Prototype>> prototypes_;  ///< by template; null where it needs none
  TriangleSet triangles_;
  AnalyticSet analytic_;
  EmbreeScene scene_;  ///< null where everything is planes
  std::vector<PlaneObject> planes_;

  math::Point3 centre_m_;  ///< of the scene's bounds: Embree's origin
  Bounds bounds_{};
  Bounds padded_{};       ///< about the centre, widened
  double scale_m_ = 0.0;  ///< largest coordinate about the centre
  double window_m_ = 0.0;
  double triangle_offset_m_ = 0.0;

  // By object.
  std::vector<PlacedObject> objects_;
  std::vector<std::uint32_t> materials_of_;    ///< where an object's materials begin
  std::vector<std::uint32_t> first_triangle_;  ///< in triangles_; 0 in instances
  std::vector<std::uint32_t> first_analytic_;  ///< in analytic_; 0 in instances
  std::vector<std::uint32_t> analytic_count_;
  std::vector<std::uint32_t> attributes_of_;     ///< index into attributes_, or kNoIndex
  std::vector<std::uint32_t> attribute_map_of_;  ///< index into object_from_scene_
  // By Embree's instance number.
  std::vector<math::Transform> set_from_scene_;
  std::vector<std::uint32_t> instance_object_;

  std::vector<std::uint32_t> materials_;
  std::vector<Attributes> attributes_;
  std::vector<math::Transform> object_from_scene_;  ///< of objects with attributes
  std::size_t triangle_count_ = 0;
};

}  // namespace ifov::geometry
