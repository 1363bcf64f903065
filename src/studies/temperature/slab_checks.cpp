#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <sstream>

#include "io/files/input_file.h"
#include "studies/temperature/temperature_checks.h"
#include "thermal/cells.h"
#include "thermal/conduction.h"
#include "thermal/solid.h"
#include "thermal/surface_exchange.h"

namespace ifov::studies {
namespace {

constexpr double kBase_k = 300.0, kDay_s = 86400.0, kOmega = 2.0 * std::numbers::pi / kDay_s;
constexpr double kWave_w_m2 = 400.0, kStep_w_m2 = 500.0, kAirStep_w_m2_k = 20.0, kAirStep_k = 10.0,
                 kWaveAir_w_m2_k = 15.0;
constexpr std::array<double, 4> kDepths_m{0.0, 0.01, 0.05, 0.1};

thermal::SolidLayer reference_concrete(double thickness_m) { return {thickness_m, 1.4, 2300.0, 880.0}; }

/// flux(t) + h (outer - T).
class GivenExchange final : public thermal::SurfaceExchange {
 public:
  GivenExchange(std::function<double(double)> flux_w_m2, double h_w_m2_k = 0.0, double outer_k = 0.0)
      : flux_(std::move(flux_w_m2)), h_(h_w_m2_k), outer_k_(outer_k) {}
  thermal::SurfaceGain gain(double time_s, double surface_k) const override {
    return {flux_(time_s) + h_ * (outer_k_ - surface_k), -h_};
  }

 private:
  std::function<double(double)> flux_;
  double h_, outer_k_;
};

GivenExchange exchange_of(SlabCase of) {
  const auto wave = [](double t) { return kWave_w_m2 * std::cos(kOmega * t); };
  const auto nothing = [](double) { return 0.0; };
  switch (of) {
    case SlabCase::periodic_flux: return {wave};
    case SlabCase::step_flux: return {[](double) { return kStep_w_m2; }};
    case SlabCase::air_step: return {nothing, kAirStep_w_m2_k, kBase_k + kAirStep_k};
    case SlabCase::periodic_flux_in_air: break;
  }
  return {wave, kWaveAir_w_m2_k, kBase_k};
}

/// A wave exp(i omega t) through layers from the insulated back to the surface: its temperature for a flux of 1.
std::complex<double> wave_through(const std::vector<thermal::SolidLayer>& layers) {
  std::complex<double> temperature = 1.0, flux = 0.0;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const std::complex<double> q = std::complex<double>(1.0, 1.0) / thermal::daily_depth_m(*layer);
    const std::complex<double> x = q * layer->thickness_m, kq = layer->conductivity_w_m_k * q;
    const std::complex<double> above = std::cosh(x) * temperature + std::sinh(x) / kq * flux;
    flux = kq * std::sinh(x) * temperature + std::cosh(x) * flux;
    temperature = above;
  }
  return temperature / flux;
}

double lowest_order(const std::vector<double>& errors) {
  double lowest = INFINITY;
  for (std::size_t i = 1; i < errors.size(); ++i)
    lowest = std::min(lowest, std::log2(errors[i - 1] / errors[i]));
  return lowest;
}

std::vector<double> wave_start(const thermal::Cells& cells) {
  std::vector<double> start;
  for (const double depth_m : cells.depth_m)
    start.push_back(kBase_k + closed_form_k(SlabCase::periodic_flux, 0.0, depth_m));
  return start;
}

/// The surface under the wave after three quarters of a day.
double wave_surface_k(const thermal::CellSizes& sizes, double step_s) {
  const thermal::Cells cells =
      thermal::cut_into_cells({{reference_concrete(0.1)}, thermal::DeepGround{kBase_k}}, sizes);
  const thermal::History history =
      thermal::conduct(cells, wave_start(cells), exchange_of(SlabCase::periodic_flux),
                       {0.0, step_s, static_cast<int>(0.75 * kDay_s / step_s)});
  return history.nodes.back().surface_k;
}

}  // namespace

const char* name_of(SlabCase of) {
  constexpr std::array<const char*, kSlabCases> kNames{"periodic_flux", "step_flux", "convective_step",
                                                       "periodic_flux_with_h15"};
  return kNames[static_cast<std::size_t>(of)];
}

double closed_form_k(SlabCase of, double time_s, double depth_m) {
  const thermal::SolidLayer solid = reference_concrete(1.0);
  const double k = solid.conductivity_w_m_k,
               diffusivity = k / (solid.density_kg_m3 * solid.specific_heat_j_kg_k),
               inertia = thermal::thermal_inertia(solid), depths = depth_m / thermal::daily_depth_m(solid);
  const double root = std::sqrt(diffusivity * time_s), z = depth_m / (2.0 * root);
  switch (of) {
    case SlabCase::periodic_flux:
      return kWave_w_m2 / (inertia * std::sqrt(kOmega)) * std::exp(-depths) *
             std::cos(kOmega * time_s - depths - 0.25 * std::numbers::pi);
    case SlabCase::step_flux:
      return 2.0 * kStep_w_m2 * std::sqrt(time_s / std::numbers::pi) / inertia * std::exp(-z * z) -
             kStep_w_m2 * depth_m / k * std::erfc(z);
    case SlabCase::air_step: {
      const double h = kAirStep_w_m2_k / k;
      return kAirStep_k *
             (std::erfc(z) - std::exp(h * depth_m + h * h * root * root) * std::erfc(z + h * root));
    }
    case SlabCase::periodic_flux_in_air: break;
  }
  const double b = inertia * std::sqrt(0.5 * kOmega);
  return kWave_w_m2 / std::hypot(kWaveAir_w_m2_k + b, b) * std::exp(-depths) *
         std::cos(kOmega * time_s - depths - std::atan2(b, kWaveAir_w_m2_k + b));
}

double slab_error_k(SlabCase of, double step_s, double conductivity_factor) {
  thermal::SolidLayer solid = reference_concrete(0.1);
  solid.conductivity_w_m_k *= conductivity_factor;
  const thermal::Cells cells = thermal::cut_into_cells({{solid}, thermal::DeepGround{kBase_k}});
  std::vector<double> start(cells.depth_m.size(), kBase_k);
  const GivenExchange exchange = exchange_of(of);
  if (of == SlabCase::periodic_flux) start = wave_start(cells);
  if (of == SlabCase::periodic_flux_in_air)  // ten days make any start forgotten
    start = thermal::conduct(cells, start, exchange,
                             {-10.0 * kDay_s, step_s, static_cast<int>(10.0 * kDay_s / step_s)})
                .cells_k;
  const bool wave = of == SlabCase::periodic_flux || of == SlabCase::periodic_flux_in_air;
  const std::vector<double> times_s =
      wave ? std::vector<double>{10800.0, 21600.0, 32400.0, 43200.0, 54000.0, 64800.0, 75600.0}
           : std::vector<double>{600.0, 3600.0, 21600.0};
  double worst_k = 0.0;
  for (const double time_s : times_s) {
    if (std::fmod(time_s, step_s) != 0.0) continue;
    const int steps = static_cast<int>(std::round(time_s / step_s));
    const thermal::History history = thermal::conduct(cells, start, exchange, {0.0, step_s, steps});
    for (const double depth_m : kDepths_m)
      worst_k = std::max(worst_k, std::abs(thermal::temperature_at_depth_k(cells, history, depth_m) -
                                           kBase_k - closed_form_k(of, time_s, depth_m)));
  }
  return worst_k;
}

FileDifference closed_forms_off_file(const std::filesystem::path& file) {
  FileDifference result;
  std::istringstream in(io::read_input(file));
  for (std::string line; std::getline(in, line);)
    for (int k = 0; k < kSlabCases; ++k) {
      const auto of = static_cast<SlabCase>(k);
      const std::string begin = std::string(name_of(of)) + ",";
      if (line.rfind(begin, 0) != 0) continue;
      std::stringstream row(line.substr(line.find(',', begin.size()) + 1));
      double time_s = 0.0, depth_m = 0.0, told_k = 0.0;
      char comma = ' ';
      row >> time_s >> comma >> depth_m >> comma >> told_k;
      result.worst_k = std::max(result.worst_k, std::abs(told_k - closed_form_k(of, time_s, depth_m)));
      ++result.rows;
    }
  return result;
}

double layered_error_k(double step_s, double capacity_factor) {
  constexpr double kFlux_w_m2 = 100.0;
  constexpr int kDays = 40;
  const std::vector<thermal::SolidLayer> road{{0.06, 0.75, 2360.0, 920.0}, {0.25, 0.30, 1600.0, 800.0}},
      wall{{0.01, 0.72, 1860.0, 780.0}, {0.05, 0.035, 30.0, 1400.0}, reference_concrete(0.2)};
  double worst_k = 0.0;
  for (const auto& layers : {road, wall}) {
    std::vector<thermal::SolidLayer> solved = layers;
    solved.back().specific_heat_j_kg_k *= capacity_factor;
    const thermal::Cells cells = thermal::cut_into_cells({solved, thermal::Insulated{}});
    const GivenExchange exchange([](double t) { return kFlux_w_m2 * std::sin(kOmega * t); });
    const thermal::History history =
        thermal::conduct(cells, std::vector<double>(cells.depth_m.size(), kBase_k), exchange,
                         {0.0, step_s, static_cast<int>(kDays * kDay_s / step_s)});
    // What the start left behind is a constant: that of no heat since.
    const auto a_day = static_cast<std::size_t>(kDay_s / step_s);
    const std::size_t last = history.nodes.size() - a_day;
    double mean_k = 0.0;
    for (std::size_t i = last; i < history.nodes.size(); ++i)
      mean_k += history.nodes[i].surface_k / static_cast<double>(a_day);
    const std::complex<double> wave = kFlux_w_m2 * wave_through(layers);
    for (std::size_t i = last; i < history.nodes.size(); ++i)
      worst_k =
          std::max(worst_k, std::abs(history.nodes[i].surface_k - mean_k -
                                     (wave * std::polar(1.0, kOmega * history.nodes[i].time_s)).imag()));
  }
  return worst_k;
}

double order_in_cells() {
  const double expected_k = kBase_k + closed_form_k(SlabCase::periodic_flux, 0.75 * kDay_s, 0.0);
  std::vector<double> errors_k;
  for (const int parts : {1, 2, 4, 8})
    errors_k.push_back(std::abs(wave_surface_k({1.0 / 20.0, 1.2, parts}, 30.0) - expected_k));
  return lowest_order(errors_k);
}

double order_in_steps() {
  const double expected_k = wave_surface_k({}, 5.0);
  std::vector<double> errors_k;
  for (const double step_s : {3600.0, 1800.0, 900.0, 450.0})
    errors_k.push_back(std::abs(wave_surface_k({}, step_s) - expected_k));
  return lowest_order(errors_k);
}

}  // namespace ifov::studies
