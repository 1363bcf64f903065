#include "atmosphere/gas/band_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "atmosphere/tables/table_text.h"

namespace ifov::data {
extern const std::string_view atmosphere_gas_bands;
extern const std::string_view atmosphere_absorption_terms;
}  // namespace ifov::data

namespace ifov::atmosphere {
namespace {

Gas gas_named(const std::string& name) {
  return static_cast<Gas>(std::find(kGasNames.begin(), kGasNames.end(), name) - kGasNames.begin());
}

using TermKey = std::pair<long, int>;  // a times 1e4, number of terms

std::map<TermKey, AbsorptionTerms> read_terms() {
  std::map<TermKey, AbsorptionTerms> all;
  for (const TableSection& section : parse_table_text(data::atmosphere_absorption_terms))
    all[{std::lround(1e4 * std::stod(section.words[1])), std::stoi(section.words[2])}] = {
        table_column(section, 0, 2), table_column(section, 1, 2), std::stod(section.words[3])};
  return all;
}

}  // namespace

BandModel::BandModel() {
  for (const TableSection& section : parse_table_text(data::atmosphere_gas_bands)) {
    Band band;
    band.gas = gas_named(section.words[1]);
    band.first_cm1 = std::stoi(section.words[2]);
    band.last_cm1 = std::stoi(section.words[3]);
    band.a = std::stod(section.words[4]);
    band.n = std::stod(section.words[5]);
    band.m = std::stod(section.words[6]);
    for (const double c : section.values) band.coefficient.push_back(std::pow(10.0, 1e-5 * c));
    bands_.push_back(std::move(band));
  }
}

const BandModel& BandModel::instance() {
  static const BandModel model;
  return model;
}

int band_grid_cm1(double wavenumber_cm1) { return 5 * static_cast<int>(std::lround(wavenumber_cm1 / 5.0)); }

const AbsorptionTerms& absorption_terms(double a, int count) {
  static const std::map<TermKey, AbsorptionTerms> all = read_terms();
  return all.at({std::lround(1e4 * a), count});
}

}  // namespace ifov::atmosphere
