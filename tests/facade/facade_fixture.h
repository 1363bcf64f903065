#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "ifov/ifov.h"

/// A small scene, its products and its tiles in memory, for the tests of the facade.
namespace facade_test {

namespace fs = std::filesystem;

constexpr int kWidth = 37, kHeight = 22;

/// Whether this library draws figures: built with Cairo.
inline bool draws_figures() {
  const std::vector<ifov::Material> found = ifov::search_materials("grass, lawn");
  try {
    return !ifov::material_figure(found[0], ifov::curves_of(found[0], "1")).empty();
  } catch (const ifov::SystemError&) {
    return false;
  }
}

/// Spheres on the ground under a black sky: loading warns of nothing.
inline const std::string kScene = R"({"ifov": 1, "seed": 5,
  "scene": {"materials": {"ground": {"reflectance": 0.3, "temperature": "20 degC"},
                          "ball": {"reflectance": 0.6, "temperature": "35 degC"}},
            "objects": [{"plane": {}, "material": "ground"},
                        {"sphere": {"center": ["-2 m", "1 m", "1 m"], "radius": "1.4 m"}, "material": "ball"},
                        {"sphere": {"center": ["3 m", "-1 m", "1 m"], "radius": "0.9 m"}, "material": "ball"}]},
  "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
  "sensor": {"camera": {"orthographic": {"gsd": "0.3 m", "pixels": [37, 22]}},
             "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
                          {"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}}]},
  "sampling": {"accuracy": {"error": "4 %"}, "tile": 16},
  "output": {"formats": ["envi", "geotiff", "netcdf")" +
                                  std::string(draws_figures() ? ", \"png\"" : "") + "]}}";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// Far more work than a test waits for.
inline std::string endless() {
  return replaced(replaced(kScene, "[37, 22]", "[4000, 4000]"), "\"4 %\"", "\"0.001 %\"");
}

inline std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every product by its name; of the run record all lines but those that say when, where and how fast.
inline std::map<std::string, std::string> products(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    std::string& content = found[name];
    if (name.ends_with(".nc")) {
      content = "the values of the others, with the date";
    } else if (name.ends_with("_run.json")) {
      std::ifstream lines(entry.path());
      for (std::string line; std::getline(lines, line);)
        if (line.find("\"date\"") == std::string::npos && line.find("\"elapsed_s\"") == std::string::npos &&
            line.find("\"threads\"") == std::string::npos && line.find("sha256") == std::string::npos)
          content += line + "\n";
    } else {
      content = bytes_of(entry.path());
    }
  }
  return found;
}

inline void expect_same(const std::map<std::string, std::string>& these,
                        const std::map<std::string, std::string>& those) {
  EXPECT_EQ(these.size(), those.size());
  for (const auto& [name, content] : those)
    EXPECT_TRUE(these.contains(name) && these.at(name) == content) << name;
}

struct Ran {
  int code = 0;
  std::string out, err;
};

class Facade : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ifov_facade_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ifov::Document scene() const { return ifov::Document::parse(kScene, "scene.json", folder_); }

  /// The program, for comparison.
  Ran program(const std::string& arguments) const {
    const std::string out = folder_ / "stdout.txt", err = folder_ / "stderr.txt";
    const int status = std::system((IFOV_PROGRAM " " + arguments + " >" + out + " 2>" + err).c_str());
    return {WEXITSTATUS(status), bytes_of(out), bytes_of(err)};
  }

  fs::path folder_;
};

/// Puts tiles together, by the shapes that tile.h states.
class Cube final : public ifov::TileSink {
 public:
  void begin(const ifov::ImageDescription& image) override {
    image_ = image;
    const std::size_t pixels = static_cast<std::size_t>(image.width_px) * image.height_px;
    radiance.resize(pixels * image.channels.size());
    half_width.resize(radiance.size());
    samples.resize(pixels);
    reasons.resize(pixels);
  }
  void write(const ifov::Tile& tile) override {
    const std::scoped_lock lock(mutex_);
    ++tiles;
    for (int row = 0; row < tile.height_px; ++row)
      for (int column = 0; column < tile.width_px; ++column) {
        const std::size_t from = static_cast<std::size_t>(row) * tile.width_px + column;
        const std::size_t x = tile.x_px + column, y = tile.y_px + row;
        samples[y * image_.width_px + x] = tile.samples[from];
        reasons[y * image_.width_px + x] = tile.reasons[from];
        for (int c = 0; c < tile.channels; ++c) {  // by lines, as an ENVI cube of interleave "bil" has them
          const std::size_t to = (y * tile.channels + c) * image_.width_px + x;
          radiance[to] = tile.radiance[from * tile.channels + c];
          half_width[to] = tile.half_width[from * tile.channels + c];
        }
      }
  }

  int tiles = 0;
  std::vector<float> radiance, half_width;
  std::vector<std::uint32_t> samples;
  std::vector<std::uint16_t> reasons;

 private:
  std::mutex mutex_;
  ifov::ImageDescription image_;
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Of a cube of 32-bit numbers: all points of a pixel come before those of either kind.
inline std::string first_band_of_three(const std::string& cube) {
  constexpr std::size_t kLine = 4 * kWidth;
  std::string band;
  for (std::size_t line = 0; line < cube.size() / kLine; line += 3) band += cube.substr(line * kLine, kLine);
  return band;
}

/// Keeps what is said, from any thread.
class Words final : public ifov::LogSink, public ifov::ProgressSink {
 public:
  void info(const std::string& message) override { keep(infos, message); }
  void warn(const std::string& message) override { keep(warnings, message); }
  void report(const ifov::Progress& progress) override {
    const std::scoped_lock lock(mutex_);
    last = progress;
  }
  void phase(const std::string& what) override { keep(phases, what); }

  std::vector<std::string> infos, warnings, phases;
  ifov::Progress last;

 private:
  void keep(std::vector<std::string>& list, const std::string& message) {
    const std::scoped_lock lock(mutex_);
    list.push_back(message);
  }
  std::mutex mutex_;
};

}  // namespace facade_test
