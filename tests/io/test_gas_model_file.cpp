#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "io/atmosphere/gas_model_file.h"
#include "io/atmosphere/gas_spectra_file.h"

namespace ifov::io::test_gas_model_file {
namespace {

using atmosphere::Gas;
using atmosphere::GasTermTable;

const std::string kModel =
    "# a comment\n"
    "ifov gas model 1\n"
    "source lines of two molecules, Voigt\n"
    "bins 4300 2 3\n"
    "pressures 10 1000\n"
    "temperatures 220 300\n"
    "gas H2O self_broadening 4.9 depth_error 0.03\n"
    "gas CH4 continuum\n"
    "bin 4301 error 0.0004\n"
    "weights 0.75 0.25\n"
    "H2O 10 220 1e-24 2e-21\n"
    "H2O 10 300 1e-24 3e-21\n"
    "H2O 1000 220 2e-24 4e-22\n"
    "H2O 1000 300 2e-24 5e-22\n"
    "CH4 10 220 0 1e-20\n"
    "CH4 10 300 0 2e-20\n"
    "CH4 1000 220 1e-23 3e-21\n"
    "CH4 1000 300 1e-23 4e-21\n"
    "bin 4305 error 0\n"
    "weights 1\n"
    "H2O 10 220 1e-25\nH2O 10 300 1e-25\nH2O 1000 220 1e-25\nH2O 1000 300 1e-25\n"
    "CH4 10 220 0\nCH4 10 300 0\nCH4 1000 220 0\nCH4 1000 300 0\n";

std::string changed(const std::string& what, const std::string& by) {
  std::string text = kModel;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string message(const std::string& text) {
  try {
    parse_gas_model(TextFile("a.gases", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect(const std::string& text, const std::string& place, const std::string& said) {
  const std::string found = message(text);
  EXPECT_TRUE(found.starts_with(place)) << found;
  EXPECT_NE(found.find(said), std::string::npos) << found;
}

}  // namespace

TEST(GasModelFile, HoldsWhatWasWritten) {
  const GasTermTable table = parse_gas_model(TextFile("a.gases", kModel));
  EXPECT_EQ(table.source, "lines of two molecules, Voigt");
  EXPECT_EQ(table.first_cm1, 4300.0);
  EXPECT_EQ(table.step_cm1, 2.0);
  ASSERT_EQ(table.gases.size(), 2u);
  EXPECT_EQ(table.gases[0].gas, Gas::h2o);
  EXPECT_EQ(table.gases[0].self_broadening, 4.9);
  EXPECT_FALSE(table.gases[0].holds_continuum);
  EXPECT_EQ(table.gases[0].depth_error, 0.03);
  EXPECT_FALSE(table.gases[1].depth_error);
  EXPECT_FALSE(table.depth_errors_known());
  EXPECT_EQ(table.gases[1].gas, Gas::ch4);
  EXPECT_TRUE(table.gases[1].holds_continuum);
  ASSERT_EQ(table.bins.size(), 3u);
  EXPECT_EQ(table.bins[0].error, 0.0004);
  EXPECT_TRUE(table.bins[1].weight.empty());
  EXPECT_EQ(table.bins[0].weight, (std::vector<double>{0.75, 0.25}));
  const auto k = [&](double hPa, double kelvin, std::size_t gas, std::size_t term) {
    return table.bins[0].cross_sections(gas, table.states.place(hPa, kelvin))[term];
  };
  EXPECT_NEAR(k(10.0, 300.0, 0, 1) / 3e-21, 1.0, 1e-5);
  EXPECT_NEAR(k(1000.0, 220.0, 1, 1) / 3e-21, 1.0, 1e-5);
  EXPECT_LE(k(10.0, 220.0, 1, 0), 1.01 * atmosphere::kNoAbsorption_cm2);
  // Written and read again it is the same.
  const std::string text = gas_model_text(table);
  EXPECT_EQ(gas_model_text(parse_gas_model(TextFile("b.gases", text))), text);
  EXPECT_EQ(gases_of(table), "H2O, CH4");
}

TEST(GasModelFile, SaysWhereItsHeadIsWrong) {
  expect("", "a.gases: ", "it is empty; expected 'ifov gas model 1'");
  expect("4300 1e-20\n", "a.gases:1:1: ", "found '4300 1e-20'; expected 'ifov gas model 1'");
  expect(changed("model 1", "model 2"), "a.gases:2:16: ", "found version '2'; this program reads version 1");
  expect(
      changed("pressures", "presures"), "a.gases:5:1: ",
      "found 'presures'; expected 'source', 'bins', 'pressures', 'temperatures', 'gas' or 'bin'; did you mean 'pressures'?");
  expect(changed("bins 4300 2 3", "bins 4300 30 3"),
         "a.gases:4:11: ", "found '30'; expected the width of a bin in cm-1, 0.001 to 20");
  expect(changed("bins 4300 2 3", "bins 4300 2"), "a.gases:4: ", "the number of bins is missing");
  expect(changed("pressures 10 1000", "pressures 1000 10"), "a.gases:5:16: ", "10 does not rise above 1000");
  expect(changed("pressures 10 1000\n", ""),
         "a.gases: ", "no line that begins with 'pressures' before the first bin");
  expect(changed("temperatures", "pressures 1 2\ntemperatures"),
         "a.gases:6:1: ", "'pressures' is there twice");
  expect(changed("gas CH4", "gas HCl"), "a.gases:8:5: ", "unknown gas 'HCl'; expected 'H2O', 'CO2'");
  expect(changed("gas CH4", "gas H2O"), "a.gases:8:5: ", "the gas H2O is there twice");
  expect(changed("CH4 continuum", "CH4 continuous"), "a.gases:8:9: ",
         "found 'continuous'; expected 'self_broadening' or 'depth_error' and a number, or 'continuum'");
  expect(changed("depth_error 0.03", "depth_error 3"),
         "a.gases:7:41: ", "found '3'; expected the share of its depth that the gas may be off by, 0 to 1");
}

TEST(GasModelFile, SaysWhereABinIsWrong) {
  expect(changed("weights 0.75 0.25", "weights 0.75 0.35"), "a.gases:10:9: ",
         "the weights of the bin of 4301 cm-1 sum to 1.1, 0.1 more than 1; expected 1 within 0.0001");
  expect(changed("weights 0.75 0.25", "weights 0.75 -0.25"),
         "a.gases:10:14: ", "found '-0.25'; expected a weight");
  expect(changed("weights 0.75 0.25", "H2O 10 220 1e-24"),
         "a.gases:10:1: ", "expected the weights of the bin of 4301 cm-1");
  expect(changed("bin 4301", "bin 4300.5"), "a.gases:9:5: ",
         "4300.5 cm-1 is not the middle of a bin; the bins are 2 cm-1 wide from 4300 cm-1 on");
  expect(changed("bin 4305", "bin 4301"),
         "a.gases:19:5: ", "the bin of 4301 cm-1 follows that of 4301 cm-1: bins must rise");
  expect(changed("bin 4305", "bin 4315"),
         "a.gases:19:5: ", "found '4315'; expected the middle of a bin in cm-1, 4300 to 4306");
  expect(changed("H2O 10 300", "H2O 10 310"),
         "a.gases:12:1: ", "found 'H2O 10 310'; expected the row of H2O at 10 hPa and 300 K");
  expect(changed("H2O 10 300 1e-24 3e-21", "H2O 10 300 1e-24"),
         "a.gases:12: ", "found 1 cross sections; expected 2 as of weights");
  expect(changed("3e-21\nH2O", "-3e-21\nH2O"),
         "a.gases:12:18: ", "found '-3e-21'; expected a cross section in cm2 per molecule");
  expect(kModel.substr(0, kModel.find("CH4 1000 220 1e-23")),
         "a.gases: ", "it ends where the row of CH4 at 1000 hPa and 220 K should follow");
  expect(kModel.substr(0, kModel.find("weights 1\n")),
         "a.gases: ", "it ends where the weights of the bin of 4305 cm-1 should follow");
}

TEST(GasSpectraFile, StatesMayStandInAnyOrder) {
  const atmosphere::GasSpectra spectra = parse_gas_spectra(
      TextFile("s.csv",
               "# made by a program\ncm-1, 1000 hPa 300 K, 10 hPa 220 K, 1000 hPa 220 K, 10 hPa 300 K\n"
               "4300.0, 1e-22, 2e-22, 3e-22, 4e-22\n4300.1, 5e-22, 6e-22, 7e-22, 0\n"));
  EXPECT_EQ(spectra.states.pressure_hPa(), (std::vector<double>{10.0, 1000.0}));
  EXPECT_EQ(spectra.states.temperature_K(), (std::vector<double>{220.0, 300.0}));
  EXPECT_EQ(spectra.wavenumber_cm1, (std::vector<double>{4300.0, 4300.1}));
  const std::vector<double> first{2e-22, 4e-22, 3e-22, 1e-22};
  for (std::size_t state = 0; state < 4; ++state)
    EXPECT_NEAR(std::exp(static_cast<double>(spectra.log_k[state][0])) / first[state], 1.0, 1e-5);
}

TEST(GasSpectraFile, SaysWhereItIsWrong) {
  const auto said = [](const std::string& text) -> std::string {
    try {
      parse_gas_spectra(TextFile("s.csv", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_TRUE(said("cm-1,1 bar\n")
                  .starts_with("s.csv:1:6: found '1 bar'; expected a state such as '1013.25 hPa 296 K'"));
  EXPECT_TRUE(
      said("cm-1,1 hPa 200 K,2 hPa 300 K\n")
          .starts_with(
              "s.csv:1: 1 hPa with 300 K is missing; expected every pressure with every temperature"));
  EXPECT_TRUE(said("cm-1,1 hPa 200 K,1 hPa 200 K\n")
                  .starts_with("s.csv:1:18: the state '1 hPa 200 K' is there twice"));
  const std::string head = "cm-1,1 hPa 200 K\n4300,1e-22\n";
  EXPECT_TRUE(said(head + "4299,1e-22\n").starts_with("s.csv:3:1: 4299 cm-1 does not rise above 4300 cm-1"));
  EXPECT_TRUE(said(head + "4301,x\n")
                  .starts_with("s.csv:3:6: found 'x'; expected a cross section in cm2 per molecule"));
  EXPECT_TRUE(said(head + "4301\n").starts_with("s.csv:3: found 1 columns; expected 2 as in the heading"));
  EXPECT_TRUE(said(head).starts_with("s.csv: it has no two rows"));
  EXPECT_TRUE(said("# nothing\n").starts_with("s.csv: found an empty file; expected a heading of states"));
  EXPECT_TRUE(said("um,1 hPa 200 K\n")
                  .starts_with("s.csv:1:1: found 'um'; expected 'cm-1': the first column holds wavenumbers"));
}

}  // namespace ifov::io::test_gas_model_file
