#pragma once

#include <vector>

#include "thermal/cells.h"

namespace ifov::thermal {

class SurfaceExchange;

/// The surface at one instant. `slope_w_m2_k`: of what it gains by its temperature.
struct SurfaceNode {
  double time_s = 0.0;
  double surface_k = 0.0;
  double into_solid_w_m2 = 0.0;
  double slope_w_m2_k = 0.0;
};

/// How a solid's surface went, step by step, and what became of the heat, J m-2. Step i leads from node i to node i + 1 by way of
/// stage i, which lies kStage of the step after node i.
struct History {
  std::vector<SurfaceNode> nodes, stages;
  std::vector<double> cells_k;  ///< at the last node
  double into_surface_j_m2 = 0.0, out_of_back_j_m2 = 0.0, stored_j_m2 = 0.0;
};
/// 1 - 1 / sqrt(2): the stage counts 1 - kStage of a step, its end the rest.
inline constexpr double kStage = 0.29289321881345254;

/// Steps from `begin_s` on. The first is cut into parts: two of them, then each as long as all before, kStartDoublings times, as
/// what is there at the beginning need not go with the gain.
struct Steps {
  double begin_s = 0.0;
  double step_s = 300.0;
  int count = 0;
};
inline constexpr int kStartDoublings = 7;

/// Heat conduction C dT/dt = div(k grad T) in cells, from the temperatures given for each cell, by steps of two implicit stages (Alexander
/// 1977): what a cell forgets within a step is gone after it, where Crank-Nicolson steps would let it swing for hours. The surface is a node
/// without mass, gain(T_s) = G (T_s - T_0), solved by Newton's method at each stage with the
/// cells below eliminated. Second order in step and cell. Throws InputError where no temperature of the surface is found.
History conduct(const Cells& cells, const std::vector<double>& start_k, const SurfaceExchange& exchange,
                const Steps& steps);

/// The temperature at a depth, between the cells' middles; the surface's own above the first.
double temperature_at_depth_k(const Cells& cells, const History& history, double depth_m);

/// The cells' temperatures at which heat passes steadily between the surface's temperature and the back.
std::vector<double> steady_cells_k(const Cells& cells, double surface_k);
/// The conductance from the surface to what is behind, W m-2 K-1; 0 where insulated.
double whole_conductance_w_m2_k(const Cells& cells);

}  // namespace ifov::thermal
