#include "thermal/conduction.h"

#include <algorithm>
#include <optional>

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
    note(conductance * (surface_k_ - start_k[0]));
  }

  void step(double step_s, double implicit) {
    if (!elimination_ || elimination_->implicit_s() != implicit * step_s)
      elimination_.emplace(cells_, implicit * step_s);
    explicit_part((1.0 - implicit) * step_s, implicit * step_s);
    const double back_before = back_flux();
    elimination_->eliminate(right_, p_);
    const double first = elimination_->first_factor();
    const double conductance = cells_.conductance_w_m2_k[0] * (1.0 - first);
    const double inner_k = first < 1.0 ? p_[0] / (1.0 - first) : surface_k_;
    time_s_ += step_s;
    surface_k_ = balanced_temperature_k(exchange_, time_s_, conductance, inner_k, surface_k_);
    elimination_->substitute(p_, surface_k_, cells_k_);
    const double flux_before = history_.nodes.back().into_solid_w_m2;
    note(cells_.conductance_w_m2_k[0] * (surface_k_ - cells_k_[0]));
    history_.implicit.push_back(implicit);
    history_.into_surface_j_m2 +=
        step_s * (implicit * history_.nodes.back().into_solid_w_m2 + (1.0 - implicit) * flux_before);
    history_.out_of_back_j_m2 += step_s * (implicit * back_flux() + (1.0 - implicit) * back_before);
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
  double back_flux() const {
    return cells_.back_conductance_w_m2_k * (cells_k_.back() - cells_.back_temperature_k);
  }

  void explicit_part(double explicit_s, double implicit_s) {
    const std::size_t count = cells_k_.size();
    double from_above = history_.nodes.back().into_solid_w_m2;
    for (std::size_t i = 0; i < count; ++i) {
      const double below =
          i + 1 < count ? cells_.conductance_w_m2_k[i + 1] * (cells_k_[i] - cells_k_[i + 1]) : back_flux();
      right_[i] = cells_.capacity_j_m2_k[i] * cells_k_[i] + explicit_s * (from_above - below);
      from_above = below;
    }
    right_.back() += implicit_s * cells_.back_conductance_w_m2_k * cells_.back_temperature_k;
  }

  void note(double into_solid_w_m2) {
    history_.nodes.push_back(
        {time_s_, surface_k_, into_solid_w_m2, exchange_.gain(time_s_, surface_k_).slope_w_m2_k});
  }

  const Cells& cells_;
  const SurfaceExchange& exchange_;
  std::vector<double> cells_k_, right_, p_;
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
      marcher.step(steps.step_s, 0.5);
    } else {
      double part_s = steps.step_s / (1 << kStartDoublings);
      for (int k = 0; k < 2; ++k) marcher.step(0.5 * part_s, 1.0);
      for (int k = 0; k < kStartDoublings; ++k, part_s *= 2.0) marcher.step(part_s, 0.5);
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
