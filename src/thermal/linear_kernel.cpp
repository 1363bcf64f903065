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

/// In place: capacities plus explicit_s times the rates of the cells, the surface eliminated, times a vector.
void apply_old_rates(const Cells& cells, double explicit_s, double loss_w_m2_k, std::vector<double>& x) {
  const std::size_t count = x.size();
  double from_above = -loss_w_m2_k * x[0];
  for (std::size_t i = 0; i < count; ++i) {
    const double below = i + 1 < count ? cells.conductance_w_m2_k[i + 1] * (x[i] - x[i + 1])
                                       : cells.back_conductance_w_m2_k * x[i];
    x[i] = cells.capacity_j_m2_k[i] * x[i] + explicit_s * (from_above - below);
    from_above = below;
  }
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
  for (std::size_t i = now; i-- > 0;) {
    const double step_s = history.nodes[i + 1].time_s - history.nodes[i].time_s;
    const double implicit_s = history.implicit[i] * step_s, explicit_s = step_s - implicit_s;
    const SurfacePart before = surface_part(conductance, history.nodes[i].slope_w_m2_k),
                      after = surface_part(conductance, history.nodes[i + 1].slope_w_m2_k);
    if (!elimination || elimination->implicit_s() != implicit_s) elimination.emplace(cells, implicit_s);
    elimination->solve_with_loss(after.loss_w_m2_k, weight, p);
    kernel[i + 1] += implicit_s * after.share * weight[0];
    kernel[i] += explicit_s * before.share * weight[0];
    apply_old_rates(cells, explicit_s, before.loss_w_m2_k, weight);
  }
  if (of_start != nullptr) *of_start = std::move(weight);
  return kernel;
}

}  // namespace ifov::thermal
