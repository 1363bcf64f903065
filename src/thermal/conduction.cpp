#include "thermal/conduction.h"

#include <algorithm>
#include <optional>

#include "thermal/faces/time_table.h"
#include "thermal/surface_exchange.h"
#include "thermal/tridiagonal.h"

namespace ifov::thermal {
namespace {

/// The march of one solid: temperatures of cells and surface, and the heat that passed.
class Marcher {
 public:
  Marcher(const Cells& cells, const std::vector<double>& start_k, const SurfaceExchange& exchange,
          double begin_s)
      : cells_(cells), exchange_(exchange), cells_k_(start_k), right_(start_k.size()), time_s_(begin_s) {
    const double conductance = cells.conductance_w_m2_k[0];
    surface_k_ = balanced_temperature_k(exchange, begin_s, conductance, start_k[0], start_k[0]);
    history_.nodes.push_back(now());
  }

  void step(double step_s) {
    // u_1 = y + c h f(u_1), u_2 = y + (1 - c) h f(u_1) + c h f(u_2) with c = kStage.
    constexpr double kOn = (1.0 - kStage) / kStage;
    const double implicit_s = kStage * step_s, begin_s = time_s_;
    if (!elimination_ || elimination_->implicit_s() != implicit_s) elimination_.emplace(cells_, implicit_s);
    before_k_ = cells_k_;
    backward(begin_s + implicit_s);
    history_.stages.push_back(now());
    pass((1.0 - kStage) * step_s);
    for (std::size_t i = 0; i < cells_k_.size(); ++i)
      cells_k_[i] = before_k_[i] + kOn * (cells_k_[i] - before_k_[i]);
    backward(begin_s + step_s);
    history_.nodes.push_back(now());
    pass(implicit_s);
  }

  /// Times are sums of many steps; those of whole steps are set.
  void at(double time_s) { history_.nodes.back().time_s = time_s_ = time_s; }

  History finish(const std::vector<double>& start_k) {
    for (std::size_t i = 0; i < cells_k_.size(); ++i)
      history_.stored_j_m2 += cells_.capacity_j_m2_k[i] * (cells_k_[i] - start_k[i]);
    history_.cells_k = std::move(cells_k_);
    return std::move(history_);
  }

 private:
  /// What lies behind, now.
  double behind_k() const {
    return cells_.back_over_time ? cells_.back_over_time->at(time_s_) : cells_.back_temperature_k;
  }

  double back_flux() const { return cells_.back_conductance_w_m2_k * (cells_k_.back() - behind_k()); }

  /// Of what the cells hold, by rates of that time over implicit_s().
  void backward(double time_s) {
    const double implicit_s = elimination_->implicit_s();
    for (std::size_t i = 0; i < cells_k_.size(); ++i) right_[i] = cells_.capacity_j_m2_k[i] * cells_k_[i];
    time_s_ = time_s;
    right_.back() += implicit_s * cells_.back_conductance_w_m2_k * behind_k();
    elimination_->eliminate(right_, p_);
    const double first = elimination_->first_factor();
    const double conductance = cells_.conductance_w_m2_k[0] * (1.0 - first);
    const double inner_k = first < 1.0 ? p_[0] / (1.0 - first) : surface_k_;
    surface_k_ = balanced_temperature_k(exchange_, time_s, conductance, inner_k, surface_k_);
    elimination_->substitute(p_, surface_k_, cells_k_);
  }

  /// Heat at the rates of now.
  void pass(double for_s) {
    history_.into_surface_j_m2 += for_s * into_solid_w_m2();
    history_.out_of_back_j_m2 += for_s * back_flux();
  }

  double into_solid_w_m2() const { return cells_.conductance_w_m2_k[0] * (surface_k_ - cells_k_[0]); }

  SurfaceNode now() const {
    return {time_s_, surface_k_, into_solid_w_m2(), exchange_.gain(time_s_, surface_k_).slope_w_m2_k};
  }

  const Cells& cells_;
  const SurfaceExchange& exchange_;
  std::vector<double> cells_k_, before_k_, right_, p_;
  double time_s_, surface_k_ = 0.0;
  std::optional<Tridiagonal> elimination_;
  History history_;
};

}  // namespace

History conduct(const Cells& cells, const std::vector<double>& start_k, const SurfaceExchange& exchange,
                const Steps& steps) {
  Marcher marcher(cells, start_k, exchange, steps.begin_s);
  for (int i = 0; i < steps.count; ++i) {
    if (i > 0) {
      marcher.step(steps.step_s);
    } else {
      double part_s = steps.step_s / (1 << kStartDoublings);
      for (int k = 0; k < 2; ++k) marcher.step(0.5 * part_s);
      for (int k = 0; k < kStartDoublings; ++k, part_s *= 2.0) marcher.step(part_s);
    }
    marcher.at(steps.begin_s + (i + 1) * steps.step_s);
  }
  return marcher.finish(start_k);
}

double temperature_at_depth_k(const Cells& cells, const History& history, double depth_m) {
  const std::vector<double>& depth = cells.depth_m;
  const auto below = std::upper_bound(depth.begin(), depth.end(), depth_m);
  if (below == depth.end()) return history.cells_k.back();
  const auto i = static_cast<std::size_t>(below - depth.begin());
  const double above_m = i > 0 ? depth[i - 1] : 0.0;
  const double above_k = i > 0 ? history.cells_k[i - 1] : history.nodes.back().surface_k;
  return above_k + (history.cells_k[i] - above_k) * (depth_m - above_m) / (depth[i] - above_m);
}

double whole_conductance_w_m2_k(const Cells& cells) {
  if (!(cells.back_conductance_w_m2_k > 0.0)) return 0.0;
  double resistance = 1.0 / cells.back_conductance_w_m2_k;
  for (const double conductance : cells.conductance_w_m2_k) resistance += 1.0 / conductance;
  return 1.0 / resistance;
}

std::vector<double> steady_cells_k(const Cells& cells, double surface_k) {
  const double flux = whole_conductance_w_m2_k(cells) * (surface_k - cells.back_temperature_k);
  std::vector<double> result;
  double above_k = surface_k;
  for (const double conductance : cells.conductance_w_m2_k) result.push_back(above_k -= flux / conductance);
  return result;
}

}  // namespace ifov::thermal
