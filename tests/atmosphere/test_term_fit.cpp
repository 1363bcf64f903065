// Terms against closed forms: one Lorentz line, one Voigt line, Malkmus's random band.

#include <gtest/gtest.h>

#include "atmosphere/gas/term_fit.h"
#include "atmosphere/gas/term_sets.h"
#include "measured.h"
#include "synthetic_lines.h"

namespace ifov::atmosphere::test_term_fit {
namespace {

using test::Line;

const StateGrid kOneState({1013.25}, {296.0});

double transmittance(const TermBin& bin, double molecules_cm2) {
  if (bin.weight.empty()) return 1.0;
  double sum = 0.0;
  for (std::size_t t = 0; t < bin.weight.size(); ++t)
    sum += bin.weight[t] * std::exp(-molecules_cm2 * std::exp(static_cast<double>(bin.log_k[0][t])));
  return sum;
}

double equivalent_width_cm1(const GasTermTable& terms, double step_cm1, double molecules_cm2) {
  double sum = 0.0;
  for (const TermBin& bin : terms.bins) sum += step_cm1 * (1.0 - transmittance(bin, molecules_cm2));
  return sum;
}

/// Bessel's functions I0 and I1 times exp(-x), by their integrals over half a turn (trapezoid rule, exact to rounding).
std::pair<double, double> scaled_bessel(double x) {
  constexpr int kParts = 4000;
  double zero = 0.0, one = 0.0;
  for (int k = 0; k < kParts; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / kParts, part = std::exp(x * (std::cos(angle) - 1.0));
    zero += part / kParts;
    one += part * std::cos(angle) / kParts;
  }
  return {zero, one};
}

/// Equivalent width of a Lorentz line, Ladenburg and Reiche (1913): 2 pi a x exp(-x) (I0(x) + I1(x)), x = S u / (2 pi a).
double ladenburg_reiche_cm1(double strength_cm, double width_cm1, double molecules_cm2) {
  const double x = strength_cm * molecules_cm2 / (2.0 * std::numbers::pi * width_cm1);
  const auto [zero, one] = scaled_bessel(x);
  return 2.0 * std::numbers::pi * width_cm1 * x * (zero + one);
}

/// A line in the middle of 60 cm-1 of 12 uneven bins' worth, and what lies beyond: S u a / (pi d) on each side while that is thin.
struct OneLine {
  static constexpr double kMiddle_cm1 = 4320.37, kFrom_cm1 = 4290.0, kStep_cm1 = 5.0;
  static constexpr std::size_t kBins = 12;
  double beyond_cm1(double strength_cm, double width_cm1, double molecules_cm2) const {
    double sum = 0.0;
    for (const double d : {kMiddle_cm1 - kFrom_cm1, kFrom_cm1 + kBins * kStep_cm1 - kMiddle_cm1})
      sum += strength_cm * molecules_cm2 * width_cm1 / (std::numbers::pi * d);
    return sum;
  }
  GasTermTable terms(const std::function<double(double)>& k, double step_cm1, double error = 2e-4) const {
    GasSpectra spectra{{Gas::ch4}, {}, kOneState, {{}}};
    for (double nu = kFrom_cm1 - 1.0; nu < kFrom_cm1 + kBins * kStep_cm1 + 1.0; nu += step_cm1) {
      spectra.wavenumber_cm1.push_back(nu);
      spectra.log_k[0].push_back(log_cross_section(k(nu - kMiddle_cm1)));
    }
    TermFit fit{kFrom_cm1, kStep_cm1, kBins};
    fit.most_terms = 32;
    fit.error = error;
    return fit_terms({&spectra, 1}, fit).table;
  }
};

TEST(TermFit, EquivalentWidthOfALorentzLineIsLadenburgsAndReiches) {
  const OneLine line;
  constexpr double kStrength = 1e-19, kWidth = 0.07;
  const auto lorentz = [&](double away) {
    return kStrength * kWidth / (std::numbers::pi * (away * away + kWidth * kWidth));
  };
  const GasTermTable terms = line.terms(lorentz, 0.004);
  ifov::test::Measured measured;
  for (const double x : {0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 30.0}) {
    const double u = 2.0 * std::numbers::pi * kWidth * x / kStrength;
    const double right = ladenburg_reiche_cm1(kStrength, kWidth, u) - line.beyond_cm1(kStrength, kWidth, u);
    measured.add(x, equivalent_width_cm1(terms, OneLine::kStep_cm1, u) / right, 1.0);
  }
  measured.record("lorentz_line");
  EXPECT_LT(measured.largest(), 0.01) << measured.text();
}

TEST(TermFit, ALineOfAnotherWidthIsToldFromIt) {
  const OneLine line;
  constexpr double kStrength = 1e-19, kWidth = 0.07, kX = 10.0;
  const auto wider = [&](double away) {
    const double a = 1.1 * kWidth;
    return kStrength * a / (std::numbers::pi * (away * away + a * a));
  };
  const double u = 2.0 * std::numbers::pi * kWidth * kX / kStrength;
  const double found = equivalent_width_cm1(line.terms(wider, 0.004), OneLine::kStep_cm1, u);
  const double right = ladenburg_reiche_cm1(kStrength, kWidth, u) - line.beyond_cm1(kStrength, kWidth, u);
  EXPECT_GT(found / right, 1.03);  // the square root of 1.1
}

TEST(TermFit, EquivalentWidthOfAVoigtLineIsThatOfItsIntegral) {
  const OneLine line;
  constexpr double kStrength = 1e-19, kDoppler = 0.02, kLorentz = 0.01;
  const auto k = [&](double away) { return kStrength * test::voigt(away, kDoppler, kLorentz); };
  const GasTermTable terms = line.terms(k, 0.001);
  ifov::test::Measured measured;
  for (const double u : {1e17, 1e18, 1e19, 1e20}) {
    // Simpson's rule, in pieces that grow away from the middle.
    double right = 0.0;
    for (const double end :
         {OneLine::kMiddle_cm1 - OneLine::kFrom_cm1,
          OneLine::kFrom_cm1 + OneLine::kBins * OneLine::kStep_cm1 - OneLine::kMiddle_cm1}) {
      const auto at = [&](double s) {  // away = end s^3
        return (1.0 - std::exp(-u * k(end * s * s * s))) * 3.0 * end * s * s;
      };
      constexpr int kParts = 4000;
      for (int p = 0; p < kParts; ++p) {
        const double h = 1.0 / kParts;
        right += h / 6.0 * (at(p * h) + 4.0 * at((p + 0.5) * h) + at((p + 1) * h));
      }
    }
    measured.add(u, equivalent_width_cm1(terms, OneLine::kStep_cm1, u) / right, 1.0);
  }
  measured.record("voigt_line");
  EXPECT_LT(measured.largest(), 0.02) << measured.text();
  // Thin: strength times amount, whatever the shape.
  EXPECT_NEAR(equivalent_width_cm1(terms, OneLine::kStep_cm1, 1e16) / (kStrength * 1e16), 1.0, 0.05);
}

/// Malkmus (1967): lines of one width at random with strengths as 1/S exp(-S/S0) transmit exp(-tau),
/// tau = pi a / (2 d) (sqrt(1 + 4 S0 u / (pi a)) - 1), a the half-width over the spacing d in cm-1.
double malkmus(double depth, double width_over_spacing) {
  const double y = 0.5 * std::numbers::pi * width_over_spacing;
  return std::exp(-y * (std::sqrt(1.0 + 2.0 * depth / y) - 1.0));
}

/// k / mean k below which the share g of Malkmus's band lies: an inverse Gaussian distribution (Domoto, JQSRT 14 (1974) 935-942).
double malkmus_k(double g, double width_over_spacing) {
  const double shape = 0.5 * std::numbers::pi * width_over_spacing;
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const auto below = [&](double k) {
    const double root = std::sqrt(shape / k);
    return normal(root * (k - 1.0)) + std::exp(2.0 * shape) * normal(-root * (k + 1.0));
  };
  double low = 1e-8, high = 1e6;
  for (int step = 0; step < 200; ++step) {
    const double middle = std::sqrt(low * high);
    (below(middle) < g ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

GasTermTable malkmus_terms(double width_over_spacing, double mean_k_cm2, TermFitErrors* told = nullptr) {
  constexpr int kPoints = 4000;
  GasSpectra spectra{{Gas::ch4}, {}, kOneState, {{}}};
  for (int i = 0; i < kPoints; ++i) {
    spectra.wavenumber_cm1.push_back(4300.0 + 5.0 * (i + 0.5) / kPoints);
    // Mixed up: bins do not ask in which order.
    const double g = (static_cast<double>((i * 1597L) % kPoints) + 0.5) / kPoints;
    spectra.log_k[0].push_back(log_cross_section(mean_k_cm2 * malkmus_k(g, width_over_spacing)));
  }
  TermFit fit{4300.0, 5.0, 1};
  fit.error = 5e-4;
  const FittedTerms made = fit_terms({&spectra, 1}, fit);
  if (told != nullptr) *told = made.errors;
  return made.table;
}

TEST(TermFit, MalkmussRandomBandComesBack) {
  constexpr double kMean_cm2 = 1e-19;
  for (const double width_over_spacing : {0.05, 0.2, 1.0}) {
    TermFitErrors told;
    const GasTermTable terms = malkmus_terms(width_over_spacing, kMean_cm2, &told);
    ifov::test::Measured measured, another;
    for (double depth = 0.01; depth < 30.0; depth *= 1.3) {
      const double found = transmittance(terms.bins[0], depth / kMean_cm2);
      measured.add(depth, found, malkmus(depth, width_over_spacing));
      another.add(depth, found, malkmus(depth, 1.1 * width_over_spacing));
    }
    measured.record("malkmus_" + std::to_string(width_over_spacing));
    EXPECT_LT(measured.largest(), 0.002) << measured.text() << " at " << width_over_spacing;
    EXPECT_GT(another.largest(), 0.005) << another.text() << ": lines of another width are not told apart";
    EXPECT_LE(told.largest, 1e-3);
    EXPECT_LE(terms.bins[0].weight.size(), 16u);
  }
}

TEST(TermFit, NoMoreTermsThanTheErrorNeeds) {
  const auto terms_for = [](double error) {
    GasSpectra spectra{{Gas::ch4}, {}, kOneState, {{}}};
    for (int i = 0; i <= 500; ++i) {
      spectra.wavenumber_cm1.push_back(4300.0 + 0.002 * i);
      spectra.log_k[0].push_back(log_cross_section(1e-22 * std::pow(10.0, 0.008 * i)));
    }
    TermFit fit{4300.0, 1.0, 1};
    fit.error = error;
    fit.most_terms = 64;
    return fit_terms({&spectra, 1}, fit);
  };
  const FittedTerms rough = terms_for(0.02), fine = terms_for(1e-3), finest = terms_for(1e-4);
  EXPECT_LT(rough.table.bins[0].weight.size(), fine.table.bins[0].weight.size());
  EXPECT_LT(fine.table.bins[0].weight.size(), finest.table.bins[0].weight.size());
  EXPECT_LE(rough.errors.largest, 0.02);
  EXPECT_LE(fine.errors.largest, 1e-3);
  EXPECT_LE(finest.errors.largest, 1e-4);
}

TEST(TermFit, GreyGasIsOneTermAndNoGasNone) {
  GasSpectra spectra{{Gas::ch4}, {}, kOneState, {{}}};
  for (int i = 0; i <= 200; ++i) {
    spectra.wavenumber_cm1.push_back(4300.0 + 0.01 * i);
    spectra.log_k[0].push_back(log_cross_section(i <= 101 ? 3e-20 : 0.0));
  }
  const GasTermTable terms = fit_terms({&spectra, 1}, {4300.0, 0.5, 4}).table;
  ASSERT_EQ(terms.bins[0].weight.size(), 1u);
  EXPECT_NEAR(std::exp(terms.bins[0].log_k[0][0]) / 3e-20, 1.0, 1e-5);
  EXPECT_TRUE(terms.bins[3].weight.empty());
}

TEST(TermFit, PointsStandForWhatIsNearestToThem) {
  const std::vector<double> nu{0.0, 1.0, 1.5, 3.0, 4.0};
  const BinPoints points = points_in(nu, 1.2, 3.7);
  ASSERT_EQ(points.first, 1u);
  ASSERT_EQ(points.share.size(), 4u);
  // Middles at 0.5, 1.25, 2.25, 3.5.
  EXPECT_NEAR(points.share[0], 0.05 / 2.5, 1e-12);
  EXPECT_NEAR(points.share[1], 1.0 / 2.5, 1e-12);
  EXPECT_NEAR(points.share[2], 1.25 / 2.5, 1e-12);
  EXPECT_NEAR(points.share[3], 0.2 / 2.5, 1e-12);
}

}  // namespace
}  // namespace ifov::atmosphere::test_term_fit
