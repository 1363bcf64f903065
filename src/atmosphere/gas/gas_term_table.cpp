#include "atmosphere/gas/gas_term_table.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/profile/column_integral.h"

namespace ifov::atmosphere {
namespace {

/// The interval of a monotonic list that holds a value, and how far into it the value lies; clamped.
std::pair<std::size_t, double> interval(const std::vector<double>& x, double value) {
  if (x.size() == 1) return {0, 0.0};
  const bool rises = x.back() > x.front();
  std::size_t i = 0;
  while (i + 2 < x.size() && (rises ? value > x[i + 1] : value < x[i + 1])) ++i;
  return {i, std::clamp((value - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0)};
}

}  // namespace

StateGrid::StateGrid(std::vector<double> pressure_hPa, std::vector<double> temperature_K)
    : pressure_hPa_(std::move(pressure_hPa)), temperature_K_(std::move(temperature_K)) {
  for (const double p : pressure_hPa_) log_pressure_.push_back(std::log(p));
  for (const double t : temperature_K_) inverse_temperature_.push_back(1.0 / t);
}

StateGrid::Place StateGrid::place(double pressure_hPa, double temperature_K) const {
  const auto [p, up] = interval(log_pressure_, std::log(pressure_hPa));
  const auto [t, warmer] = interval(inverse_temperature_, 1.0 / temperature_K);
  const std::size_t row = temperature_K_.size(), next_p = std::min(p + 1, pressure_hPa_.size() - 1),
                    next_t = std::min(t + 1, row - 1);
  return {{p * row + t, p * row + next_t, next_p * row + t, next_p * row + next_t},
          {(1.0 - up) * (1.0 - warmer), (1.0 - up) * warmer, up * (1.0 - warmer), up * warmer}};
}

bool StateGrid::holds(double pressure_hPa, double temperature_K) const {
  constexpr double kOfPressure = 1.01, kKelvin = 1.0;
  const bool thick_enough =
      pressure_hPa * kOfPressure >= pressure_hPa_.front() || pressure_hPa_.front() <= kThin_hPa;
  return thick_enough && pressure_hPa <= pressure_hPa_.back() * kOfPressure &&
         temperature_K >= temperature_K_.front() - kKelvin &&
         temperature_K <= temperature_K_.back() + kKelvin;
}

std::vector<double> TermBin::cross_sections(std::size_t gas, const StateGrid::Place& place) const {
  std::vector<double> k(terms());
  for (std::size_t t = 0; t < k.size(); ++t) {
    double sum = 0.0;
    for (std::size_t s = 0; s < 4; ++s)
      sum += place.weight[s] * static_cast<double>(log_k[gas][place.state[s] * k.size() + t]);
    k[t] = std::exp(sum);
  }
  return k;
}

float log_cross_section(double k_cm2) {
  return static_cast<float>(std::log(std::max(k_cm2, kNoAbsorption_cm2)));
}

std::optional<std::size_t> GasTermTable::bin_at(double wavenumber_cm1) const {
  if (!(wavenumber_cm1 > first_cm1 && wavenumber_cm1 < last_cm1())) return std::nullopt;
  return std::min(bins.size() - 1, static_cast<std::size_t>((wavenumber_cm1 - first_cm1) / step_cm1));
}

bool GasTermTable::depth_errors_known() const {
  return std::all_of(gases.begin(), gases.end(),
                     [](const TermGas& gas) { return gas.depth_error.has_value(); });
}

std::vector<LayerGas> layer_gas(const Profile& profile, const TermGas& gas,
                                const std::vector<double>& altitude_km) {
  const std::vector<double>& share = profile.of(gas.gas);
  std::vector<double> density, pressed, warm;
  for (std::size_t i = 0; i < profile.levels(); ++i) {
    const double x = 1e-6 * share[i];
    density.push_back(1e5 * x * profile.air_per_cm3(i));  // molecules cm-2 km-1
    pressed.push_back(density.back() * profile.pressure_hPa[i] * (1.0 + (gas.self_broadening - 1.0) * x));
    warm.push_back(density.back() * profile.temperature_K[i]);
  }
  std::vector<LayerGas> layers;
  for (std::size_t l = 0; l + 1 < altitude_km.size(); ++l) {
    const double low = altitude_km[l], high = altitude_km[l + 1], middle = 0.5 * (low + high);
    const auto over_layer = [&](const std::vector<double>& values) {
      return column_integral(profile.altitude_km, values, low, high);
    };
    const double molecules = over_layer(density);
    layers.push_back({molecules,
                      molecules > 0.0 ? over_layer(pressed) / molecules : profile.pressure_at(middle),
                      molecules > 0.0 ? over_layer(warm) / molecules : profile.temperature_at(middle)});
  }
  return layers;
}

OutsideGrid outside(const StateGrid& states, std::span<const LayerGas> layers,
                    const std::vector<double>& altitude_km) {
  OutsideGrid found;
  double all = 0.0, most = 0.0;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const LayerGas& layer = layers[l];
    all += layer.molecules_cm2;
    if (states.holds(layer.pressure_hPa, layer.temperature_K)) continue;
    found.share += layer.molecules_cm2;
    if (layer.molecules_cm2 <= most) continue;
    most = layer.molecules_cm2;
    found.altitude_km = 0.5 * (altitude_km[l] + altitude_km[l + 1]);
    found.pressure_hPa = layer.pressure_hPa;
    found.temperature_K = layer.temperature_K;
  }
  found.share = all > 0.0 ? found.share / all : 0.0;
  return found;
}

}  // namespace ifov::atmosphere
