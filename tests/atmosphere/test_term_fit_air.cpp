// Terms of Voigt lines through the air, where pressure and temperature change along the path, against line by line.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/column_terms.h"
#include "atmosphere/gas/term_fit.h"
#include "measured.h"
#include "synthetic_lines.h"

namespace ifov::atmosphere::test_term_fit_air {
namespace {

constexpr double kFrom_cm1 = 4300.0, kStep_cm1 = 1.0, kWater_u = 18.0;
constexpr std::size_t kBins = 12;

const StateGrid kStates({0.3, 1.0, 3.0, 10.0, 30.0, 70.0, 130.0, 220.0, 350.0, 500.0, 700.0, 900.0, 1080.0},
                        {190.0, 215.0, 245.0, 275.0, 310.0});

TermFit fit_of(std::size_t most_terms = 16) {
  TermFit fit{kFrom_cm1, kStep_cm1, kBins};
  fit.most_terms = most_terms;
  return fit;
}

std::vector<test::Line> lines() { return test::random_lines(60, kFrom_cm1 - 10.0, kFrom_cm1 + 22.0, 7); }

const GasSpectra& spectra() {
  static const GasSpectra made = test::spectra_of(Gas::h2o, lines(), kWater_u, kFrom_cm1 - 0.01,
                                                  kFrom_cm1 + kBins * kStep_cm1 + 0.01, 0.002, kStates);
  return made;
}

const FittedTerms& fitted() {
  static const FittedTerms made = fit_terms({&spectra(), 1}, fit_of());
  return made;
}

/// Mean transmittances of the bins along vertical paths of some lengths: the lines themselves in thin layers of the profile.
struct LineByLine {
  std::vector<double> wavenumber_cm1, depth;
  LineByLine(const Profile& profile, double from_km, double to_km) {
    for (double nu = kFrom_cm1 + 0.0025; nu < kFrom_cm1 + kBins * kStep_cm1; nu += 0.005)
      wavenumber_cm1.push_back(nu);
    depth.assign(wavenumber_cm1.size(), 0.0);
    std::vector<double> altitude;
    for (double z = from_km; z < std::min(to_km, 12.0) - 1e-9; z += 0.2) altitude.push_back(z);
    for (double z = std::max(from_km, 12.0); z < std::min(to_km, 60.0) - 1e-9; z += 2.0)
      altitude.push_back(z);
    altitude.push_back(std::min(to_km, 60.0));
    const std::vector<LayerGas> layers = layer_gas(profile, {Gas::h2o}, altitude);
    const std::vector<test::Line> all = lines();
    for (const LayerGas& layer : layers)
      for (std::size_t i = 0; i < depth.size(); ++i)
        depth[i] += layer.molecules_cm2 * test::cross_section(all, wavenumber_cm1[i], layer.pressure_hPa,
                                                              layer.temperature_K, kWater_u);
  }
  double transmittance(std::size_t bin, double length) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (static_cast<std::size_t>((wavenumber_cm1[i] - kFrom_cm1) / kStep_cm1) != bin) continue;
      sum += std::exp(-length * depth[i]);
      count += 1.0;
    }
    return sum / count;
  }
};

double transmittance(const ColumnTerms& terms, std::size_t bin, const std::vector<double>& altitude_km,
                     double from_km, double to_km, double length) {
  const AbsorptionSet set = terms.at(bin);
  double sum = 0.0;
  for (std::size_t t = 0; t < set.terms(); ++t) {
    double depth = 0.0;
    for (std::size_t l = 0; l + 1 < altitude_km.size(); ++l)
      if (altitude_km[l] >= from_km - 1e-9 && altitude_km[l + 1] <= to_km + 1e-9) depth += set.depth[t][l];
    sum += set.weight[t] * std::exp(-length * depth);
  }
  return sum;
}

/// Of all bins, whole and half columns, and lengths.
ifov::test::Measured compared(const GasTermTable& terms, std::string_view model) {
  const Profile& profile = model_atmosphere(model);
  const std::vector<double> altitude_km = level_altitudes_km(0.0);
  const ColumnTerms column(std::make_shared<const GasTermTable>(terms), profile, altitude_km);
  ifov::test::Measured measured;
  for (const auto& [from_km, to_km] : {std::pair{0.0, 100.0}, std::pair{3.0, 100.0}, std::pair{0.0, 2.0}}) {
    const LineByLine right(profile, from_km, to_km);
    for (std::size_t bin = 0; bin < kBins; ++bin)
      for (const double length : {0.3, 1.0, 2.0, 5.0})
        measured.add(kFrom_cm1 + static_cast<double>(bin),
                     transmittance(column, bin, altitude_km, from_km, to_km, length),
                     right.transmittance(bin, length));
  }
  return measured;
}

TEST(TermFitInAir, TransmittancesAreThoseOfTheLines) {
  const TermFitErrors& told = fitted().errors;
  EXPECT_LT(told.rms, 0.001);
  EXPECT_LT(told.largest, 0.004);
  for (const char* model : {"mid-latitude summer", "subarctic winter"}) {
    const ifov::test::Measured measured = compared(fitted().table, model);
    measured.record(std::string("voigt_lines_") + model);
    // What the maker tells, and beyond it interpolation between the states of the grid and layers of the column.
    EXPECT_LT(measured.rms(), 0.002) << measured.text() << " in " << model;
    EXPECT_LT(measured.largest(), told.largest + 0.006) << measured.text() << " in " << model;
  }
}

/// Differences from the lines over the bins' own errors.
std::vector<double> over_stated(const GasTermTable& terms) {
  std::vector<double> ratios;
  const Profile& profile = model_atmosphere("subarctic winter");
  const std::vector<double> altitude_km = level_altitudes_km(0.0);
  const ColumnTerms column(std::make_shared<const GasTermTable>(terms), profile, altitude_km);
  for (const auto& [from_km, to_km] : {std::pair{0.0, 100.0}, std::pair{0.0, 2.0}}) {
    const LineByLine right(profile, from_km, to_km);
    for (std::size_t bin = 0; bin < kBins; ++bin)
      for (const double length : {1.0, 2.0, 5.0})
        ratios.push_back(std::abs(transmittance(column, bin, altitude_km, from_km, to_km, length) -
                                  right.transmittance(bin, length)) /
                         terms.bins[bin].error);
  }
  return ratios;
}
double share_within(const std::vector<double>& ratios, double most) {
  return static_cast<double>(
             std::count_if(ratios.begin(), ratios.end(), [&](double ratio) { return ratio <= most; })) /
         static_cast<double>(ratios.size());
}

// With interpolation between states, which the comparison of terms with spectra does not see. Planted: a third of what is said.
TEST(TermFitInAir, BinsSayHowFarTheyAreFromTheLines) {
  const std::vector<double> fine = over_stated(fitted().table);
  EXPECT_GE(share_within(fine, 1.0), 0.95);
  EXPECT_LT(share_within(fine, 1.0 / 3.0), 0.9);
  // States so far apart that nearly all of the error is that of interpolation.
  const StateGrid few({0.3, 3.0, 30.0, 150.0, 450.0, 1080.0}, {190.0, 250.0, 310.0});
  const GasSpectra coarse = test::spectra_of(Gas::h2o, lines(), kWater_u, kFrom_cm1 - 0.01,
                                             kFrom_cm1 + kBins * kStep_cm1 + 0.01, 0.004, few);
  const FittedTerms made = fit_terms({&coarse, 1}, fit_of());
  EXPECT_GT(made.errors.between, 2.0 * made.errors.largest);
  EXPECT_GE(share_within(over_stated(made.table), 1.0), 0.95);
}

TEST(TermFitInAir, MoreTermsComeNearer) {
  double before = 1.0;
  for (const std::size_t terms : {2, 5, 16}) {
    const FittedTerms made = fit_terms({&spectra(), 1}, fit_of(terms));
    EXPECT_LT(made.errors.rms, 0.6 * before) << terms;
    before = made.errors.rms;
  }
}

/// Planted: sets of wavenumbers that are not the same from layer to layer.
TEST(TermFitInAir, TermsThatDoNotBelongTogetherAreCaught) {
  GasTermTable wrong = fitted().table;
  constexpr std::size_t kUpper = 50;  // states of less than 700 hPa
  for (TermBin& bin : wrong.bins)
    for (std::size_t state = 0; state < kUpper; ++state) {
      const auto first = bin.log_k[0].begin() + static_cast<std::ptrdiff_t>(state * bin.terms());
      std::reverse(first, first + static_cast<std::ptrdiff_t>(bin.terms()));
    }
  EXPECT_GT(compared(wrong, "mid-latitude summer").largest(), 0.02);
}

TEST(TermFitInAir, SameTermsForAnyNumberOfThreads) {
  TermFit fit = fit_of(5);
  fit.threads = 1;
  const FittedTerms one = fit_terms({&spectra(), 1}, fit);
  fit.threads = 3;
  const FittedTerms three = fit_terms({&spectra(), 1}, fit);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    EXPECT_EQ(one.table.bins[bin].weight, three.table.bins[bin].weight);
    EXPECT_EQ(one.table.bins[bin].log_k, three.table.bins[bin].log_k);
  }
}

/// A comb that lets through half of the bin, beside another that stands in its gaps or on its teeth.
TEST(TermFitInAir, GasesOverlapAsTheirLinesDo) {
  const auto comb = [](Gas gas, bool shifted) {
    GasSpectra made{{gas}, {}, StateGrid({1013.25}, {296.0}), {{}}};
    for (int i = 0; i < 2000; ++i) {
      made.wavenumber_cm1.push_back(kFrom_cm1 + (i + 0.5) * 0.001);
      const bool tooth = (i / 10) % 2 == (shifted ? 1 : 0);
      made.log_k[0].push_back(log_cross_section(tooth ? 1e-15 : 0.0));
    }
    return made;
  };
  for (const bool beside : {false, true}) {
    const std::vector<GasSpectra> both{comb(Gas::h2o, false), comb(Gas::ch4, beside)};
    const FittedTerms made = fit_terms(both, {kFrom_cm1, 1.0, 2});
    EXPECT_NEAR(made.errors.overlap, 0.25, 1e-3);  // at random a quarter would come through
    EXPECT_LT(made.errors.largest, 1e-3);
    const TermBin& bin = made.table.bins[0];
    double through = 0.0;
    for (std::size_t t = 0; t < bin.terms(); ++t)
      through += bin.weight[t] * std::exp(-1e17 * (std::exp(static_cast<double>(bin.log_k[0][t])) +
                                                   std::exp(static_cast<double>(bin.log_k[1][t]))));
    EXPECT_NEAR(through, beside ? 0.0 : 0.5, 1e-3);
  }
}

TEST(TermFitInAir, TermsOfTwoGasesTogetherAreBetterThanAtRandom) {
  const StateGrid state({700.0}, {275.0});
  std::vector<GasSpectra> both;
  for (const auto& [gas, seed, strongest] :
       {std::tuple{Gas::h2o, 11u, 3e-22}, std::tuple{Gas::ch4, 12u, 3e-19}})
    both.push_back(test::spectra_of(gas, test::random_lines(400, 4200.0, 4300.0, seed, strongest), 17.0,
                                    4210.0, 4290.0, 0.01, state));
  TermFit fit{4215.0, 1.0, 70};
  fit.most_terms = 24;
  const TermFitErrors errors = fit_terms(both, fit).errors;
  RecordProperty("two_gases_at_random_rms", std::to_string(errors.overlap));
  RecordProperty("two_gases_together_rms", std::to_string(errors.rms));
  RecordProperty("two_gases_together_largest", std::to_string(errors.largest));
  EXPECT_GT(errors.overlap, 0.005);
  EXPECT_LT(errors.rms, 0.1 * errors.overlap);
}

}  // namespace
}  // namespace ifov::atmosphere::test_term_fit_air
