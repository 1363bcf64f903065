#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/band_model.h"
#include "lowtran_output.h"
#include "measured.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_absorption_terms {
namespace {

std::set<double> exponents() {
  std::set<double> all;
  for (const Band& band : BandModel::instance().bands()) all.insert(band.a);
  return all;
}

double sum_of_terms(const AbsorptionTerms& terms, double x) {
  double sum = 0.0;
  for (std::size_t j = 0; j < terms.k.size(); ++j) sum += terms.weight[j] * std::exp(-terms.k[j] * x);
  return sum;
}

double largest_error(double a, const AbsorptionTerms& terms) {
  double largest = 0.0;
  for (double log_x = -7.0; log_x <= 3.0; log_x += 0.01) {
    const double x = std::pow(10.0, log_x);
    largest = std::max(largest, std::abs(sum_of_terms(terms, x) - std::exp(-std::pow(x, a))));
  }
  return largest;
}

TEST(AbsorptionTerms, AgainstTheClosedForm) {
  const std::map<int, double> tolerance{{8, 0.001}, {5, 0.005}, {3, 0.02}};
  for (const auto& [count, limit] : tolerance) {
    double worst = 0.0;
    for (const double a : exponents()) {
      const AbsorptionTerms& terms = absorption_terms(a, count);
      const double error = largest_error(a, terms);
      worst = std::max(worst, error);
      EXPECT_LT(error, limit) << count << " terms, a = " << a;
      EXPECT_NEAR(std::accumulate(terms.weight.begin(), terms.weight.end(), 0.0), 1.0, 1e-7);
      EXPECT_TRUE(std::is_sorted(terms.k.begin(), terms.k.end()));
    }
    RecordProperty("terms_" + std::to_string(count), format("{:.5f}", worst));
  }
  EXPECT_EQ(exponents().size(), 41u);
  // Terms of another exponent do not do.
  EXPECT_GT(largest_error(0.5274, absorption_terms(0.5464, 8)), 0.005);
}

/// Transmittance of a path that crosses the layers up to `layers`, `air_mass` times the vertical.
double path_transmittance(const AbsorptionSet& set, std::size_t layers, double air_mass) {
  double sum = 0.0;
  for (std::size_t j = 0; j < set.terms(); ++j) {
    double depth = 0.0;
    for (std::size_t l = 0; l < layers; ++l) depth += set.depth[j][l];
    sum += set.weight[j] * std::exp(-air_mass * depth);
  }
  return sum;
}

// Overlapping gases reduced to a few terms, for paths of all lengths from a low sensor to the slant path
// through all the air, against the product of the closed forms.
TEST(AbsorptionTerms, OverlapOfGasesAgainstTheProduct) {
  const AtmosphereColumn column(AtmosphereDescription{});
  const std::vector<double>& z = column.levels().altitude_km;
  const std::vector<GasAmounts> layers = layer_amounts(column.profile(), z);
  const auto below = [&](double km) {
    return static_cast<std::size_t>(std::find(z.begin(), z.end(), km) - z.begin());
  };
  struct Choice {
    int terms, most;
    double rms, largest;
  };
  for (const Choice& choice :
       {Choice{5, 8, 0.002, 0.010}, Choice{8, 16, 0.0005, 0.010}, Choice{8, 8, 0.002, 0.025}}) {
    ifov::test::Measured measured, without_second_gas;
    for (int nu = 700; nu <= 14500; nu += 15) {
      const AbsorptionSet set = line_absorption(nu, layers, GasModel::standard, choice.terms, choice.most);
      ASSERT_LE(set.terms(), static_cast<std::size_t>(choice.most));
      for (const auto& [count, air_mass] :
           std::map<std::size_t, double>{{below(1.0), 1.0}, {below(4.0), 1.2}, {layers.size(), 2.5}}) {
        GasAmounts path;
        for (std::size_t l = 0; l < count; ++l) path.add(layers[l], air_mass);
        double closed = 1.0, strongest = 1.0;
        for (const Gas gas : {Gas::h2o, Gas::co2, Gas::o3, Gas::n2o, Gas::co, Gas::ch4, Gas::o2, Gas::nh3,
                              Gas::no, Gas::no2, Gas::so2}) {
          const double t = line_transmittance(gas, nu, path, GasModel::standard);
          closed *= t;
          strongest = std::min(strongest, t);
        }
        measured.add(nu, path_transmittance(set, count, air_mass), closed);
        without_second_gas.add(nu, strongest, closed);
      }
    }
    const std::string name = format("{} terms, at most {}", choice.terms, choice.most);
    measured.record(format("terms_{}_most_{}", choice.terms, choice.most));
    EXPECT_LT(measured.rms(), choice.rms) << name << ": " << measured.text();
    EXPECT_LT(measured.largest(), choice.largest) << name << ": " << measured.text();
    EXPECT_GT(without_second_gas.rms(), 0.01);
  }
}

TEST(AbsorptionTerms, DepthsOfATermAddUpToTheGasOfTheLayers) {
  const AtmosphereColumn column(AtmosphereDescription{});
  const ColumnOptics optics = column.at(10600.0);
  const double weights = std::accumulate(optics.lines.weight.begin(), optics.lines.weight.end(), 0.0);
  EXPECT_NEAR(weights, 1.0, 1e-7);
  for (std::size_t j = 0; j < optics.terms(); ++j) {
    const LayerOptics layers = optics.term(j);
    ASSERT_EQ(layers.layers(), column.levels().layers());
    for (std::size_t l = 0; l < layers.layers(); ++l)
      EXPECT_EQ(layers.gas_absorption[l], optics.lines.depth[j][l] + optics.continuum[l]);
  }
}

}  // namespace
}  // namespace ifov::atmosphere::test_absorption_terms
