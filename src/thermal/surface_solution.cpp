#include "thermal/surface_solution.h"

#include <algorithm>

#include "thermal/faces/time_table.h"
#include "thermal/linear_kernel.h"
#include "thermal/solid.h"

namespace ifov::thermal {
namespace {

constexpr double kOneDay_s = 86400.0;

/// The mean gain over the first day of a series.
class MeanExchange : public SurfaceExchange {
 public:
  MeanExchange(const SurfaceBalance& balance, const OutdoorsSeries& series)
      : balance_(balance), series_(series), rows_(std::min(series.rows.size(), a_day(series.step_s))) {}

  SurfaceGain gain(double, double surface_k) const override {
    SurfaceGain mean;
    for (std::size_t i = 0; i < rows_; ++i) {
      const SurfaceGain one =
          balance_.gain(series_.begin_s + static_cast<double>(i) * series_.step_s, surface_k);
      mean.w_m2 += one.w_m2 / static_cast<double>(rows_);
      mean.slope_w_m2_k += one.slope_w_m2_k / static_cast<double>(rows_);
    }
    return mean;
  }

 private:
  static std::size_t a_day(double step_s) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(kOneDay_s / step_s));
  }

  const SurfaceBalance& balance_;
  const OutdoorsSeries& series_;
  std::size_t rows_;

 public:
  std::size_t rows() const { return rows_; }
};

void add(Fluxes& sum, const Fluxes& one, double weight) {
  sum.sun += weight * one.sun;
  sum.sky += weight * one.sky;
  sum.reflected += weight * one.reflected;
  sum.sky_longwave += weight * one.sky_longwave;
  sum.ground_longwave += weight * one.ground_longwave;
  sum.emitted += weight * one.emitted;
  sum.convection += weight * one.convection;
  sum.latent += weight * one.latent;
  sum.power += weight * one.power;
}

Fluxes mean_fluxes(const SurfaceBalance& balance, const History& history) {
  Fluxes mean;
  const double all_s = history.nodes.back().time_s - history.nodes.front().time_s;
  for (std::size_t i = 0; i + 1 < history.nodes.size(); ++i) {
    const SurfaceNode &stage = history.stages[i], &after = history.nodes[i + 1];
    const double share = (after.time_s - history.nodes[i].time_s) / all_s;
    add(mean, balance.fluxes(stage.time_s, stage.surface_k), share * (1.0 - kStage));
    add(mean, balance.fluxes(after.time_s, after.surface_k), share * kStage);
  }
  return mean;
}

}  // namespace

SurfaceSolution solve_surface(const Solid& solid, const Skin& skin, const Stand& stand,
                              const OutdoorsSeries& series, Start start, std::vector<double> visibility,
                              std::vector<double> free_sky, std::vector<FromBeside> beside) {
  Cells cells = cut_into_cells(solid);
  SurfaceBalance balance(series, skin, stand, std::move(visibility), std::move(free_sky), std::move(beside));
  const double air_k = series.rows.front().air.temperature_k;
  std::vector<double> start_k(cells.depth_m.size(), air_k);
  std::size_t start_rows = 0;
  double start_k_per_w_m2 = 0.0;
  if (start == Start::steady) {
    const MeanExchange mean(balance, series);
    if (cells.back_over_time)
      cells.back_temperature_k = cells.back_over_time->mean(
          series.begin_s, series.begin_s + static_cast<double>(mean.rows()) * series.step_s);
    const double conductance = whole_conductance_w_m2_k(cells);
    const double surface_k = balanced_temperature_k(mean, 0.0, conductance, cells.back_temperature_k, air_k);
    start_k = steady_cells_k(cells, surface_k);
    start_rows = mean.rows();
    start_k_per_w_m2 = 1.0 / (conductance - mean.gain(0.0, surface_k).slope_w_m2_k);
  }
  History history = conduct(cells, std::move(start_k), balance,
                            {series.begin_s, series.step_s, static_cast<int>(series.rows.size()) - 1});
  const Fluxes mean = mean_fluxes(balance, history);
  return {std::move(cells),   std::move(balance), std::move(history), mean,
          series.rows.size(), start_rows,         start_k_per_w_m2};
}

std::vector<double> kernel_by_row(const SurfaceSolution& solution) {
  const std::vector<SurfaceNode>& nodes = solution.history.nodes;
  std::vector<double> of_start;
  const std::vector<double> by_node =
      linear_kernel(solution.cells, solution.history, nodes.size() - 1, &of_start);
  std::vector<double> by_row(solution.rows, 0.0);
  const std::size_t first = solution.node_of_row(1);
  const double step_s = nodes[first].time_s - nodes[0].time_s;
  for (std::size_t i = 0; i < first; ++i) {
    const double share = (nodes[i].time_s - nodes[0].time_s) / step_s;
    by_row[0] += (1.0 - share) * by_node[i];
    by_row[1] += share * by_node[i];
  }
  for (std::size_t row = 1; row < solution.rows; ++row) by_row[row] += by_node[solution.node_of_row(row)];
  // The cells of a steady start by its surface: steady_cells_k().
  const double whole = whole_conductance_w_m2_k(solution.cells);
  double of_surface = 0.0, share = 1.0;
  for (std::size_t i = 0; i < of_start.size(); ++i) {
    share -= whole / solution.cells.conductance_w_m2_k[i];
    of_surface += share * of_start[i];
  }
  for (std::size_t row = 0; row < solution.start_rows; ++row)
    by_row[row] += of_surface * solution.start_k_per_w_m2 / static_cast<double>(solution.start_rows);
  return by_row;
}

}  // namespace ifov::thermal
