// Readers of paths through the atmosphere and of weather.
#include "fuzz/fuzzed_readers.h"
#include "io/atmosphere/aeronet_inversion.h"
#include "io/atmosphere/gas_model_file.h"
#include "io/atmosphere/gas_spectra_file.h"
#include "io/atmosphere/import_paths.h"
#include "io/atmosphere/modtran_channels.h"
#include "io/atmosphere/modtran_csv.h"
#include "io/atmosphere/modtran_json.h"
#include "io/atmosphere/modtran_tape7.h"
#include "io/atmosphere/path_csv.h"
#include "io/atmosphere/phase_function_file.h"
#include "io/atmosphere/uvspec.h"
#include "io/weather/weather_file.h"

namespace ifov::fuzz {
namespace {

const std::string kCards =
    "T F 6    2    2    0    6    6    6    6    6    6    1    0    0 300.000   0.00\n"
    "    1    1    1    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000\n -99.000 -99.000 "
    "-99.000\n"
    " -99.00000 -99.00000 -99.00000  1.416445  0.000736 ! H2O & O3 COLUMNS [GM/CM2]\n   361976 U S STANDARD\n"
    "   2.00000  10.00000  30.00000   9.23590   0.04147   0.00000    0        0.00000\n    0    0    1    0\n"
    "  25.00000   0.00000  23.00000  45.00000   0.00000   0.00000   0.00000   0.00000\n"
    "    2050.0    2052.0       1.0       1.0NW        N1\n    0   0    0.000  0    0.000  0    1.000\n";

std::string cards_of_mode(char mode) {
  std::string cards = kCards;
  cards[14] = mode;
  return cards;
}

std::vector<std::string> tape7_seeds() {
  return {kCards +
              "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  "
              "DRCT_RFLT  TOTAL_RAD "
              " REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n"
              " 2050.00 0.88372636 1.5936E-08 0.0000E+00 4.8713E-07 1.9724E-10 1.9724E-10 0.0000E+00 "
              "0.0000E+00 5.0326E-07 "
              "8.27E-07 8.13E-07   0.124 1.0000 9.6338E-07    297.248\n"
              " 2051.00 0.74512768 3.7338E-08 0.0000E+00 4.0936E-07 1.6479E-10 1.6479E-10 0.0000E+00 "
              "0.0000E+00 4.4687E-07 "
              "6.94E-07 6.78E-07   0.294 1.0000 9.6265E-07    293.831\n -9999.\n",
          cards_of_mode('3') +
              "    FREQ   TRANS     SOL TR  SOLAR\n 2050.00  0.0000 1.14E-13 9.63E-07      1.595E+01\n"
              " 2051.00  0.0000 3.05-114 9.63E-07      1.727E+01\n -9999.\n" +
              cards_of_mode('0') +
              "    FREQ COMBIN    H2O   UMIX\n    CM-1  TRANS  TRANS  TRANS\n 2050.00 0.9100 0.9726 0.9679\n "
              "-9999.\n"};
}

std::vector<std::string> channel_file_seeds() {
  const std::string heading =
      "\n1ST SPECTRAL  LOS CHAN        SPECTRAL  RADIANCE\n   MOMENT     NO.  NEL\n(NANOMETERS)       NO.\n"
      "------------  ---  ---  -------------  -------------  --------  -------------  ---------  ---------  "
      "---------  "
      "---------  -------------  -------------  -------------  -------------  -------------  -------------  "
      "-------------  -------------  -------------  -------------  ----------  ----------  ----------  "
      "----------  "
      "----------  -----------\n";
  const std::string rest =
      "   3.167525E-08   2.230546E-06  1873.863   1.322378E-05   417.4798     5.9285   366.8400   386.8800   "
      "0.000000E+00   0.000000E+00   0.000000E+00   3.178563E-06   2.321252E-06   7.723960E-06   "
      "4.465127E-06   "
      "1.233416E-04   2.278096E-04   3.423688E-04   0.6066521   0.0709446   0.2789467   0.8558540   "
      "0.9000002  "
      "CENTER:  376.86 NM\n";
  const std::string block = heading + "   376.85995    1    1" + rest + "   381.86996    1    2" + rest;
  return {block, block + block};
}

std::vector<std::string> modtran_csv_seeds() {
  return {
      "Freq (cm-1), tot_trans, thrml_em, thrml_sct, surf_emis, mult_scat, sing_scat, grnd_rflt, total_rad\n"
      "2050.0, 0.9, 1.0e-8, 2.0e-9, 3.0e-8, 1.0e-9, 5.0e-10, 4.0e-9, 4.75e-8\n"
      "2051.0, 0.8, 2.0e-8, 2.0e-9, 3.0e-8, 1.0e-9, 5.0e-10, 4.0e-9, 5.75e-8\n",
      "case 0\nwavelength,total transmittance,total radiance\nnm,,W cm-2 sr-1 "
      "nm-1\n400,0.5,3e-7\n401,0.5,3e-7\n\n"
      "case 1\nwavelength [nm],total transmittance,total radiance\n400,0.5,3e-7\n-9999,,\n"};
}

std::vector<std::string> modtran_json_seeds() {
  return {
      R"({"MODTRAN": [{"MODTRANINPUT": {"NAME": "a", "CASE": 0, "RTOPTIONS": {"IEMSCT": "RT_SOLAR_AND_THERMAL"},
"ATMOSPHERE": {"MODEL": "ATM_MIDLAT_SUMMER", "CO2MX": 450.0, "H2OSTR": 1.5, "H2OUNIT": "g", "O3STR": 0.3, "O3UNIT": "a"},
"AEROSOLS": {"IHAZE": "AER_RURAL", "VIS": -0.1}, "GEOMETRY": {"H1ALT": 2.3, "IDAY": 312, "IPARM": 11, "OBSZEN": 180},
"SURFACE": {"GNDALT": 0.35, "SURFP": {"CSALB": "LAMB_CONST_10_PCT"}}, "SPECTRAL": {"V1": 350.0, "FLAGS": "NT A   "}}}]})"};
}

const std::string kUvspecInput =
    "source solar ../data/atlas\nrte_solver disort # comment\nsza 32\numu -0.5 1\nphi 0 90\nzout 0 toa\n";
const std::string kUvspecBlock =
    "  400.000  1.0e+00  2.0e+00  3.0e+00  4.0e+00  5.0e+00  6.0e+00\n   0.000  90.000\n"
    "-0.5000  9.0e+00  1.0e+01  1.1e+01\n 1.0000  9.0e+00  2.0e+01  2.1e+01\n";

std::vector<std::string> uvspec_seeds() { return {kUvspecBlock + kUvspecBlock}; }

std::vector<std::string> uvspec_input_seeds() {
  return {kUvspecInput, "source thermal\noutput_process per_cm-1\noutput_user lambda wavenumber eglo\n",
          "source solar\noutput_quantity transmittance\noutput_user lambda edir edn\nrte_solver twostr\n"};
}

std::vector<std::string> path_csv_seeds() {
  return {"# a path\nwavelength_um,total_radiance,spherical_albedo\n0.4,50,0.25\n0.5,40,0.2\n",
          "wavenumber_cm-1,ground_sensor_transmittance,thermal_path_radiance\n1000,0.8,\n1010,0.7,\n"};
}

std::vector<std::string> phase_function_seeds() {
  return {"# isotropic\nangle_deg, 0.44, 0.865\n0, 1, 1\n45, 1, 1\n90, 1, 1\n180, 1, 1\n",
          "angle 0.55\n0 1.6\n60 1.3\n120 0.7\n180 0.4\n"};
}

std::vector<std::string> aeronet_seeds() {
  return {
      "AERONET Version 3;\nSGP\nSite,Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_Extinction-Total[440nm],AOD_Extinction-Total[675nm],"
      "Single_Scattering_Albedo[440nm],Single_Scattering_Albedo[675nm],Asymmetry_Factor-Total[440nm],Asymmetry_Factor-Total[675nm]\n"
      "SGP,15:08:2019,21:46:45,0.3,0.2,0.95,0.94,0.7,0.65\n"};
}

std::vector<std::string> aeronet_phase_function_seeds() {
  return {
      "Site,Date(dd:mm:yyyy),Time(hh:mm:ss),180.000000[440nm],120.000000[440nm],60.000000[440nm],0.000000[440nm]\n"
      "SGP,15:08:2019,21:46:45,1,1,1,1\n"};
}

std::vector<std::string> gas_model_seeds() {
  return {
      "ifov gas model 1\n# of two gases\nsource lines\nbins 4300 2 3\npressures 10 1000\ntemperatures 220\ngas H2O self_broadening 4.9\n"
      "gas CH4 continuum\nbin 4301 error 0.0004\nweights 0.75 0.25\nH2O 10 220 1e-24 2e-21\nH2O 1000 220 2e-24 4e-22\n"
      "CH4 10 220 0 1e-20\nCH4 1000 220 1e-23 3e-21\n"};
}

std::vector<std::string> gas_spectra_seeds() {
  return {
      "cm-1, 1000 hPa 300 K, 10 hPa 300 K\n4300.0, 1e-22, 2e-22\n4300.1, 5e-22, 0\n4300.2, 5e-22, 6e-22\n"};
}

std::vector<std::string> weather_seeds() {
  std::string surfrad = " Alamosa, CO\n  37.70  105.92 2317 m version 1\n";
  for (const char* minute : {"1", "2"}) {
    surfrad += std::string(" 2016   1  1  1  0  ") + minute + "  0.017 120.00";
    for (int i = 0; i < 19; ++i) surfrad += "   12.5 0";
    surfrad += " 773.5 0\n";
  }
  return {
      "LOCATION,AMSTERDAM,-,NLD,IWEC Data,062400,52.30,4.77,1.0,-2.0\r\nDATA PERIODS,1,1,Data,Sunday, 1/ "
      "1,12/31\r\n1995,1,1,1,60,?,5.1,1.8,79,100100,0,1415,288,0,0,0,0,0,0,0,340,6.7,6,6\r\n"
      "1995,1,1,2,60,?,4.6,1.3,79,99900,0,1415,288,0,0,0,0,0,0,0,330,7.2,7,7\r\n",
      "723170,\"GREENSBORO\",NC,-5.0,36.100,-79.950,273\nDate (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DNI "
      "(W/m^2),DHI (W/m^2),TotCld (tenths),Dry-bulb (C),Dew-point (C),RHum (%),Pressure (mbar),Wdir "
      "(degrees),Wspd (m/s)\n12/31/1980,24:00,0,0,0,10,2.2,0.6,89,980,180,2.6\n"
      "01/01/1988,01:00,0,0,0,10,10.0,6.1,77,993,200,6.2\n",
      surfrad,
      "time,air_temperature_c,relative_humidity_pct,wind_speed_m_s\n2026-06-21T10:00:00Z,20,50,\n"
      "2026-06-21T13:00:00+01:00,24,40,3\n"};
}

void read_uvspec_output(const std::filesystem::path& path) {
  static const io::UvspecInput input = io::parse_uvspec_input(io::TextFile("a.inp", kUvspecInput));
  io::parse_uvspec(io::TextFile(path), input);
}

/// A series is asked, too: at times within, at its ends and far away.
void read_weather_and_ask(const std::filesystem::path& path) {
  const atmosphere::WeatherSeries series = io::read_weather(path);
  for (const double day : {2449718.5, 2449718.52, 2461212.95, 0.0})
    for (std::size_t q = 0; q < atmosphere::kWeatherQuantities; ++q)
      series.at(static_cast<atmosphere::WeatherQuantity>(q), {day, 0.0});
}

}  // namespace

std::vector<FuzzedReader> atmosphere_readers() {
  return {
      {"modtran_tape7",
       "a.tp7",
       tape7_seeds(),
       {" -9999.\n", "FREQ", "TOTAL_RAD", " LOS", "WAVLEN MCRN", "\n\n", "1.0D-05", "********", "SOL_SCAT"},
       [](const auto& path) { io::read_modtran_tape7(path); }},
      {"modtran_channels",
       "a.chn",
       channel_file_seeds(),
       {"1ST SPECTRAL", "---", "(MICRONS)", "\n\n", "nan", "-1.0E-05"},
       [](const auto& path) { io::read_modtran_channels(path, 0.9); }},
      {"modtran_csv",
       "a.csv",
       modtran_csv_seeds(),
       {",", "wavelength,", "total radiance", "W cm-2", "\n\n", "-9999,", "[K]", "(", "um"},
       [](const auto& path) { io::read_modtran_csv(path); }},
      {"modtran_json",
       "a.json",
       modtran_json_seeds(),
       {"\"MODTRANINPUT\":", "LAMB_CONST_", "_PCT", "[[", "}}", "null", "\"GEOMETRY\":"},
       [](const auto& path) { io::read_modtran_json(path); }},
      {"uvspec",
       "a.out",
       uvspec_seeds(),
       {"\n\n", "nan", "  ", "90.000", "-0.5000", "****"},
       read_uvspec_output},
      {"uvspec_input",
       "a.inp",
       uvspec_input_seeds(),
       {"umu ", "phi ", "zout ", "include a.inp\n", "output_user ", "lambda ", "#", "uu ",
        "source thermal\n"},
       [](const auto& path) { io::read_uvspec_input(path); }},
      {"path_csv",
       "a.csv",
       path_csv_seeds(),
       {",", "total_radiance", "wavelength_nm", "\n\n", "nan", "#"},
       [](const auto& path) { io::import_paths(path); }},
      {"phase_functions",
       "a.csv",
       phase_function_seeds(),
       {",", "180", "angle", "\n\n", "nan", "#", "1e300", "1e-300", " -1"},
       [](const auto& path) { io::read_phase_functions(path); }},
      {"aeronet",
       "a.all",
       aeronet_seeds(),
       {",", "-999", "[440nm]", "\n\n", "nan", "Site,", "15:08:2019", "1e300"},
       [](const auto& path) { io::read_aeronet_inversion(path, ""); }},
      {"aeronet_phase_functions",
       "a.pfn",
       aeronet_phase_function_seeds(),
       {",", "-999", "[440nm]", "\n\n", "nan", "Site,", "0.000000[440nm]", "1e300", "180.0"},
       [](const auto& path) { io::read_aeronet_phase_functions(path, ""); }},
      {"gas_model",
       "a.gases",
       gas_model_seeds(),
       {"bin ", "bins ", "gas O3", "weights", "\n\n", "nan", "1e300", " 220", "error", "self_broadening",
        "-1"},
       [](const auto& path) { io::gas_model_text(io::read_gas_model(path)); }},
      {"gas_spectra",
       "a.csv",
       gas_spectra_seeds(),
       {",", "hPa", " K", "\n\n", "nan", "1e300", "1e-300", " -1"},
       [](const auto& path) { io::read_gas_spectra(path); }},
      {"weather",
       "a.txt",
       weather_seeds(),
       {",", "-9999.9", "99.9", "24:00", "02/29/1988", "1996,2,29,", "\r\n", "time,", "LOCATION,",
        "T10:00:00Z", "version"},
       read_weather_and_ask},
  };
}

}  // namespace ifov::fuzz
