#pragma once

#include <memory>
#include <vector>

#include "geometry/cut_out.h"

namespace ifov::materials {
class ClassMap;
class NumberedMap;
struct MapGrid;
struct MapPosition;
class OpacityMap;
}  // namespace ifov::materials

namespace ifov::scene {

/// The holes of a surface assignment: those of its material, or where a map of classes says which material there is, of that one.
class SurfaceCutOut final : public geometry::CutOut {
 public:
  /// `holes`: by class index of the map, one without a map; null: a material without holes. `classes` may be null.
  SurfaceCutOut(std::shared_ptr<const materials::ClassMap> classes,
                std::vector<std::shared_ptr<const materials::OpacityMap>> holes);
  bool is_open(math::Point3 position_m, double u, double v) const override;
  bool is_open(const materials::MapPosition& position) const;
  void add_maps(std::vector<const materials::NumberedMap*>& maps) const;
  /// Of the first material with holes.
  const materials::MapGrid& grid() const;

 private:
  std::shared_ptr<const materials::ClassMap> classes_;
  std::vector<std::shared_ptr<const materials::OpacityMap>> holes_;
};

struct Scene;
/// By surface assignment, for geometry::BuildOptions; empty where none has holes.
std::vector<std::shared_ptr<const geometry::CutOut>> cut_outs(const Scene& scene);

}  // namespace ifov::scene
