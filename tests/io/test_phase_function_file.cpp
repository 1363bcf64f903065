#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/particles/aerosol_phase_functions.h"
#include "core/error.h"
#include "core/format.h"
#include "io/atmosphere/phase_function_file.h"

namespace ifov::io::test_phase_function_file {
namespace {

using atmosphere::PhaseFunction;

/// A table of built-in functions with as many digits as people write.
std::string table_of(const std::vector<PhaseFunction>& functions, double factor = 1.0) {
  std::string text = "# of two kinds\nangle_deg, 0.44, 0.865\n";
  const std::vector<double>& angle_rad = functions[0].angles().angle_rad;
  for (std::size_t k = 0; k < angle_rad.size(); ++k) {
    text += format("{:.6g}", angle_rad[k] * 180.0 / std::numbers::pi);
    for (const PhaseFunction& function : functions)
      text += format(", {:.6g}", factor * std::exp(function.logarithms()[k]));
    text += "\n";
  }
  return text;
}

std::string message(const std::string& text) {
  try {
    parse_phase_functions(TextFile("p.csv", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// An isotropic function of this value.
std::string isotropic(const std::string& value) {
  return "angle 0.55\n0 " + value + "\n60 " + value + "\n120 " + value + "\n180 " + value + "\n";
}

}  // namespace

// Six digits of a built-in function are that function.
TEST(PhaseFunctionFile, HoldsWhatWasWritten) {
  const std::vector<PhaseFunction> functions{atmosphere::AerosolPhaseFunctions("rural", 80.0).at(0.44),
                                             atmosphere::AerosolPhaseFunctions("maritime", 80.0).at(0.865)};
  const atmosphere::PhaseFunctionTable table = parse_phase_functions(TextFile("p.csv", table_of(functions)));
  ASSERT_EQ(table.wavelength_um, (std::vector<double>{0.44, 0.865}));
  for (const std::size_t w : {0u, 1u}) {
    const PhaseFunction read = table.at(table.wavelength_um[w], nullptr);
    for (const double cosine : {-1.0, -0.4, 0.3, 0.95, 0.9999, 1.0})
      EXPECT_NEAR(read.at(cosine) / functions[w].at(cosine), 1.0, 2e-4) << w << " " << cosine;
    for (const int l : {1, 2, 16}) EXPECT_NEAR(read.moment(l), functions[w].moment(l), 1e-5) << w << " " << l;
  }
  // Between wavelengths logarithms are linear, and beyond them the ends hold.
  const double middle = table.at(0.5 * (0.44 + 0.865), nullptr).at(-0.4);
  EXPECT_NEAR(middle / std::sqrt(functions[0].at(-0.4) * functions[1].at(-0.4)), 1.0, 0.02);
  EXPECT_DOUBLE_EQ(table.at(2.0, nullptr).at(-0.4), table.at(0.865, nullptr).at(-0.4));
}

TEST(PhaseFunctionFile, TellsHowFarItsIntegralIsOff) {
  EXPECT_EQ(message(isotropic("1")), "no error");
  EXPECT_EQ(message(isotropic("1.009")), "no error");
  EXPECT_EQ(
      message(isotropic("1.05")),
      "p.csv:1:7: the phase function of 0.55 um integrates to 13.19 over the sphere, 5 % more than 4 pi; "
      "expected 12.57 within 1 %\n  angle 0.55\n        ^");
  EXPECT_NE(message(isotropic("0.0795775"))
                .find("92 % less than 4 pi; expected 12.57 within 1 %; it integrates to 1: "
                      "multiply its values by 4 pi"),
            std::string::npos)
      << message(isotropic("0.0795775"));
  EXPECT_NE(message(isotropic("0.5")).find("50 % less than 4 pi"), std::string::npos);
}

TEST(PhaseFunctionFile, SaysWhereItIsWrong) {
  const auto begins = [](const std::string& text, const std::string& expected) {
    EXPECT_EQ(message(text).substr(0, expected.size()), expected) << message(text);
  };
  begins("", "p.csv: it is empty; expected a heading and rows of angles");
  begins("0 0.55\n",
         "p.csv:1:1: found '0'; expected a heading: a word for the angle, then wavelengths in um");
  begins("angle 0.55 blue\n", "p.csv:1:12: found 'blue'; expected a wavelength in um, above 0");
  begins("angle 0.55 0.44\n", "p.csv:1:12: 0.44 um does not rise above 0.55 um");
  begins("angle 0.55\n1 2\n", "p.csv:2:1: found '1'; expected the first angle to be 0");
  begins("angle 0.55\n0 2\n20 1\n10 1\n", "p.csv:4:1: 10 deg does not rise above 20 deg");
  begins("angle 0.55\n0 2\n20 1 3\n", "p.csv:3: found 3 columns; expected 2 as in the heading");
  begins("angle 0.55\n0 2\n20 -1\n", "p.csv:3:4: found '-1'; expected a phase function's value, above 0");
  begins("angle 0.55\n0 1\n200 1\n", "p.csv:3:1: found '200'; expected a scattering angle in deg, 0 to 180");
  begins("angle 0.55\n0 1\n90 1\n170 1\n",
         "p.csv:4: found 3 angles up to 170 deg; expected 4 at least, from 0 to 180 deg");
}

}  // namespace ifov::io::test_phase_function_file
