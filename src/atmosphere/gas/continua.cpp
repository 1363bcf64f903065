#include "atmosphere/gas/continua.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "atmosphere/gas/oxygen_pairs.h"
#include "atmosphere/tables/table_text.h"

namespace ifov::data {
extern const std::string_view atmosphere_continua;
}

namespace ifov::atmosphere {
namespace {

constexpr double kBoltzmannCm1PerK = 0.6952;  ///< as the coefficients were made with
constexpr double kChappuisEndCm1 = 24370.0;

struct Table {
  std::vector<double> wavenumber;
  std::vector<std::vector<double>> columns;
  explicit Table(const TableSection& section, std::size_t count)
      : wavenumber(table_column(section, 0, count + 1)) {
    for (std::size_t c = 1; c <= count; ++c) columns.push_back(table_column(section, c, count + 1));
  }
  double at(std::size_t column, double wavenumber_cm1) const {
    return interpolate(wavenumber, columns[column], wavenumber_cm1, 0.0, 0.0);
  }
  bool covers(double wavenumber_cm1) const {
    return wavenumber_cm1 >= wavenumber.front() && wavenumber_cm1 <= wavenumber.back();
  }
};

struct Tables {
  std::vector<TableSection> sections = parse_table_text(data::atmosphere_continua);
  Table water{sections[0], 3}, nitrogen{sections[1], 1}, oxygen{sections[2], 3},
      ozone_visible{sections[3], 1}, ozone_ultraviolet{sections[4], 3}, nitrogen_dioxide{sections[5], 2};
};

const Tables& tables() {
  static const Tables all;
  return all;
}

double radiation_term(double nu, double temperature) {
  return nu * std::tanh(nu / (2.0 * kBoltzmannCm1PerK * temperature));
}

double far_wing(double nu) {
  const double low = 1.025 * 3.159e-8 * std::exp(-2.75e-4 * nu);
  const double high = 8.97e-6 * std::exp(-1.3e-3 * nu);
  return 1.0 / (1.0 / low + 1.0 / high);
}

double water_depth(double nu, const GasAmounts& amounts, GasModel model) {
  const Table& table = tables().water;
  if (!table.covers(nu)) return 0.0;
  constexpr double kWidth2 = 200.0 * 200.0;
  const double correction = 1.0 - 0.2333 * kWidth2 / ((nu - 1050.0) * (nu - 1050.0) + kWidth2);
  const double warm = correction * table.at(0, nu) * radiation_term(nu, 296.0);
  const double cold = correction * table.at(1, nu) * radiation_term(nu, 260.0);
  const double foreign =
      (table.at(2, nu) + far_wing_share(nu, model) * far_wing(nu)) * radiation_term(nu, 296.0);
  return 1e-20 * (warm * amounts.water_self + (cold - warm) * amounts.water_self_cold +
                  foreign * amounts.water_foreign);
}

/// Strength S (1 + A dT + (A^2/2 + B) dT^2) per volume of air, dT = T - 220 K.
double oxygen_depth(double nu, const GasAmounts& amounts) {
  const Table& table = tables().oxygen;
  if (!table.covers(nu) || amounts.oxygen <= 0.0) return 0.0;
  constexpr double kShareOfAir = 0.20946;
  const double linear = table.at(1, nu);
  const double square = 0.5 * linear * linear + table.at(2, nu);
  const double depth =
      table.at(0, nu) / kShareOfAir *
      (amounts.oxygen + linear * amounts.oxygen_temperature + square * amounts.oxygen_temperature_2);
  return std::max(depth, 0.0);
}

double ozone_depth(double nu, const GasAmounts& amounts) {
  if (nu <= kChappuisEndCm1) return tables().ozone_visible.at(0, nu) * amounts.ozone;
  const Table& table = tables().ozone_ultraviolet;
  constexpr double kMoleculesPerAtmCm = 0.269;
  return kMoleculesPerAtmCm * table.at(0, nu) *
         (amounts.ozone + table.at(1, nu) * amounts.ozone_temperature +
          table.at(2, nu) * amounts.ozone_temperature_2);
}

/// Cross-sections linear in temperature between 220 and 294 K, and beyond.
double nitrogen_dioxide_depth(double nu, const GasAmounts& amounts) {
  const Table& table = tables().nitrogen_dioxide;
  if (!table.covers(nu)) return 0.0;
  constexpr double kUnit = 1e-20 * 2.6867774e19, kBetween_K = 294.0 - 220.0;  // per atm-cm
  const double cold = table.at(0, nu), slope = (table.at(1, nu) - cold) / kBetween_K;
  return kUnit *
         std::max(0.0, cold * amounts.nitrogen_dioxide + slope * amounts.nitrogen_dioxide_temperature);
}

}  // namespace

double far_wing_share(double wavenumber_cm1, GasModel model) {
  if (model == GasModel::lowtran7) return 1.0;
  constexpr double kFullCm1 = 1250.0, kNoneCm1 = 1900.0;
  return std::clamp((kNoneCm1 - wavenumber_cm1) / (kNoneCm1 - kFullCm1), 0.0, 1.0);
}

ContinuumDepths continuum_depths(double wavenumber_cm1, const GasAmounts& amounts, GasModel model) {
  return {water_depth(wavenumber_cm1, amounts, model),
          tables().nitrogen.at(0, wavenumber_cm1) * amounts.nitrogen,
          oxygen_depth(wavenumber_cm1, amounts),
          model == GasModel::lowtran7 ? 0.0 : oxygen_pair_depth(wavenumber_cm1) * amounts.oxygen_pairs,
          ozone_depth(wavenumber_cm1, amounts),
          model == GasModel::lowtran7 ? 0.0 : nitrogen_dioxide_depth(wavenumber_cm1, amounts)};
}

}  // namespace ifov::atmosphere
