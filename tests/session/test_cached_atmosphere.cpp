// An atmosphere is worked out once: what comes after is the same picture, byte for byte.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/format.h"
#include "core/run_control.h"
#include "io/document/document.h"
#include "session/assembly/atmosphere/atmosphere_cache.h"
#include "session/session.h"

namespace ifov::session::test_cached_atmosphere {
namespace {

namespace fs = std::filesystem;

class Words final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += message + "\n"; }
  std::string text;
};

class CountSteps final : public ProgressSink {
 public:
  void report(const Progress& progress) override {
    ++reports;
    last = progress;
  }
  int reports = 0;
  Progress last;
};

class CachedAtmosphere : public testing::Test {
 protected:
  CachedAtmosphere() : folder_(fs::temp_directory_path() / format("ifov_air_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~CachedAtmosphere() override { fs::remove_all(folder_); }

  struct Run {
    std::string image, words;
    CountSteps steps;
  };
  Run render(bool cache, int visibility_km = 23) const {
    const io::Document document = io::parse_document(format(R"({{"ifov": 1, "scene": {{
      "materials": {{"sand": {{"reflectance": 0.4}}, "soil": {{"reflectance": 0.2}}}},
      "objects": [{{"plane": {{}}, "material": "soil"}},
                  {{"box": {{"low": ["-1 m", "-1 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}}, "material": "sand"}}]}},
      "light": {{"sun": {{"point": {{"zenith": "40 deg", "azimuth": "130 deg"}}}}}},
      "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"visibility": "{} km"}}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [6, 6]}}}},
                 "channels": [{{"name": "v", "series": {{"gaussian":
                   {{"from": "0.70 um", "to": "0.98 um", "count": 8, "fwhm": "3 nm"}}}}}}]}},
      "sampling": {{"grid": {{"elements": [2, 2]}}, "max_depth": 2}}}})",
                                                            visibility_km),
                                                     (folder_ / "scene.json").string());
    Words words;
    Run run;
    RunOptions options;
    options.output_folder = folder_ / "out";
    Session::load(document, &words, {.scene_cache = cache, .progress = &run.steps}).render(options);
    std::ifstream file(options.output_folder / "image_radiance.img", std::ios::binary);
    run.image.assign(std::istreambuf_iterator<char>(file), {});
    run.words = words.text;
    EXPECT_FALSE(run.image.empty());
    fs::remove_all(options.output_folder);
    return run;
  }
  std::string cache_bytes() const {
    std::ifstream file(cache(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path cache() const { return folder_ / "scene.ifovcache"; }

  fs::path folder_;
};

TEST_F(CachedAtmosphere, IsTheSamePicture) {
  const Run plain = render(false);
  EXPECT_FALSE(fs::exists(cache()));
  EXPECT_GE(plain.steps.reports, 20);
  EXPECT_EQ(plain.steps.last.pixels_done, plain.steps.last.pixels_total);
  const Run first = render(true);
  ASSERT_TRUE(fs::exists(cache()));
  const std::string kept = cache_bytes();
  const Run second = render(true);
  EXPECT_EQ(first.image, plain.image);
  EXPECT_EQ(second.image, plain.image);
  EXPECT_EQ(second.words, plain.words) << "a cache that is used says nothing";
  EXPECT_EQ(cache_bytes(), kept);
  // Other air is other solutions.
  const Run hazy = render(true, 8);
  EXPECT_EQ(hazy.image, render(false, 8).image);
  EXPECT_NE(hazy.image, plain.image);
  EXPECT_NE(cache_bytes(), kept);
}

TEST_F(CachedAtmosphere, IsWorkedOutAgainWhereTheCacheIsDamaged) {
  const Run first = render(true);
  {
    std::fstream file(cache(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(5000);
    const char byte = static_cast<char>(file.get() ^ 4);
    file.seekp(5000);
    file.put(byte);
  }
  const Run again = render(true);
  EXPECT_EQ(again.image, first.image);
  EXPECT_NE(again.words.find("is not used: it is damaged"), std::string::npos) << again.words;
  EXPECT_EQ(render(true).words.find("damaged"), std::string::npos);
}

TEST_F(CachedAtmosphere, KnowsWhatItWasTold) {
  const auto question = [](double k) { return std::vector<double>{k, 1.0, 2.0}; };
  {
    io::SceneCache file(cache(), "1", nullptr);
    AtmosphereCache solutions(file);
    for (int k = 0; k < 60; ++k) solutions.keep(question(k), std::vector<double>{0.5 * k, -1.0});
    solutions.save();
    file.save();
  }
  Words words;
  io::SceneCache file(cache(), "1", &words);
  AtmosphereCache solutions(file);
  std::vector<double> answer(2), longer(3);
  EXPECT_TRUE(solutions.find(question(7), answer));
  EXPECT_EQ(answer, (std::vector<double>{3.5, -1.0}));
  EXPECT_FALSE(solutions.find(question(7.5), answer));
  EXPECT_FALSE(solutions.find(question(7), longer));
  EXPECT_EQ(words.text, "");
}

TEST_F(CachedAtmosphere, RefusesARecordThatMakesNoSense) {
  const std::vector<std::uint64_t> wrong{1, 2, 1000};  // a thousand numbers that are not there
  {
    io::SceneCache file(cache(), "1", nullptr);
    const auto bytes = std::as_bytes(std::span(wrong));
    file.put("atmosphere", {}, std::span(&bytes, 1));
    file.save();
  }
  Words words;
  io::SceneCache file(cache(), "1", &words);
  AtmosphereCache solutions(file);
  EXPECT_NE(words.text.find("'atmosphere' in the scene cache"), std::string::npos) << words.text;
}

}  // namespace
}  // namespace ifov::session::test_cached_atmosphere
