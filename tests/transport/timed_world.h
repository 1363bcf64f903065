#pragma once

#include <map>
#include <memory>
#include <utility>

#include "geometry/world.h"

namespace ifov::test {

/// A world that counts the rays it is asked for by their time.
class TimedWorld final : public geometry::World {
 public:
  struct Counts {
    std::map<double, std::size_t> intersected, occluded;
  };

  TimedWorld(std::unique_ptr<geometry::World> world, Counts& counts)
      : world_(std::move(world)), counts_(counts) {}

  void intersect(std::span<const math::Ray> rays, std::span<geometry::SurfacePoint> hits) const override {
    for (const math::Ray& ray : rays) ++counts_.intersected[ray.time_s];
    world_->intersect(rays, hits);
  }
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const override {
    for (const math::Ray& ray : rays) ++counts_.occluded[ray.time_s];
    world_->occluded(rays, blocked);
  }
  Bounds bounds() const override { return world_->bounds(); }
  Heights heights() const override { return world_->heights(); }
  std::size_t object_count() const override { return world_->object_count(); }
  PlacedObject object(std::size_t number) const override { return world_->object(number); }
  bool has_corners(std::size_t number) const override { return world_->has_corners(number); }
  void visit_surfaces(const geometry::WantedMaterials& wanted,
                      const geometry::PieceVisitor& visitor) const override {
    world_->visit_surfaces(wanted, visitor);
  }
  std::vector<double> surface_areas_m2(std::size_t materials) const override {
    return world_->surface_areas_m2(materials);
  }
  std::size_t triangle_count() const override { return world_->triangle_count(); }
  Storage storage() const override { return world_->storage(); }
  const geometry::SurfaceSurvey* survey() const override { return world_->survey(); }
  std::optional<Period> period() const override { return world_->period(); }

 private:
  std::unique_ptr<geometry::World> world_;
  Counts& counts_;
};

}  // namespace ifov::test
