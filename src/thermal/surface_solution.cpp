#include "thermal/surface_solution.h"

#include <algorithm>

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
};

std::vector<double> start_temperatures(const Cells& cells, const SurfaceBalance& balance,
                                       const OutdoorsSeries& series, Start start) {
  const double air_k = series.rows.front().air.temperature_k;
  if (start == Start::air) return std::vector<double>(cells.depth_m.size(), air_k);
  return steady_cells_k(
      cells, balanced_temperature_k(MeanExchange(balance, series), 0.0, whole_conductance_w_m2_k(cells),
                                    cells.back_temperature_k, air_k));
}

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
    const SurfaceNode &before = history.nodes[i], &after = history.nodes[i + 1];
    const double share = (after.time_s - before.time_s) / all_s;
    add(mean, balance.fluxes(before.time_s, before.surface_k), share * (1.0 - history.implicit[i]));
    add(mean, balance.fluxes(after.time_s, after.surface_k), share * history.implicit[i]);
  }
  return mean;
}

}  // namespace

SurfaceSolution solve_surface(const Solid& solid, const Skin& skin, const Stand& stand,
                              const OutdoorsSeries& series, Start start, std::vector<double> visibility) {
  Cells cells = cut_into_cells(solid);
  SurfaceBalance balance(series, skin, stand, std::move(visibility));
  History history = conduct(cells, start_temperatures(cells, balance, series, start), balance,
                            {series.begin_s, series.step_s, static_cast<int>(series.rows.size()) - 1});
  const Fluxes mean = mean_fluxes(balance, history);
  return {std::move(cells), std::move(balance), std::move(history), mean, series.rows.size()};
}

}  // namespace ifov::thermal
