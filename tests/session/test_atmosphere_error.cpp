// The atmosphere's own error is part of the intervals of an image, has a product of its own, and is told
// beforehand.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/format.h"
#include "core/run_control.h"
#include "io/document/document.h"
#include "session/session.h"

namespace ifov::session::test_atmosphere_error {
namespace {

namespace fs = std::filesystem;

class Words final : public LogSink {
 public:
  void info(const std::string&) override {}
  void warn(const std::string& message) override { text += message + "\n"; }
  std::string text;
};

class AtmosphereErrorOfImages : public testing::Test {
 protected:
  AtmosphereErrorOfImages() : folder_(fs::temp_directory_path() / format("ifov_air_error_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~AtmosphereErrorOfImages() override { fs::remove_all(folder_); }

  io::Document document(const std::string& error, bool air = true, const char* interval = "numerical") const {
    return io::parse_document(
        format(R"({{"ifov": 1, "scene": {{"materials": {{"soil": {{"reflectance": 0.2}}}},
                   "objects": [{{"plane": {{}}, "material": "soil"}}]}},
                   "light": {{"sun": {{"point": {{"zenith": "40 deg", "azimuth": "130 deg"}}}}}}, {}
                   "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [4, 4]}}}},
                     "channels": [{{"name": "blue", "gaussian": {{"center": "0.48 um", "fwhm": "20 nm"}}}},
                                  {{"name": "nir", "gaussian": {{"center": "0.86 um", "fwhm": "20 nm"}}}}]}},
                   "sampling": {{"accuracy": {{"error": "{}"}}}}, "output": {{"products": ["all"]}}}})",
               air ? format(R"("atmosphere": {{"profile": "US standard 1976"{}}},)",
                            *interval ? format(R"(, "interval": "{}")", interval) : std::string())
                   : std::string(),
               error),
        (folder_ / "scene.json").string());
  }
  std::vector<float> cube(const std::string& name) const {
    std::ifstream file(folder_ / "out" / ("image_" + name + ".img"), std::ios::binary);
    std::vector<float> values(32, -1.0f);
    file.read(reinterpret_cast<char*>(values.data()), 128);
    return values;
  }
  RunSummary render(const io::Document& document, Words& words) const {
    RunOptions options;
    options.output_folder = folder_ / "out";
    return Session::load(document, &words).render(options);
  }
  fs::path folder_;
};

TEST_F(AtmosphereErrorOfImages, IsInTheHalfWidthAndByItself) {
  Words words;
  const RunSummary summary = render(document("3 %"), words);
  EXPECT_EQ(words.text, "");
  EXPECT_EQ(summary.totals.pixels_converged, 16) << summary.accuracy_statement;
  const std::vector<float> mean = cube("radiance"), half = cube("half_width"), air = cube("air_half_width"),
                           standard = cube("standard_error");
  for (std::size_t i = 0; i < half.size(); ++i) {
    EXPECT_GT(air[i], 2e-4f * mean[i]);
    EXPECT_LT(air[i], 1e-2f * mean[i]);
    EXPECT_GE(half[i], air[i] + standard[i]);
    EXPECT_LE(half[i], 0.03f * mean[i] * 1.0001f);
  }
  std::ifstream run(folder_ / "out" / "image_run.json");
  const std::string text{std::istreambuf_iterator<char>(run), {}};
  EXPECT_NE(text.find("air_half_width"), std::string::npos);
}

TEST_F(AtmosphereErrorOfImages, FinerThanTheAirIsToldBeforehandAndEnds) {
  Words words;
  const RunSummary summary = render(document("0.01 W m-2 sr-1 um-1"), words);
  EXPECT_NE(words.text.find(
                "the accuracy asked for is finer than the atmosphere is computed to: over a grey surface the "
                "air's own numerical error is up to 0."),
            std::string::npos)
      << words.text;
  EXPECT_NE(
      words.text.find(
          " W m-2 sr-1 um-1 in 'blue', 'nir'; pixels may miss it there however many rays are traced, and they end where they add a third of that. "),
      std::string::npos)
      << words.text;
  EXPECT_NE(words.text.find(" W m-2 sr-1 um-1 can be reached, or judge other channels"), std::string::npos)
      << words.text;
  EXPECT_EQ(summary.totals.pixels_converged, 0) << summary.accuracy_statement;
  EXPECT_GT(summary.totals.worst_error_ratio, 1.0);
}

// Where a document does not say, intervals hold the model's error: what it cannot keep is told with the channel, and rays are not
// spent on it.
TEST_F(AtmosphereErrorOfImages, IsThatOfTheModelUnlessADocumentSaysOtherwise) {
  const auto run = [&](const char* interval, Words& words) {
    RunSummary summary = render(document("1 %", true, interval), words);
    const std::vector<float> mean = cube("radiance"), half = cube("half_width"),
                             model = cube("air_model_error");
    double least = 1e9, most = 0.0;
    for (std::size_t i = 0; i < half.size(); ++i) {
      EXPECT_GT(model[i], 0.01f * mean[i]);
      least = std::min<double>(least, half[i] / model[i]);
      most = std::max<double>(most, half[i] / model[i]);
    }
    return std::tuple(std::move(summary), least, most);
  };
  Words unsaid, with_model, numerical;
  const auto [summary, least, most] = run("", unsaid);
  EXPECT_GT(least, 1.0);
  EXPECT_LT(most, 1.5);  // the numbers and a third of the air's by rays
  EXPECT_NE(
      unsaid.text.find("the accuracy asked for is finer than the atmosphere is known: over a grey surface "
                       "the air's own error, of numbers and model, is up to "),
      std::string::npos)
      << unsaid.text;
  EXPECT_NE(
      unsaid.text.find(
          " % in 'blue', 'nir'; pixels may miss it there however many rays are traced, and they end where they "
          "add a third of that."),
      std::string::npos)
      << unsaid.text;
  EXPECT_NE(
      summary.accuracy_statement.find("Intervals hold the error of the air's numbers and of its model."),
      std::string::npos)
      << summary.accuracy_statement;
  const auto [same, same_least, same_most] = run("with model", with_model);
  EXPECT_EQ(same_least, least);
  EXPECT_EQ(with_model.text, unsaid.text);
  EXPECT_EQ(same.totals.rays, summary.totals.rays);
  // Twin: the numbers alone are narrower, and take more rays.
  const auto [other, other_least, other_most] = run("numerical", numerical);
  EXPECT_LT(other_most, 1.0);
  EXPECT_EQ(numerical.text, "");
  EXPECT_GT(other.totals.rays, summary.totals.rays);
  EXPECT_NE(other.accuracy_statement.find("Intervals hold the error of the air's numbers"), std::string::npos)
      << other.accuracy_statement;
}

TEST_F(AtmosphereErrorOfImages, WithoutAModelledAtmosphereThereIsNone) {
  Words words;
  render(document("3 %", false), words);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "image_air_half_width.img"));
}

}  // namespace
}  // namespace ifov::session::test_atmosphere_error
