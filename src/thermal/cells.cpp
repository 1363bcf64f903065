#include "thermal/cells.h"

#include <algorithm>
#include <cmath>

#include "core/overloaded.h"
#include "thermal/solid.h"

namespace ifov::thermal {
namespace {

/// Depth in daily depths by the number of cells above it, x(s) = first (growth^s - 1) / (growth - 1), and back.
class DepthCurve {
 public:
  explicit DepthCurve(const CellSizes& sizes) : first_(sizes.first_daily_depths), growth_(sizes.growth) {}
  double depth(double cells) const {
    return first_ * std::expm1(cells * std::log(growth_)) / (growth_ - 1.0);
  }
  double cells(double depth) const {
    return std::log1p(depth * (growth_ - 1.0) / first_) / std::log(growth_);
  }

 private:
  double first_, growth_;
};

double in_series(double a, double b) { return a * b / (a + b); }

std::vector<SolidLayer> with_ground(const Solid& solid) {
  std::vector<SolidLayer> layers = solid.layers;
  if (!std::holds_alternative<DeepGround>(solid.back)) return layers;
  double deep = 0.0;
  for (const SolidLayer& layer : layers) deep += layer.thickness_m / daily_depth_m(layer);
  layers.back().thickness_m += std::max(0.0, kGroundDepths - deep) * daily_depth_m(layers.back());
  return layers;
}

}  // namespace

Cells cut_into_cells(const Solid& solid, const CellSizes& sizes) {
  check(solid);
  const DepthCurve curve(sizes);
  Cells cells;
  double layer_depths = 0.0, layer_m = 0.0, half_above = 0.0;
  for (const SolidLayer& layer : with_ground(solid)) {
    const double daily_m = daily_depth_m(layer);
    const double begin = curve.cells(layer_depths),
                 end = curve.cells(layer_depths + layer.thickness_m / daily_m);
    const int count = sizes.parts * std::max(1, static_cast<int>(std::ceil(end - begin - 1e-9)));
    const auto border_m = [&](int i) {
      return (curve.depth(begin + (end - begin) * i / count) - layer_depths) * daily_m;
    };
    for (int i = 0; i < count; ++i) {
      const double top_m = border_m(i), size_m = border_m(i + 1) - top_m;
      const double half = 2.0 * layer.conductivity_w_m_k / size_m;
      cells.depth_m.push_back(layer_m + top_m + 0.5 * size_m);
      cells.capacity_j_m2_k.push_back(layer.density_kg_m3 * layer.specific_heat_j_kg_k * size_m);
      cells.conductance_w_m2_k.push_back(half_above > 0.0 ? in_series(half_above, half) : half);
      half_above = half;
    }
    if (layer.gap_behind_m2_k_w > 0.0) half_above = in_series(half_above, 1.0 / layer.gap_behind_m2_k_w);
    layer_depths += layer.thickness_m / daily_m;
    layer_m += layer.thickness_m;
  }
  const auto held = [&](double temperature_k, double conductance,
                        const std::shared_ptr<const TimeTable>& over_time = {}) {
    cells.back_temperature_k = temperature_k;
    cells.back_over_time = over_time;
    cells.back_conductance_w_m2_k = conductance;
  };
  std::visit(
      Overloaded{[](const Insulated&) {}, [](const OtherFace&) {},
                 [&](const HeldBack& back) { held(back.temperature_k, half_above, back.over_time); },
                 [&](const RoomAir& room) {
                   held(room.temperature_k,
                        room.conductance_w_m2_k > 0.0 ? in_series(half_above, room.conductance_w_m2_k) : 0.0,
                        room.over_time);
                 },
                 [&](const DeepGround& ground) { held(ground.temperature_k, half_above); }},
      solid.back);
  return cells;
}

}  // namespace ifov::thermal
