#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "io/products/envi_reader.h"
#include "io/synthetic_image.h"
#include "support/truth_data.h"

namespace ifov::io::test_envi {
namespace {

const char* const kHeader =
    "ENVI\n"
    "description = {two\nlines}\n"
    "samples = 3\n"
    "lines   = 2\n"
    "bands   = 2\n"
    "header offset = 4\n"
    "file type = ENVI Standard\n"
    "data type = 12\n"
    "interleave = BIP\n"
    "; a comment\n"
    "byte order = 1\n"
    "wavelength units = Nanometers\n"
    "wavelength = { 450.5,\n 1e3 }\n"
    "band names = {blue, near infrared}\n"
    "sensor type = Unknown\n";

std::string error_of(const std::string& text) {
  try {
    parse_envi_header(text, "x.hdr");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(EnviHeader, ReadsFields) {
  const EnviHeader h = parse_envi_header(kHeader, "x.hdr");
  EXPECT_EQ(h.samples, 3);
  EXPECT_EQ(h.lines, 2);
  EXPECT_EQ(h.bands, 2);
  EXPECT_EQ(h.header_offset, 4u);
  EXPECT_EQ(h.data_type, EnviType::uint16);
  EXPECT_EQ(h.interleave, EnviInterleave::bip);
  EXPECT_TRUE(h.big_endian);
  EXPECT_EQ(h.description, "two\nlines");
  EXPECT_EQ(h.wavelength, (std::vector<double>{450.5, 1000.0}));
  EXPECT_EQ(h.band_names, (std::vector<std::string>{"blue", "near infrared"}));
  EXPECT_EQ(h.other.at("sensor type"), "Unknown");
}

TEST(EnviHeader, SurvivesWritingAndReading) {
  EnviHeader h = parse_envi_header(kHeader, "x.hdr");
  h.fwhm = {10.0, 12.25};
  h.map_info = {"Arbitrary", "1", "1", "0", "0", "0.5", "0.5", "units=Meters"};
  h.data_units = "W m-2 sr-1 um-1";
  h.default_bands = {2};
  const EnviHeader again = parse_envi_header(to_text(h), "y.hdr");
  EXPECT_EQ(to_text(again), to_text(h));
  EXPECT_EQ(again.fwhm, h.fwhm);
  EXPECT_EQ(again.map_info, h.map_info);
  EXPECT_EQ(again.data_units, h.data_units);
}

TEST(EnviHeader, NamesCannotBreakTheFormat) {
  EnviHeader h = parse_envi_header(kHeader, "x.hdr");
  h.band_names = {"a, {b}", "c\nd"};
  h.description = "has } a brace";
  const EnviHeader again = parse_envi_header(to_text(h), "y.hdr");
  EXPECT_EQ(again.band_names, (std::vector<std::string>{"a; (b)", "c d"}));
  EXPECT_EQ(again.samples, 3);
}

TEST(EnviHeader, ErrorsNameLineKeyAndExpectation) {
  EXPECT_EQ(error_of("samples = 3\n"), "x.hdr:1: not an ENVI header: the first line must be \"ENVI\"");
  EXPECT_EQ(error_of(""), "x.hdr: the file is empty; expected an ENVI header");
  EXPECT_EQ(error_of(replaced(kHeader, "samples = 3", "samples = three")),
            "x.hdr:4: \"samples\" is \"three\"; expected a whole number");
  EXPECT_EQ(error_of(replaced(kHeader, "samples = 3", "samples = 0")),
            "x.hdr:4: \"samples\" is \"0\"; expected a whole number of at least 1");
  EXPECT_EQ(error_of(replaced(kHeader, "samples = 3\n", "")), "x.hdr: the header has no \"samples\"");
  EXPECT_EQ(error_of(replaced(kHeader, "BIP", "BIX")),
            "x.hdr:10: \"interleave\" is \"BIX\"; expected bsq, bil or bip");
  EXPECT_EQ(error_of(replaced(kHeader, "type = 12", "type = 6")),
            "x.hdr:9: \"data type\" is \"6\"; expected 1, 2, 3, 4, 5, 12 or 13 (real numbers)");
  EXPECT_EQ(error_of(replaced(kHeader, "450.5,", "")),
            "x.hdr:14: \"wavelength\" is \"a list of 1\"; expected 2 items, one a band");
  EXPECT_EQ(error_of(replaced(kHeader, "infrared}", "infrared")),
            "x.hdr:16: \"band names\" opens a brace that is never closed");
  EXPECT_EQ(error_of(replaced(kHeader, "samples = 3", "samples 3")),
            "x.hdr:4: expected \"key = value\", found \"samples 3\"");
  EXPECT_EQ(error_of(replaced(replaced(replaced(kHeader, "samples = 3", "samples = 2147483647"),
                                       "lines   = 2", "lines = 2147483647"),
                              "byte order = 1", "byte order = 2")),
            "x.hdr:12: \"byte order\" is \"2\"; expected 0 (little endian) or 1 (big endian)");
  EXPECT_EQ(error_of(replaced(replaced(kHeader, "samples = 3", "samples = 2147483647"), "lines   = 2",
                              "lines = 2147483647")),
            "x.hdr: 2147483647 x 2147483647 x 2 values are more than any file holds");
}

TEST(EnviHeader, TruncatedTextNeverCrashes) {
  const std::string text = kHeader;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    try {
      parse_envi_header(text.substr(0, n), "x.hdr");
    } catch (const InputError&) {
    }
  }
}

TEST(EnviReader, ConvertsBigEndianBip) {
  const test::ScratchFolder folder("envi_bip");
  std::ofstream(folder.path() / "x.hdr") << kHeader;
  std::ofstream data(folder.path() / "x.img", std::ios::binary);
  data << "skip";
  for (int i = 0; i < 12; ++i) data.put(static_cast<char>(1)).put(static_cast<char>(i));
  data.close();
  const EnviReader reader(folder.path() / "x.img");
  std::vector<float> line(3);
  reader.read(1, 1, line);
  EXPECT_EQ(line, (std::vector<float>{256 + 7, 256 + 9, 256 + 11}));
  std::vector<float> part(2);
  reader.read(1, 1, part, 1);
  EXPECT_EQ(part, (std::vector<float>{256 + 9, 256 + 11}));
  EXPECT_EQ(reader.pixel(2, 1), (std::vector<double>{256 + 10, 256 + 11}));
  EXPECT_THROW(reader.read(1, 1, part, 3), std::out_of_range);
  EXPECT_THROW(reader.pixel(0, 2), std::out_of_range);
}

/// Every value of a cube is its place in band-sequential order, whatever the interleave.
TEST(EnviReader, PixelsAndPartsOfLinesAgreeInAllInterleaves) {
  const int samples = 3, lines = 2, bands = 4;
  for (const char* const interleave : {"bsq", "bil", "bip"}) {
    const test::ScratchFolder folder("envi_interleave");
    std::ofstream(folder.path() / "x.hdr")
        << "ENVI\nsamples = 3\nlines = 2\nbands = 4\ndata type = 1\ninterleave = " << interleave << "\n";
    std::string data(24, '\0');
    for (int b = 0; b < bands; ++b)
      for (int y = 0; y < lines; ++y)
        for (int x = 0; x < samples; ++x) {
          const int at = interleave[1] == 's'   ? (b * lines + y) * samples + x
                         : interleave[2] == 'l' ? (y * bands + b) * samples + x
                                                : (y * samples + x) * bands + b;
          data[static_cast<std::size_t>(at)] = static_cast<char>((b * lines + y) * samples + x);
        }
    std::ofstream(folder.path() / "x.img", std::ios::binary) << data;
    const EnviReader reader(folder.path() / "x.img");
    EXPECT_EQ(reader.pixel(1, 1), (std::vector<double>{4, 10, 16, 22})) << interleave;
    std::vector<float> part(2);
    reader.read(1, 2, part, 1);
    EXPECT_EQ(part, (std::vector<float>{16, 17})) << interleave;
    std::vector<float> line(3);
    for (const int y : {0, 1, 0}) {
      reader.read(y, 3, line);
      const float first = y == 0 ? 18.0F : 21.0F;
      EXPECT_EQ(line, (std::vector<float>{first, first + 1.0F, first + 2.0F})) << interleave;
    }
    const EnviReader moved = EnviReader(folder.path() / "x.img");
    moved.view().read(1, 1, line);
    EXPECT_EQ(line, (std::vector<float>{9, 10, 11})) << interleave;
  }
}

TEST(EnviReader, FilesCutShortWhileTheyAreReadAreSaid) {
  const test::ScratchFolder folder("envi_cut");
  std::ofstream(folder.path() / "x.hdr") << kHeader;
  std::ofstream(folder.path() / "x.img") << std::string(28, 'x');
  const EnviReader reader(folder.path() / "x.img");
  EXPECT_EQ(reader.pixel(2, 1).size(), 2u);
  std::filesystem::resize_file(folder.path() / "x.img", 10);
  EXPECT_THROW(reader.pixel(2, 1), SystemError);
}

TEST(EnviReader, ShortFilesAreSaid) {
  const test::ScratchFolder folder("envi_short");
  std::ofstream(folder.path() / "x.img.hdr") << kHeader;
  std::ofstream(folder.path() / "x.img") << "too short";
  try {
    EnviReader reader(folder.path() / "x.img");
    FAIL() << "no error";
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find("x.img: the file has 9 bytes, its header x.img.hdr asks for 28"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(EnviReader(folder.path() / "absent.img"), SystemError);
}

/// Rows of band, mean, std, first_pixel, last_pixel.
void compare_with_table(const char* cube, const char* table) {
  const auto cube_path = test::truth_file(cube), table_path = test::truth_file(table);
  if (!cube_path || !table_path) GTEST_SKIP() << "reference data not found: " << cube;
  const EnviReader reader(*cube_path);
  const EnviHeader& h = reader.header();
  std::ifstream stream(*table_path);
  std::string row;
  std::getline(stream, row);
  std::vector<float> line(static_cast<std::size_t>(h.samples));
  int bands = 0;
  for (; std::getline(stream, row); ++bands) {
    std::istringstream fields(row);
    double band, mean, deviation, first, last;
    char comma;
    ASSERT_TRUE(fields >> band >> comma >> mean >> comma >> deviation >> comma >> first >> comma >> last);
    double sum = 0.0;
    float first_read = 0.0f;
    for (int y = 0; y < h.lines; ++y) {
      reader.read(y, bands, line);
      if (y == 0) first_read = line.front();
      for (const float value : line) sum += value;
    }
    // The table has seven digits.
    EXPECT_NEAR(sum / (h.samples * h.lines), mean, 1e-6 * std::abs(mean)) << row;
    EXPECT_NEAR(first_read, first, 1e-6 * std::abs(first)) << row;
    EXPECT_NEAR(line.back(), last, 1e-6 * std::abs(last)) << row;
  }
  EXPECT_EQ(bands, h.bands);
  EXPECT_EQ(h.wavelength.size(), static_cast<std::size_t>(h.bands));
}

TEST(EnviReader, EmitCubeHasTheExpectedBandMeans) {
  compare_with_table("cubes/emit/emit20250324t221005_jpl_unmix_ex",
                     "cubes/expected_bandmeans_emit_10x10x285.csv");
}
TEST(EnviReader, GamsbergCubeHasTheExpectedBandMeans) {
  compare_with_table("cubes/gamsberg/cubus_gamsberg_subset",
                     "cubes/expected_bandmeans_gamsberg_10x25x189.csv");
}

TEST(EnviReader, ReadsHeadersOfOtherMakers) {
  const struct {
    const char* name;
    int samples, lines, bands;
    double first_wavelength;
  } cases[] = {{"cubes/headers/avirisng_radiance.hdr", 598, 14397, 425, 377.071821},
               {"cubes/headers/enmap_berlin.hdr", 220, 400, 177, 0.46},
               {"cubes/headers/hires_berlin.hdr", 800, 3327, 3, 665.0}};
  for (const auto& c : cases) {
    const auto path = test::truth_file(c.name);
    if (!path) GTEST_SKIP() << "reference data not found: " << c.name;
    const EnviHeader h = parse_envi_header(test::read_all(*path), path->string());
    EXPECT_EQ(h.samples, c.samples);
    EXPECT_EQ(h.lines, c.lines);
    EXPECT_EQ(h.bands, c.bands);
    EXPECT_EQ(h.wavelength.size(), static_cast<std::size_t>(c.bands)) << c.name;
    if (h.wavelength.empty()) continue;
    EXPECT_NEAR(h.wavelength.front(), c.first_wavelength, 1e-6) << c.name;
  }
}

}  // namespace
}  // namespace ifov::io::test_envi
