#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "io/atmosphere/aeronet_inversion.h"

namespace ifov::io::test_aeronet_inversion {
namespace {

// Names, order and form of columns as AERONET writes them in files of all products; most columns are left out.
const std::string kHead =
    "AERONET Version 3;\nARM_SGP\nAlmucantar Level 2.0 Inversion\n"
    "The following data are public domain.\nContact: PI=Someone\nAll Points,UNITS can be found at,,, https://aeronet.gsfc.nasa.gov\n"
    "Site,Date(dd:mm:yyyy),Time(hh:mm:ss),Day_of_Year,Day_of_Year(Fraction),AOD_Coincident_Input[440nm],AOD_Extinction-Total[440nm],"
    "AOD_Extinction-Total[675nm],AOD_Extinction-Total[1020nm],AOD_Extinction-Fine[440nm],Single_Scattering_Albedo[440nm],"
    "Single_Scattering_Albedo[675nm],Single_Scattering_Albedo[1020nm],Asymmetry_Factor-Total[440nm],Asymmetry_Factor-Total[675nm],"
    "Asymmetry_Factor-Total[1020nm]\n";
const std::string kMorning =
    "ARM_SGP,15:08:2019,13:02:10,227,227.543171,0.31,0.3000,0.1600,0.0800,0.2,0.9512,0.9433,0.9301,0.70,0.64,0.61\n";
const std::string kEvening =
    "ARM_SGP,15:08:2019,21:46:45,227,227.907465,0.23,0.2304,0.1218,0.0684,0.2,-999.,0.9380,0.9200,0.69,0.62,0.60\n";

AeronetInversion read(const std::string& text, const std::string& time = {}) {
  return parse_aeronet_inversion(TextFile("sgp.all", text), time);
}

template <class Do>
std::string said(Do what) {
  try {
    what();
  } catch (const InputError& error) {
    const std::string text = error.what();
    return text.substr(0, text.find('\n'));
  }
  return "taken";
}

TEST(AeronetInversion, OneRetrieval) {
  const AeronetInversion found = read(kHead + kMorning);
  EXPECT_EQ(found.site, "ARM_SGP");
  EXPECT_EQ(found.time, "2019-08-15T13:02:10Z");
  EXPECT_EQ(found.wavelength_um, (std::vector<double>{0.44, 0.675, 1.02}));
  EXPECT_EQ(found.optical_depth, (std::vector<double>{0.3, 0.16, 0.08}));
  EXPECT_EQ(found.single_scattering_albedo, (std::vector<double>{0.9512, 0.9433, 0.9301}));
  EXPECT_EQ(found.asymmetry, (std::vector<double>{0.70, 0.64, 0.61}));
  EXPECT_EQ(read(kHead + kMorning.substr(0, kMorning.size() - 1) + ",\n").asymmetry, found.asymmetry);
}

TEST(AeronetInversion, ATimeChoosesAndWhatIsMissingIsLeftOut) {
  const AeronetInversion found = read(kHead + kMorning + kEvening, "2019-08-15T21:46:45Z");
  EXPECT_EQ(found.wavelength_um, (std::vector<double>{0.675, 1.02}));
  EXPECT_EQ(found.optical_depth.front(), 0.1218);
}

TEST(AeronetInversion, MistakesAreToldWithTheirPlace) {
  EXPECT_EQ(
      said([] { read(kHead + kMorning + kEvening); }),
      "sgp.all:7: found 2 retrievals, from 2019-08-15T13:02:10Z to 2019-08-15T21:46:45Z; expected 'time' to say which");
  EXPECT_EQ(
      said([] { read(kHead + kMorning, "2019-08-15T13:00:00Z"); }),
      "sgp.all:7: found no retrieval of 2019-08-15T13:00:00Z; the file has 1 from 2019-08-15T13:02:10Z to 2019-08-15T13:02:10Z");
  EXPECT_EQ(
      said([] { read("wavelength,depth\n0.44,0.3\n"); }),
      "sgp.all: no line of headings that begins with 'Site,Date(dd:mm:yyyy)'; expected an inversion file of AERONET's version 3");
  EXPECT_EQ(said([] { read(kHead); }), "sgp.all:7: found no retrieval below the headings");
  EXPECT_EQ(said([] { read(kHead + "ARM_SGP,15:08:2019\n"); }),
            "sgp.all:8: found 2 columns; expected 16 as in the heading");
  std::string text = kHead + kMorning;
  text.replace(text.find("0.9512"), 6, "1.9512");
  EXPECT_EQ(
      said([&] { read(text); }),
      "sgp.all:8: found an optical depth of 0.3, an albedo of 1.9512 and an asymmetry of 0.7 at 0.44 um; expected a depth above 0, "
      "an albedo of 0 to 1 and an asymmetry of -0.99 to 0.99");
  text = kHead + kEvening;
  text.replace(text.find("0.9380"), 6, "-999.0");
  EXPECT_EQ(
      said([&] { read(text); }),
      "sgp.all:8: the retrieval of 2019-08-15T21:46:45Z has optical depth, albedo and asymmetry together at 1 wavelengths (-999: "
      "missing); expected two or more");
  text = kHead + kMorning;
  text.replace(text.find("Asymmetry_Factor-Total[440nm]"), 29, "Asymmetry_Factor_Total[440nm]");
  EXPECT_EQ(read(text).wavelength_um.size(), 2u);
  text = kHead + kMorning;
  text.replace(text.find("0.1600"), 6, "o.1600");
  EXPECT_EQ(said([&] { read(text); }), "sgp.all:8:56: found 'o.1600'; expected a number");
}

// Henyey and Greenstein's function, written at AERONET's angles: from 180 degrees down, wavelength by wavelength.
std::string phase_functions(double factor) {
  std::string heading = "Site,Date(dd:mm:yyyy),Time(hh:mm:ss)", row = "ARM_SGP,15:08:2019,13:02:10";
  for (const int nm : {440, 675})
    for (double angle = 180.0; angle >= 0.0; angle -= angle > 10.0 ? 2.0 : 0.5) {
      const double g = nm == 440 ? 0.7 : 0.6, c = std::cos(angle * 3.14159265358979 / 180.0);
      heading += "," + std::to_string(angle) + "[" + std::to_string(nm) + "nm]";
      row += "," + std::to_string(factor * (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * c, 1.5));
    }
  return "AERONET Version 3;\n" + heading + "\n" + row + "\n";
}

TEST(AeronetInversion, PhaseFunctions) {
  const atmosphere::PhaseFunctionTable table =
      parse_aeronet_phase_functions(TextFile("sgp.pfn", phase_functions(1.0)), {});
  EXPECT_EQ(table.wavelength_um, (std::vector<double>{0.44, 0.675}));
  EXPECT_EQ(table.angles->angle_rad.front(), 0.0);
  EXPECT_NEAR(atmosphere::PhaseFunction(table.angles, table.logarithms[0]).moment(1), 0.7, 2e-3);
  EXPECT_NEAR(atmosphere::PhaseFunction(table.angles, table.logarithms[1]).moment(1), 0.6, 2e-3);
  EXPECT_EQ(
      said([] { parse_aeronet_phase_functions(TextFile("sgp.pfn", phase_functions(0.5)), {}); }),
      "sgp.pfn:3: the phase function of 0.44 um has a mean of 0.5 over the sphere; expected 1 within 2 %");
  EXPECT_EQ(said([] { parse_aeronet_phase_functions(TextFile("sgp.all", kHead + kMorning), {}); }),
            "sgp.all:7: found no columns '180.000000[...nm]'; expected a file of phase functions (.pfn)");
}

}  // namespace
}  // namespace ifov::io::test_aeronet_inversion
