#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "landscape/plots/plot_plan.h"
#include "landscape/streets/street_plan.h"

namespace ifov::landscape {

/// Wooden poles on the verge at the left of a street, with three wires on a crossarm and a fourth below.
struct PowerLine {
  std::vector<Stand> poles;  ///< `inward` along the line
};

PowerLine plan_power_line(const Street& street, std::span<const Plot> plots, double half_m);

/// One pole at the origin, 10.5 m high, the line along y. Slots: pole, insulator, steel.
geometry::TriangleMesh pole_mesh();
/// All wires between the poles, which hang as parabolas; `ground_m` is the height of the poles' feet. Slot: wire.
geometry::TriangleMesh wire_mesh(const PowerLine& line, double ground_m);

}  // namespace ifov::landscape
