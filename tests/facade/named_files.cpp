#include "named_files.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>

namespace facade_test {
namespace {

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

std::string grid() {
  std::string text = "ncols 4\nnrows 4\nxllcorner -8\nyllcorner -8\ncellsize 4\n";
  for (int k = 0; k < 16; ++k) text += std::to_string(1 + k % 3) + ((k + 1) % 4 == 0 ? "\n" : " ");
  return text;
}

/// Three bands of bytes, the last of them high: normals that lean to and fro.
std::map<std::string, std::string> normals() {
  std::string data;
  for (int band = 0; band < 3; ++band)
    for (int k = 0; k < 16; ++k) data += static_cast<char>(band == 2 ? 240 : 100 + 10 * (k % 5));
  return {{"n.img", data},
          {"n.hdr",
           "ENVI\nsamples = 4\nlines = 4\nbands = 3\nheader offset = 0\nfile type = ENVI Standard\n"
           "data type = 1\ninterleave = bsq\nbyte order = 0\n"}};
}

std::string brdf() {
  std::string text;
  for (const char* light : {"0", "45", "80"})
    for (const char* view : {"0", "45", "80"})
      for (const char* azimuth : {"0", "90", "180"})
        for (const char* um : {"0.4", "0.7"})
          text += std::string(light) + "," + view + "," + azimuth + "," + um + ",0.1\n";
  return text;
}

std::string asd() {
  std::string bytes(484, '\0');
  const auto set = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  bytes.replace(0, 3, "as7");
  set(186, std::uint8_t{1}), set(191, 350.f), set(195, 100.f), set(204, std::uint16_t{4});
  const std::string white =
      raw({std::uint16_t{0xffff}}) + std::string(16, '\0') + raw({std::uint16_t{5}}) + "white";
  return bytes + raw({1.f, 2.f, 3.f, 4.f}) + white + raw({6.f, 7.f, 8.f, 9.f});
}

std::string ems() {
  std::string text = "1\n";
  for (int degree = 0; degree <= 90; ++degree) text += "1.0\n";
  return text + "CURVE_BEGIN\n0.35\t0.98\n2.5 0.95\n14.9\t0.9\n";
}

/// Two copies: no turn, no scale.
std::string instances() {
  return "IFOVINST" + raw({std::uint32_t{0x01020304}, std::uint32_t{1}}) + raw({std::uint64_t{2}}) +
         raw({std::uint32_t{24}}) + std::string(4, '\0') + raw({0.0, 0.0, 0.0}) + raw({std::uint64_t{0}}) +
         raw({-3.0, -3.0, 0.0, 1.0, 1.0, 0.0});
}

const std::string kCity = R"({"type": "CityJSON", "version": "2.0",
  "transform": {"scale": [0.001, 0.001, 0.001], "translate": [0, 0, 0]},
  "vertices": [[-5000, -5000, 0], [5000, -5000, 0], [0, 5000, 2000]],
  "CityObjects": {"a": {"type": "Building",
                        "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]]}]}}})";

const std::string kEcostress =
    "Name: Concrete\nType: manmade\nClass: Concrete\nSubclass: Paving\nParticle Size: Solid\nSample No.: 1\n"
    "Owner: a\nWavelength Range: All\nOrigin: JHU\nCollection Date: N/A\nDescription: Paving.\n"
    "Measurement: Directional (10 Degree) Hemispherical Reflectance\nFirst Column: X\nSecond Column: Y\n"
    "X Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\nFirst X Value: 0.42\n"
    "Last X Value: 14.0\nNumber of X Values: 3\nAdditional Information: none\n\n"
    "0.4200\t21.5\n0.7000\t42.25\n14.0000\t5.125\n";

/// At the ground and above the air, looking straight down; what is sent up and what is seen of it depend on the ground.
std::string uvspec(const std::string& sent_back, const std::string& seen) {
  std::string text;
  for (const char* nm : {"400", "700"})
    text += std::string(nm) + " 900 " + sent_back + " 1 1 1\n 0.0\n 1.0 0 0\n" + nm +
            " 1200 0 100 1 1 1\n 0.0\n 1.0 " + seen + " " + seen + "\n";
  return text;
}
std::string uvspec_input(const std::string& albedo) {
  return "source solar a.dat # mW\nsza 40\nalbedo " + albedo +
         "\numu 1\nphi 0\nzout 0 toa\nrte_solver disort\n";
}

const std::string kCsv = R"({"csv": "FILEa.csv", "wavelength_unit": "um")";

Parts reflectance(const std::string& value) { return {.material = "\"reflectance\": " + value}; }
/// Of a surface whose temperature follows from its weather, FILEw.csv.
Parts solved(const std::string& thermal) {
  return {.material = R"("reflectance": 0.3, "temperature": "solved", "thermal": {)" + thermal + "}",
          .scene = R"("origin": {"latitude": "52 deg", "longitude": "4 deg"}, )",
          .more = R"(, "time": "2026-06-22T00:00Z", "weather": {"file": "FILEw.csv"},
                     "temperatures": {"spin_up": "0 d", "step": "60 min", "repeat_first_day": true})"};
}
std::string weather() {
  std::string text = "time,air_temperature_c,wind_speed_m_s,global_irradiance_w_m2,longwave_down_w_m2\n";
  for (int hour = 0; hour < 25; ++hour)
    text += (hour < 24 ? "2026-06-21T" : "2026-06-22T") + std::string(hour % 24 < 10 ? "0" : "") +
            std::to_string(hour % 24) + ":00Z,15,2," + std::to_string(hour > 4 && hour < 19 ? 400 : 0) +
            ",320\n";
  return text;
}
const std::string kWall =
    R"("layers": [{"thickness": "1 mm", "library": "steel"}], "solar_absorptance": 0.7, "emissivity": 0.9)";

Parts object(const std::string& value) { return {.object = value}; }
Parts imported(const std::string& files) {
  return {.sky = R"("surroundings": {"reflectance": 0.2})",
          .more = R"(, "atmosphere": {"imported": {)" + files + "}}"};
}

const std::string kOwnHaze = R"("optical_depth": 0.3, "angstrom": 1.3, "single_scattering_albedo": 0.9, )";

/// Air with haze of the document's own, in narrow channels, whose air takes less time.
Parts modelled(const std::string& haze) {
  return {.sky = R"("surroundings": {"reflectance": 0.2})",
          .channel = R"({"name": "c", "gaussian": {"center": "0.55 um", "fwhm": "2 nm"}})",
          .thermal = R"({"name": "T", "top_hat": {"from": "0.6 um", "to": "0.602 um"}})",
          .more = R"(, "atmosphere": {"profile": "US standard 1976", "aerosol": {)" + haze + "}}"};
}

const std::string kRetrieval =
    "AERONET Version 3;\nSite,Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_Extinction-Total[440nm],AOD_Extinction-Total[675nm],"
    "Single_Scattering_Albedo[440nm],Single_Scattering_Albedo[675nm],Asymmetry_Factor-Total[440nm],"
    "Asymmetry_Factor-Total[675nm]\nARM_SGP,15:08:2019,13:02:10,0.4,0.23,0.9,0.9,0.7,0.6\n";

/// Of its haze, even in all directions.
std::string phase_functions() {
  std::string heading = "AERONET Version 3;\nSite,Date(dd:mm:yyyy),Time(hh:mm:ss)",
              row = "ARM_SGP,15:08:2019,13:02:10";
  for (const char* nm : {"440", "675"})
    for (int angle = 180; angle >= 0; angle -= 5) {
      heading += "," + std::to_string(angle) + ".000000[" + nm + "nm]";
      row += ",1";
    }
  return heading + "\n" + row + "\n";
}

/// A sensor of single views.
Parts views(const std::string& sensor) {
  return {.sky = R"("sky": {"radiance": "20 W m-2 sr-1 um-1"})", .camera = "", .sensor = ", " + sensor};
}

std::vector<Named> named_by_materials() {
  const std::string placed = R"(, "low_left": ["-8 m", "-8 m"], "size": ["16 m", "16 m"])";
  return {
      {"CSV spectrum", "csv", reflectance(kCsv + "}"), {{"a.csv", "0.4,0.1\n0.58,0.5\n2.5,0.3\n"}}},
      {"ECOSTRESS spectrum",
       "ecostress",
       reflectance(R"({"ecostress": "FILEa.txt"})"),
       {{"a.txt", kEcostress}}},
      {"USGS spectrum",
       "usgs",
       reflectance(R"({"usgs": "FILEa.txt", "wavelengths": "FILEw.txt"})"),
       {{"a.txt", " splib07a Record=13: Grass ASDFRa AREF\n 0.1\n 0.2\n 0.3\n"},
        {"w.txt", " splib07a Record=1: Wavelengths ASD\n 0.4\n 0.58\n 0.7\n"}}},
      {"ASD spectrum", "asd", reflectance(R"({"asd": "FILEa.asd"})"), {{"a.asd", asd()}}},
      {"ENVI library spectrum",
       "sli",
       reflectance(R"({"sli": "FILEa.sli", "spectrum": "lawn"})"),
       {{"a.sli", raw({1.f, 2.f, 3.f, 4.f, 5.f, 6.f})},
        {"a.hdr",
         "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Spectral Library\n"
         "data type = 4\ninterleave = bsq\nbyte order = 0\nwavelength units = Nanometers\n"
         "spectra names = {roof, lawn}\nwavelength = {400, 500, 700}\nreflectance scale factor = 10\n"}}},
      {"DIRSIG spectrum", "ems", {.material = R"("emissivity": {"ems": "FILEa.ems"})"}, {{"a.ems", ems()}}},
      {"temperature map",
       "file",
       {.material = R"("reflectance": 0.3, "temperature": {"map": {"file": "FILEa.asc", "unit": "degC"}})",
        .thermal = R"({"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}})"},
       {{"a.asc", grid()}}},
      {"map of numbers",
       "file",
       reflectance(
           R"(0.3, "scattering": {"rpv": {"k": {"map": {"file": "FILEa.asc", "unit": 0.02, "offset": 0.8}}, "asymmetry": 0}})"),
       {{"a.asc", grid()}}},
      {"map of angles",
       "file",
       reflectance(R"(0.3, "scattering": {"oren_nayar": {"slope": {"map": {"file": "FILEa.asc"}}}})"),
       {{"a.asc", grid()}}},
      {"map of lengths",
       "file",
       reflectance(
           R"(1, "scattering": {"snow": {"grain": {"map": {"file": "FILEa.asc", "unit": "0.05 mm"}}}})"),
       {{"a.asc", grid()}}},
      {"table",
       "file",
       reflectance(R"(1, "scattering": {"table": {"file": "FILEa.csv"}})"),
       {{"a.csv", brdf()}}},
      {"table",
       "transmitted",
       reflectance(R"(1, "scattering": {"table": {"file": "FILEa.csv", "transmitted": "FILEb.csv"}})"),
       {{"a.csv", brdf()}, {"b.csv", brdf()}}},
      {"CSV spectrum of a number",
       "csv",
       {.sky =
            R"("sky": {"none": {}}, "sources": [{"point": {"at": ["0 m", "0 m", "3 m"], "power": "10 W", "spectrum": )" +
            kCsv + "}}}]"},
       {{"a.csv", "0.4,1.2\n0.7,1.6\n"}}},
      {"texture image",
       "file",
       reflectance(
           R"([0.1, 0.4, 0.6], "texture": {"images": [{"file": "FILEa.asc", "from": "0.4 um", "to": "0.7 um"}]})"),
       {{"a.asc", grid()}}},
      {"relief of heights",
       "file",
       reflectance(R"(0.3, "relief": {"heights": {"file": "FILEa.asc", "unit": "1 m"}})"),
       {{"a.asc", grid()}}},
      {"relief of normals", "file",
       reflectance(R"(0.3, "relief": {"normals": {"file": "FILEn.img")" + placed + "}}"), normals()},
      {"opacity map",
       "file",
       {.material = R"("reflectance": 0.3, "opacity": {"file": "FILEa.asc", "cutoff": 2})",
        .object =
            R"({"polygon": {"vertices": [["-8 m", "-8 m", "1 m"], ["8 m", "-8 m", "1 m"], ["0 m", "8 m", "1 m"]]}, "material": "m"})"},
       {{"a.asc", grid()}}},
  };
}

std::vector<Named> named_by_objects() {
  return {
      {"instances",
       "csv",
       object(R"({"instances": {"of": "ball", "csv": "FILEa.csv"}})"),
       {{"a.csv", "-3,-3,0\n1,1,0\n"}}},
      {"instances",
       "binary",
       object(R"({"instances": {"of": "ball", "binary": "FILEa.ifovinst"}})"),
       {{"a.ifovinst", instances()}}},
      {"density map",
       "file",
       object(R"({"random_placement": {"of": "ball", "density": {"file": "FILEa.asc", "unit": "0.2 m-2"},
               "area": {"low": ["-8 m", "-8 m"], "high": ["8 m", "8 m"]}}})"),
       {{"a.asc", grid()}}},
      {"mesh",
       "file",
       object(R"({"mesh": {"file": "FILEa.obj"}, "material": "m"})"),
       {{"a.obj", "v -5 -5 0\nv 5 -5 0\nv 0 5 2\nf 1 2 3\n"}}},
      {"city", "file", object(R"({"city": {"file": "FILEa.json"}, "material": "m"})"), {{"a.json", kCity}}},
      {"terrain",
       "file",
       object(R"({"terrain": {"file": "FILEa.asc", "unit": "1 m"}, "material": "m"})"),
       {{"a.asc", grid()}}},
      {"material map",
       "file",
       {.more_materials = R"(, "n": {"reflectance": 0.7})",
        .object =
            R"({"plane": {}, "material": {"map": {"file": "FILEa.asc", "classes": {"1": "m", "2": "n", "3": "m"}}}})"},
       {{"a.asc", grid()}}},
      {"mixture map",
       "file",
       object(R"({"plane": {}, "material": {"mixture": {"file": "FILEa.asc", "materials": ["m"]}}})"),
       {{"a.asc", grid()}}},
      {"measured lamp",
       "file",
       {.sky =
            R"("sky": {"none": {}}, "sources": [{"ies": {"at": ["0 m", "0 m", "3 m"], "file": "FILEa.ies"}}])"},
       {{"a.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 100\n0 90\n0\n10 10\n"}}},
  };
}

const std::string kScanner =
    R"({"pushbroom": {"pixels": [4, 4], "field_of_view": "0.5 deg", "line_period": "25 ms"}})";

std::string frame_with(const std::string& lens) {
  return R"({"frame": {"focal_length": "50 mm", "pitch": "10 um", "pixels": [4, 4], "position": ["0 m", "0 m", "100 m"], "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0], )" +
         lens + "}}";
}

std::vector<Named> named_elsewhere() {
  return {
      {"CSV spectrum of irradiance",
       "csv",
       {.sun = R"({"point": {"zenith": "40 deg", "azimuth": "120 deg", "spectrum": )" + kCsv +
               R"(, "unit": "W m-2 um-1"}}})"},
       {{"a.csv", "0.4,1000\n0.7,1500\n"}}},
      {"CSV spectrum of radiance",
       "csv",
       {.sky = R"("sky": {"radiance": )" + kCsv + R"(, "unit": "W m-2 sr-1 um-1"}})"},
       {{"a.csv", "0.4,100\n0.7,50\n"}}},
      {"imported atmosphere",
       "files",
       imported(R"("files": ["FILEa.csv"])"),
       {{"a.csv",
         "wavelength_um,ground_sensor_transmittance,sun_ground_transmittance,direct_sun_ground_transmittance,"
         "solar_path_radiance\n0.4,0.7,0.6,0.5,50\n0.7,0.8,0.7,0.6,20\n"}}},
      {"imported atmosphere",
       "uvspec_inputs",
       imported(
           R"("files": ["FILEa.out", "FILEc.out", "FILEe.out"], "uvspec_inputs": ["FILEb.inp", "FILEd.inp", "FILEf.inp"], "albedos": [0, 0.25, 0.5])"),
       {{"a.out", uvspec("300 0", "40")},
        {"b.inp", uvspec_input("0")},
        {"c.out", uvspec("330.8 307.7", "123.25")},
        {"d.inp", uvspec_input("0.25")},
        {"e.out", uvspec("363.2 631.6", "210.9")},
        {"f.inp", uvspec_input("0.5")}}},
      {"aerosol",
       "phase_function",
       modelled(kOwnHaze + R"("phase_function": "FILEa.csv")"),
       {{"a.csv", "angle_deg,0.55\n0,1\n45,1\n120,1\n180,1\n"}}},
      {"part of a mixture",
       "phase_function",
       modelled(R"("mixture": [{)" + kOwnHaze + R"("phase_function": "FILEa.csv"}])"),
       {{"a.csv", "angle_deg,0.55\n0,1\n45,1\n120,1\n180,1\n"}}},
      {"atmosphere",
       "gas_model",
       {.sky = R"("surroundings": {"reflectance": 0.2})",
        .more = R"(, "atmosphere": {"profile": "US standard 1976", "gas_model": "FILEa.gases"})"},
       {{"a.gases",
         "ifov gas model 1\nbins 16000 20 40\npressures 5 1080\ntemperatures 180 320\ngas O3\nbin 16310 error 0.01\n"
         "weights 1\nO3 5 180 4e-21\nO3 5 320 4e-21\nO3 1080 180 4e-21\nO3 1080 320 4e-21\n"}}},
      {"AERONET retrieval", "file", modelled(R"("aeronet": {"file": "FILEa.all"})"), {{"a.all", kRetrieval}}},
      {"AERONET retrieval",
       "phase_functions",
       modelled(R"("aeronet": {"file": "FILEa.all", "phase_functions": "FILEb.pfn"})"),
       {{"a.all", kRetrieval}, {"b.pfn", phase_functions()}}},
      {"distant sensor",
       "file",
       views(R"("distant": {"file": "FILEa.csv", "size": ["4 m", "4 m"]})"),
       {{"a.csv", "view_zenith_deg,view_azimuth_deg\n60,270\n"}}},
      {"points", "file", views(R"("points": {"file": "FILEa.csv"})"), {{"a.csv", "x_m,y_m,z_m\n1,0,2\n"}}},
      {"rays",
       "file",
       views(R"("rays": {"file": "FILEa.csv"})"),
       {{"a.csv", "x_m,y_m,z_m,dx,dy,dz\n0,0,5,0,0,-1\n"}}},
      {"power over time",
       "file",
       solved(kWall + R"(, "power": {"file": "FILEa.csv"})"),
       {{"a.csv", "time,power_w_m2\n2026-06-21T10:00Z,0\n2026-06-21T11:00Z,60\n"}, {"w.csv", weather()}}},
      {"temperature over time",
       "file",
       solved(kWall + R"(, "back": {"room": {"temperature": {"file": "FILEa.csv"}}})"),
       {{"a.csv", "time,temperature_c\n2026-06-21T10:00Z,10\n2026-06-21T11:00Z,20\n"}, {"w.csv", weather()}}},
      {"temperatures in a file",
       "file",
       solved(R"("table": {"file": "FILEa.csv"}, "solar_absorptance": 0.7, "emissivity": 0.9)"),
       {{"a.csv", "time,temperature_k\n2026-06-21T10:00Z,290\n2026-06-21T11:00Z,300\n"},
        {"w.csv", weather()}}},
      {"distortion table",
       "file",
       {.camera = frame_with(R"("distortion": {"table": {"file": "FILEa.csv"}})")},
       {{"a.csv", "radius_mm,displaced_mm\n0.02,0.0199\n0.04,0.0396\n"}}},
      {"table of elements",
       "file",
       {.camera = frame_with(R"("elements": {"file": "FILEa.csv"})")},
       {{"a.csv",
         "column,row,across_mrad,along_mrad\n1,1,-0.3,-0.3\n4,1,0.3,-0.3\n1,4,-0.3,0.3\n4,4,0.3,0.3\n"}}},
      {"vignetting table",
       "file",
       {.camera = frame_with(R"("elements": {"file": "FILEb.csv"})"),
        .sensor =
            R"(, "optics": {"f_number": 2, "vignetting": {"table": {"file": "FILEa.csv"}}}, "detector": {"integration_time": "1 ms", "quantum_efficiency": 0.7, "read_noise": "20 e-", "full_well": "100 ke-", "bits": 12})"},
       {{"a.csv", "height_mm,share\n0,1\n0.04,0.8\n"},
        {"b.csv",
         "column,row,across_mrad,along_mrad\n1,1,-0.3,-0.3\n4,1,0.3,-0.3\n1,4,-0.3,0.3\n4,4,0.3,0.3\n"}}},
      {"weather",
       "file",
       {.more = R"(, "weather": {"file": "FILEa.csv"})"},
       {{"a.csv",
         "time,air_temperature_c,wind_speed_m_s\n2026-06-21T10:00:00Z,20,3\n2026-06-21T11:00:00Z,22,4\n"}}},
      {"path table",
       "file",
       {.camera = kScanner, .more = R"(, "platform": {"table": {"frame": "scene", "file": "FILEa.csv"}})"},
       {{"a.csv", "time_s,x_m,y_m,z_m\n0,0,-4,1000\n0.1,0,4,1000\n"}}},
      {"tabulated jitter",
       "file",
       {.camera = kScanner,
        .more =
            R"(, "platform": {"straight": {"frame": "scene", "position": ["0 m", "-4 m", "1 km"], "velocity": ["0 m/s", "80 m/s", "0 m/s"]},
                               "jitter": {"table": {"file": "FILEa.csv"}}})"},
       {{"a.csv", "frequency_hz,roll_rad2_hz\n0.5,1e-14\n60,1e-14\n"}}},
      {"table of a mount",
       "file",
       {.camera = kScanner,
        .more =
            R"(, "platform": {"straight": {"frame": "scene", "position": ["0 m", "-4 m", "1 km"], "velocity": ["0 m/s", "80 m/s", "0 m/s"]},
                               "mount": {"table": {"file": "FILEa.csv"}}})"},
       {{"a.csv", "time_s,yaw_deg,pitch_deg,roll_deg\n-10,0,0,0\n10,0,0.1,0\n"}}},
      {"orbit",
       "file",
       {.camera = kScanner,
        .scene = R"("origin": {"latitude": "-54.9462 deg", "longitude": "122.8773 deg"}, )",
        .more =
            R"(, "time": "2006-06-25T21:00:00Z", "platform": {"orbit": {"frame": "teme", "file": "FILEa.tle"}})"},
       {{"a.tle",
         "1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985\n"
         "2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774\n"}}},
      {"tabulated channel",
       "file",
       {.channel =
            R"({"name": "c", "tabulated": {"file": "FILEa.txt", "wavelength_unit": "nm", "band": "2"}})"},
       {{"a.txt", ";; BAND 1\n443 0.1\n444 1\n445 0.2\n;; BAND 2\n490 0\n500 1\n510 0\n"}}},
      {"smile table",
       "centers",
       {.sensor = R"(, "smile": {"table": {"centers": "FILEa.csv", "wavelength_unit": "nm"}})"},
       {{"a.csv", "550.4,610\n550,610\n550,610\n550,609.8\n"}}},
      {"smile table",
       "fwhm",
       {.sensor =
            R"(, "smile": {"table": {"centers": "FILEa.csv", "fwhm": "FILEb.csv", "wavelength_unit": "nm"}})"},
       {{"a.csv", "550.4,610\n550,610\n550,610\n550,609.8\n"}, {"b.csv", "21,20\n20,20\n20,20\n20,20\n"}}},
      {"keystone table",
       "file",
       {.sensor = R"(, "keystone": {"table": {"file": "FILEa.csv"}})"},
       {{"a.csv", "0.1,0\n0,0\n0,0\n0,-0.1\n"}}},
      {"kernel PSF",
       "file",
       {.sensor = R"(, "psf": {"kernel": {"file": "FILEa.asc", "samples_per_pixel": 2}})"},
       {{"a.asc", grid()}}},
  };
}

}  // namespace

std::string Named::document(const std::string& in_place_of_FILE) const {
  const std::string text = R"({"ifov": 1,
  "scene": {)" + parts.scene +
                           R"("materials": {"m": {)" + parts.material + "}" + parts.more_materials + R"(},
            "prototypes": {"ball": [{"sphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0.5 m"}, "material": "m"}]},
            "objects": [)" +
                           parts.object + R"(]},
  "light": {"sun": )" + parts.sun +
                           ", " + parts.sky + R"(},
  "sensor": {)" + (parts.camera.empty() ? "" : R"("camera": )" + parts.camera + ", ") +
                           R"(
             "channels": [)" +
                           parts.channel + ", " + parts.thermal + "]" + parts.sensor + R"(},
  "sampling": {"single": {}})" +
                           parts.more + "}";
  return replaced_all(text, "FILE", in_place_of_FILE);
}

std::vector<Named> all_named() {
  std::vector<Named> all = named_by_materials();
  for (const std::vector<Named>& more : {named_by_objects(), named_elsewhere()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

const Named& named(const std::vector<Named>& all, const std::string& section) {
  return *std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.section == section; });
}

std::string replaced_all(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

}  // namespace facade_test
