// Colours of spectra and spectra of colours, against figures of the package colour-science 0.4.6 (an implementation of its own of the
// same paper, and measured chips) and of the CIE.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "radiometry/colour/upsampling.h"

namespace ifov::radiometry::test_colour {
namespace {

TEST(Colour, DecodesSrgbAsTheStandardSays) {
  EXPECT_NEAR(srgb_decoded(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(srgb_decoded(0.04045), 0.0031308, 1e-7);
  EXPECT_NEAR(srgb_decoded(119.0 / 255.0), 0.18447499, 1e-7);
  for (double code = 0.0; code <= 1.0; code += 0.01) EXPECT_NEAR(srgb_coded(srgb_decoded(code)), code, 1e-7);
  EXPECT_GT(std::abs(std::pow(0.5, 2.2) - srgb_decoded(0.5)), 1e-3) << "a power of 2.2 must be told apart";
}

TEST(Colour, WhiteIsD65) {
  // CIE 15:2004, table T.3: x 0.31272, y 0.32903.
  const Tristimulus white = tristimulus_under_d65(Spectrum::constant(1.0));
  const double sum = white[0] + white[1] + white[2];
  EXPECT_NEAR(white[0] / sum, 0.31272, 1e-5);
  EXPECT_NEAR(white[1] / sum, 0.32903, 1e-5);
  for (const double grey : {0.0, 0.18, 1.0})
    for (const double value : linear_srgb_of(Spectrum::constant(grey))) EXPECT_NEAR(value, grey, 1e-12);
}

/// Chips of the ColorChecker as N. Ohta measured them, every 20 nm from 0.38 um on, and what colour-science makes of its table of 5 nm.
struct Chip {
  const char* name;
  std::vector<double> reflectance;
  Tristimulus xyz;
};
const Chip kChips[] = {
    {"dark skin",
     {0.048, 0.065, 0.064, 0.055, 0.052, 0.054, 0.061, 0.070, 0.076, 0.087, 0.115,
      0.138, 0.154, 0.173, 0.204, 0.242, 0.282, 0.334, 0.409, 0.462, 0.421},
     {0.10971, 0.09703, 0.06055}},
    {"blue sky",
     {0.113, 0.266, 0.336, 0.335, 0.322, 0.293, 0.260, 0.225, 0.198, 0.183, 0.163,
      0.150, 0.137, 0.123, 0.112, 0.105, 0.103, 0.102, 0.104, 0.106, 0.120},
     {0.17858, 0.19080, 0.34543}},
    {"orange",
     {0.053, 0.054, 0.052, 0.052, 0.052, 0.055, 0.061, 0.086, 0.170, 0.297, 0.452,
      0.532, 0.566, 0.587, 0.604, 0.615, 0.628, 0.633, 0.638, 0.641, 0.582},
     {0.36464, 0.29326, 0.05907}},
    {"red",
     {0.052, 0.051, 0.049, 0.049, 0.048, 0.045, 0.044, 0.044, 0.045, 0.050, 0.072,
      0.192, 0.486, 0.654, 0.700, 0.718, 0.729, 0.727, 0.727, 0.728, 0.664},
     {0.20176, 0.11826, 0.05199}},
};

Spectrum measured(const Chip& chip) {
  std::vector<double> um;
  for (std::size_t k = 0; k < chip.reflectance.size(); ++k)
    um.push_back(0.38 + 0.02 * static_cast<double>(k));
  um.back() = 0.78;
  return {um, chip.reflectance, OutsideRange::extend};
}

TEST(Colour, OfMeasuredChipsIsThePublishedOne) {
  double worst_shifted = 0.0;
  for (const Chip& chip : kChips) {
    const Spectrum spectrum = measured(chip);
    const Tristimulus xyz = tristimulus_under_d65(spectrum);
    std::vector<double> shifted_um(spectrum.wavelength_um().begin(), spectrum.wavelength_um().end());
    for (double& um : shifted_um) um += 0.01;
    const Tristimulus shifted = tristimulus_under_d65({shifted_um, chip.reflectance, OutsideRange::extend});
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(xyz[c], chip.xyz[c], 0.002) << chip.name << " " << c;  // a table of 20 nm for one of 5
      worst_shifted = std::max(worst_shifted, std::abs(shifted[c] - chip.xyz[c]));
    }
  }
  EXPECT_GT(worst_shifted, 0.01) << "spectra that are 10 nm off must be caught";
}

TEST(Upsampling, SpectraAreThoseOfAnotherProgram) {
  // colour.recovery.XYZ_to_sd_Jakob2019, 5 nm, D65; it takes the standard's rounded matrix, which moves the far end of red a little.
  struct Known {
    LinearRgb rgb;
    std::vector<double> at;  ///< 0.40 to 0.70 um, every 0.05
  };
  const Known known[] = {
      {{0.5, 0.2, 0.1}, {0.0972, 0.1131, 0.1468, 0.2164, 0.3590, 0.5917, 0.8007}},
      {{0.05, 0.3, 0.6}, {0.6560, 0.5764, 0.4392, 0.2754, 0.1489, 0.0780, 0.0426}},
      {{0.9, 0.8, 0.1}, {0.0277, 0.1244, 0.5500, 0.8207, 0.8650, 0.8115, 0.5106}},
      {{0.8, 0.05, 0.05}, {0.2568, 0.0575, 0.0426, 0.0724, 0.4721, 0.9647, 0.9934}},
      {{0.02, 0.6, 0.1}, {0.0147, 0.0899, 0.4898, 0.6006, 0.1984, 0.0272, 0.0063}},
  };
  for (const Known& one : known) {
    const ColourSpectrum made = upsampled(one.rgb);
    for (std::size_t k = 0; k < one.at.size(); ++k)
      EXPECT_NEAR(made.at(0.40 + 0.05 * static_cast<double>(k)), one.at[k], 2.5e-3) << k;
  }
  EXPECT_GT(std::abs(upsampled({0.5, 0.2, 0.11}).at(0.45) - known[0].at[1]), 2.5e-3)
      << "another blue must be told apart";
}

TEST(Upsampling, ReturnsEveryColourOfSrgb) {
  constexpr int kSteps = 12;
  double worst = 0.0;
  const auto value = [](int k) { return srgb_decoded(static_cast<double>(k) / kSteps); };
  for (int r = 0; r <= kSteps; ++r)
    for (int g = 0; g <= kSteps; ++g)
      for (int b = 0; b <= kSteps; ++b) {
        const LinearRgb rgb{value(r), value(g), value(b)};
        const Spectrum spectrum = upsampled(rgb).spectrum("colour");
        EXPECT_GE(spectrum.minimum(), 0.0);
        EXPECT_LE(spectrum.maximum(), 1.0);
        worst = std::max(worst, colour_difference(linear_srgb_of(spectrum), rgb));
      }
  EXPECT_LT(worst, 1e-4);
}

TEST(Upsampling, OfMeasuredChipsIsNearTheirSpectra) {
  // How good the guess is for paints: up to 0.11 RMS from 0.42 to 0.70 um, worst where a paint rises steeply to a plateau.
  for (const Chip& chip : kChips) {
    const Spectrum of = measured(chip);
    const ColourSpectrum made = upsampled(linear_srgb_of(of));
    double squares = 0.0, flat = 0.0;
    int count = 0;
    for (double um = 0.42; um < 0.701; um += 0.01, ++count) {
      squares += std::pow(made.at(um) - of.at(um), 2);
      flat += std::pow(tristimulus_under_d65(of)[1] - of.at(um), 2);
    }
    EXPECT_LT(std::sqrt(squares / count), 0.11) << chip.name;
    EXPECT_LT(squares, 0.4 * flat) << chip.name << ": a grey of the same luminance is farther off";
  }
}

TEST(Upsampling, GreysAreFlat) {
  for (const double grey : {0.0, 0.2, 1.0}) {
    const Spectrum spectrum = upsampled({grey, grey, grey}).spectrum("grey");
    EXPECT_TRUE(spectrum.is_constant());
    EXPECT_EQ(spectrum.at(10.0), grey);
  }
}

}  // namespace
}  // namespace ifov::radiometry::test_colour
