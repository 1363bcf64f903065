#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "io/spectra/asd.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_asd {
namespace {

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

template <class T>
std::string numbers(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) {
    const T number = static_cast<T>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return bytes;
}

/// A file of three channels from 350 nm on; `data_type` 0 raw, 1 reflectance; `format_code` 0 float, 1 integer, 2 double.
std::string asd_file(const std::string& version, int data_type, int format_code, const std::string& data,
                     const std::string& behind = {}) {
  std::string bytes(484, '\0');
  bytes.replace(0, 3, version);
  put(bytes, 186, static_cast<unsigned char>(data_type));
  put(bytes, 191, 350.0f);
  put(bytes, 195, 1.0f);
  put(bytes, 199, static_cast<unsigned char>(format_code));
  put(bytes, 204, static_cast<unsigned short>(3));
  return bytes + data + behind;
}

std::string reference(const std::string& data) {
  std::string bytes(20, '\0');
  put(bytes, 0, static_cast<unsigned short>(0xffff));
  put(bytes, 18, static_cast<unsigned short>(4));
  return bytes + "note" + data;
}

std::string error_of(const std::string& bytes) {
  try {
    parse_asd(bytes, "a.asd");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Asd, DividesBySpectrumOfTheWhiteReference) {
  const auto file =
      asd_file("as7", 1, 2, numbers<double>({1.0, 2.0, 3.0}), reference(numbers<double>({4.0, 4.0, 4.0})));
  const SampleSpectrum s = parse_asd(file, "a.asd");
  EXPECT_EQ(s.quantity, SampleQuantity::reflectance);
  EXPECT_NEAR(s.values.at(0.351), 0.5, 1e-12);
  EXPECT_NEAR(s.values.last_um(), 0.352, 1e-9);
  const auto raw = asd_file("as8", 0, 1, numbers<int>({10, 20, 30}), reference(numbers<int>({40, 40, 40})));
  EXPECT_NEAR(parse_asd(raw, "a.asd").values.at(0.352), 0.75, 1e-12);
}

TEST(Asd, EveryVersionWithoutReferenceHoldsReflectanceItself) {
  for (const char* version : {"ASD", "as2", "as3", "as4", "as5", "as6", "as7", "as8"})
    EXPECT_NEAR(parse_asd(asd_file(version, 1, 0, numbers<float>({0.1, 0.2, 0.3})), "a.asd").values.at(0.351),
                0.2, 1e-7)
        << version;
}

TEST(Asd, ErrorsSayWhatIsWrong) {
  const std::string three = numbers<float>({0.1, 0.2, 0.3});
  EXPECT_EQ(error_of("PNG"),
            "a.asd: it does not start as a file of an ASD spectrometer does ('ASD', 'as2' to 'as8')");
  EXPECT_EQ(error_of(""),
            "a.asd: it does not start as a file of an ASD spectrometer does ('ASD', 'as2' to 'as8')");
  EXPECT_EQ(error_of("as7"), "a.asd: the file ends at byte 3; expected a number at byte 204");
  EXPECT_EQ(error_of(asd_file("as7", 1, 0, three.substr(0, 11))),
            "a.asd: the file ends at byte 495; expected 3 values of 4 bytes from byte 484 on");
  EXPECT_EQ(
      error_of(asd_file("as7", 2, 0, three)),
      "a.asd: it holds radiance; expected reflectance, transmittance, or raw counts with a white reference");
  EXPECT_EQ(error_of(asd_file("as7", 0, 0, three)), "a.asd: it holds raw counts and no white reference");
  EXPECT_EQ(error_of(asd_file("as7", 1, 3, three)),
            "a.asd: the format of its data is 3; expected 0 (float), 1 (integer) or 2 (double)");
  EXPECT_EQ(error_of(asd_file("as7", 77, 0, three)), "a.asd: the type of its data is 77; expected 0 to 8");
  EXPECT_EQ(error_of(asd_file("as7", 1, 0, three, reference(numbers<float>({1, 0, 1})).substr(0, 30))),
            "a.asd: the file ends at byte 526; expected 3 values of 4 bytes from byte 520 on");
  EXPECT_EQ(error_of(asd_file("as7", 1, 0, three, reference(numbers<float>({1, 0, 1})))),
            "a.asd: its value at 0.351 um is not a finite number");
}

TEST(Asd, ReferenceFiles) {
  int values = 0;
  for (const char* name : {"ribb00001.asd", "ribb00002.asd", "ribb00003.asd"}) {
    const auto file = test::truth_file(std::string("spectra/asd/") + name);
    if (!file) GTEST_SKIP() << "reference data not found: spectra/asd";
    const SampleSpectrum s = read_asd(*file);
    std::ifstream expected(*test::truth_file(std::string("spectra/asd/") + name + ".txt"));
    std::string line;
    std::getline(expected, line);
    while (std::getline(expected, line)) {
      const std::size_t semicolon = line.find(';');
      if (semicolon == std::string::npos) continue;
      const double um = 1e-3 * std::stod(line.substr(0, semicolon)),
                   value = std::stod(line.substr(semicolon + 1));
      EXPECT_NEAR(s.values.at(std::min(um, s.values.last_um())), value, 1e-5 * std::max(1.0, value))
          << name << " at " << um;
      ++values;
    }
  }
  EXPECT_EQ(values, 3 * 2151);
}

}  // namespace
}  // namespace ifov::io::test_spectra_asd
