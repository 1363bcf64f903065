#include "thermal/linear_kernel.h"

#include <optional>

#include "thermal/cells.h"
#include "thermal/conduction.h"
#include "thermal/tridiagonal.h"

namespace ifov::thermal {
namespace {

/// With the surface eliminated, what it gains more reaches the first cell as share * a - loss * T_0.
struct SurfacePart {
  double share = 0.0, loss_w_m2_k = 0.0;
};
SurfacePart surface_part(double conductance, double slope_w_m2_k) {
  const double outer = -slope_w_m2_k;
  return {conductance / (conductance + outer), conductance * outer / (conductance + outer)};
}

}  // namespace

std::vector<double> linear_kernel(const Cells& cells, const History& history, std::size_t now,
                                  std::vector<double>* of_start) {
  const double conductance = cells.conductance_w_m2_k[0];
  std::vector<double> kernel(now + 1, 0.0), weight(cells.depth_m.size(), 0.0), p;
  const double outer = -history.nodes[now].slope_w_m2_k;
  kernel[now] = 1.0 / (conductance + outer);
  weight[0] = conductance / (conductance + outer);
  std::optional<Tridiagonal> elimination;
  // Weights of what a stage ends with become those of what it began from; what it gains more counts with the first of the solution.
  const auto back = [&](const SurfaceNode& node, std::vector<double>& of_cells) {
    const SurfacePart surface = surface_part(conductance, node.slope_w_m2_k);
    elimination->solve_with_loss(surface.loss_w_m2_k, of_cells, p);
    const double of_gain = elimination->implicit_s() * surface.share * of_cells[0];
    for (std::size_t c = 0; c < of_cells.size(); ++c) of_cells[c] *= cells.capacity_j_m2_k[c];
    return of_gain;
  };
  constexpr double kOn = (1.0 - kStage) / kStage;  // as of conduct()
  std::vector<double> of_stage;
  for (std::size_t i = now; i-- > 0;) {
    const double implicit_s = kStage * (history.nodes[i + 1].time_s - history.nodes[i].time_s);
    if (!elimination || elimination->implicit_s() != implicit_s) elimination.emplace(cells, implicit_s);
    kernel[i + 1] += back(history.nodes[i + 1], weight);
    of_stage = weight;
    for (double& of_cell : of_stage) of_cell *= kOn;
    const double of_gain = back(history.stages[i], of_stage);
    kernel[i] += (1.0 - kStage) * of_gain;
    kernel[i + 1] += kStage * of_gain;
    for (std::size_t c = 0; c < weight.size(); ++c) weight[c] = (1.0 - kOn) * weight[c] + of_stage[c];
  }
  if (of_start != nullptr) *of_start = std::move(weight);
  return kernel;
}

}  // namespace ifov::thermal
