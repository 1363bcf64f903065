#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/world.h"

namespace ifov::geometry {

/// A world that repeats without end in x and y: the union of copies of one world, shifted by whole cells. A ray goes
/// from cell to cell; in each it meets the copies that reach into it, over just the part of the ray that lies there.
/// So nothing is approximated: objects may stand across the border of the cell, distances are those along the
/// unwrapped ray, and positions are where the copies are. Planes are of every copy alike. All copies of an object
/// bear its instance number.
class PeriodicWorld final : public World {
 public:
  struct Cell {
    double west_m = 0.0, south_m = 0.0;    ///< lower left corner
    double width_m = 0.0, height_m = 0.0;  ///< towards +x and +y
  };

  /// A ray that has crossed so many cells without meeting anything is taken to meet nothing.
  static constexpr int kMostCells = 4096;

  /// InputError where the cell has no size, or an object reaches further than 8 cells beyond it.
  PeriodicWorld(std::unique_ptr<World> world, Cell cell);

  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const override;
  /// Of the one world.
  Bounds bounds() const override { return world_->bounds(); }
  Heights heights() const override { return world_->heights(); }
  std::size_t object_count() const override { return world_->object_count(); }
  PlacedObject object(std::size_t number) const override { return world_->object(number); }
  bool has_corners(std::size_t number) const override { return world_->has_corners(number); }
  Storage storage() const override { return world_->storage(); }
  void visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const override {
    world_->visit_surfaces(wanted, visitor);
  }
  std::vector<double> surface_areas_m2(std::size_t materials) const override {
    return world_->surface_areas_m2(materials);
  }
  const SurfaceSurvey* survey() const override { return world_->survey(); }
  const SurfaceSurvey* lobe_survey() const override { return world_->lobe_survey(); }
  std::span<const Presence> presences() const override { return world_->presences(); }
  const Presence* presence(std::uint32_t object) const override { return world_->presence(object); }
  std::size_t triangle_count() const override { return world_->triangle_count(); }
  std::optional<Period> period() const override { return Period{cell_.width_m, cell_.height_m}; }

 private:
  /// A ray on its way.
  struct Walk {
    std::uint32_t ray = 0;
    int column = 0, row = 0;  ///< of the cell it is in
    int step_x = 0, step_y = 0;
    double begin_m = 0.0, end_m = 0.0;  ///< the part of the ray within this cell
    double last_m = 0.0;                ///< where it leaves the layer that holds everything
    int cells = 0;
  };
  bool start(const math::Ray& ray, std::uint32_t index, Walk& walk) const;
  bool advance(const math::Ray& ray, Walk& walk) const;
  void set_end(const math::Ray& ray, Walk& walk) const;
  using Meet = void (World::*)(std::span<const math::Ray>, std::span<SurfacePoint>) const;
  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits, Meet meet) const;
  /// Traces the parts of all walks through their cells, copy by copy; found(walk, shift, ...) for each.
  template <class Query>
  void each_copy(std::span<const math::Ray> rays, std::span<const Walk> walks, Query query) const;

  std::unique_ptr<World> world_;
  Cell cell_;
  double low_z_m_ = 0.0, high_z_m_ = 0.0;  ///< of everything, planes included
  /// Copies that reach into a cell, as offsets from its own.
  int first_column_ = 0, last_column_ = 0, first_row_ = 0, last_row_ = 0;
};

}  // namespace ifov::geometry
