// A scene of large files is read once: what comes after is the same picture, byte for byte.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/format.h"
#include "core/run_control.h"
#include "io/document/document.h"
#include "session/session.h"

namespace ifov::session::test_cached_scene {
namespace {

namespace fs = std::filesystem;

class Words final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += message + "\n"; }
  std::string text;
};

class CachedScene : public testing::Test {
 protected:
  CachedScene() : folder_(fs::temp_directory_path() / format("ifov_cached_{}", getpid())) {
    fs::create_directories(folder_);
    write_ground(0.4);
    std::ofstream places(folder_ / "places.csv");
    for (int k = 0; k < 6000; ++k)
      places << 0.1 * (k % 80) - 4.0 << ',' << 0.1 * (k / 80) - 4.0 << ",0," << 7 * k % 360 << ",1\n";
  }
  ~CachedScene() override { fs::remove_all(folder_); }

  /// Waves of two materials on a grid of 100 by 100 cells.
  void write_ground(double height_m) const {
    std::ofstream file(folder_ / "ground.obj");
    constexpr int kCells = 100;
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i)
        file << format("v {:.3f} {:.3f} {:.3f}\n", 0.08 * i - 4.0, 0.08 * j - 4.0,
                       height_m * std::sin(0.3 * i) * std::cos(0.2 * j));
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        const int a = j * (kCells + 1) + i + 1, d = a + kCells + 2;
        file << format("usemtl {}\nf {} {} {}\nf {} {} {}\n", (i / 7 + j / 9) % 2 == 0 ? "sand" : "soil", a,
                       a + 1, d, a, d, d - 1);
      }
  }

  struct Run {
    std::string image, words;
  };
  Run render(bool cache, const std::string& ground = R"({"mesh": {"file": "ground.obj"}, "material": {"slots":
                                                     {"sand": "sand", "soil": "soil"}}})",
             int threads = 0) const {
    const io::Document document = io::parse_document(R"({"ifov": 1, "scene": {
      "materials": {"sand": {"reflectance": 0.5}, "soil": {"reflectance": 0.2}, "leaf": {"reflectance": 0.7}},
      "prototypes": {"card": [{"box": {"low": ["-0.02 m", "-0.01 m", "0 m"], "high": ["0.02 m", "0.01 m", "0.5 m"]},
                               "material": "leaf"}],
                     "tuft": [{"instance": {"of": "card"}},
                              {"instance": {"of": "card"}, "transform": {"rotate": {"angle": "90 deg"}}}]},
      "objects": [)" + ground + R"(,
                  {"instances": {"of": "tuft", "csv": "places.csv"}}]},
      "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "130 deg"}}},
      "sensor": {"camera": {"orthographic": {"gsd": "0.25 m", "pixels": [24, 24]}},
                 "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
      "sampling": {"grid": {"elements": [4, 4]}, "max_depth": 2}})",
                                                     (folder_ / "scene.json").string());
    Words words;
    RunOptions options;
    options.output_folder = folder_ / "out";
    options.threads = threads;
    Session::load(document, &words, {.scene_cache = cache}).render(options);
    std::ifstream file(options.output_folder / "image_radiance.img", std::ios::binary);
    Run run{{std::istreambuf_iterator<char>(file), {}}, words.text};
    EXPECT_FALSE(run.image.empty());
    fs::remove_all(options.output_folder);
    return run;
  }

  fs::path cache() const { return folder_ / "scene.ifovcache"; }

  fs::path folder_;
};

TEST_F(CachedScene, IsTheSamePicture) {
  const Run plain = render(false);
  EXPECT_FALSE(fs::exists(cache()));
  const Run first = render(true);
  ASSERT_TRUE(fs::exists(cache()));
  EXPECT_GT(fs::file_size(cache()), 600000u);
  const Run second = render(true);
  EXPECT_EQ(first.image, plain.image);
  EXPECT_EQ(second.image, plain.image);
  EXPECT_EQ(second.words, plain.words) << "a cache that is used says nothing";
}

TEST_F(CachedScene, IsReadAgainWhereItsFilesHaveChanged) {
  render(true);
  write_ground(0.7);
  const Run changed = render(true), plain = render(false);
  EXPECT_EQ(changed.image, plain.image);
  EXPECT_NE(changed.words.find("'ground.obj' has changed since"), std::string::npos) << changed.words;
  EXPECT_EQ(render(true).words, plain.words);
}

TEST_F(CachedScene, IsReadAgainWhereABufferBesideAMeshHasChanged) {
  constexpr std::uint32_t kCells = 100, kNodes = kCells + 1, kVertices = kNodes * kNodes,
                          kIndices = 6 * kCells * kCells;
  const auto write_buffer = [&](float height_m) {
    std::ofstream file(folder_ / "waves 1.bin", std::ios::binary);
    const auto put = [&](auto values) {
      file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(sizeof values));
    };
    for (std::uint32_t j = 0; j < kNodes; ++j)  // y up: the rows run to the south
      for (std::uint32_t i = 0; i < kNodes; ++i)
        put(std::array{0.08f * float(i) - 4.0f, height_m * std::sin(0.3f * float(i)),
                       4.0f - 0.08f * float(j)});
    for (std::uint32_t j = 0; j < kCells; ++j)
      for (std::uint32_t i = 0; i < kCells; ++i) {
        const std::uint32_t a = j * kNodes + i, d = a + kNodes + 1;
        put(std::array{a, a + 1, d, a, d, d - 1});
      }
  };
  std::ofstream(folder_ / "waves.gltf") << format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
           "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
           "buffers": [{{"uri": "waves%201.bin", "byteLength": {0}}}],
           "bufferViews": [{{"buffer": 0, "byteLength": {1}}}, {{"buffer": 0, "byteOffset": {1}, "byteLength": {2}}}],
           "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": {3}}},
                         {{"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": {4}}}]}})",
      12 * kVertices + 4 * kIndices, 12 * kVertices, 4 * kIndices, kVertices, kIndices);
  const char* waves = R"({"mesh": {"file": "waves.gltf"}, "material": "soil"})";
  write_buffer(0.4f);
  const Run first = render(true, waves);
  EXPECT_EQ(first.image, render(true, waves).image);
  write_buffer(0.7f);
  const Run changed = render(true, waves);
  EXPECT_NE(changed.image, first.image);
  EXPECT_EQ(changed.image, render(false, waves).image);
  EXPECT_NE(changed.words.find("'waves 1.bin' has changed since"), std::string::npos) << changed.words;
}

TEST_F(CachedScene, KeepsATerrainAndWhatWasSaidOfIt) {
  const auto write_heights = [&](double height_m) {
    std::ofstream file(folder_ / "heights.asc");
    file << "ncols 90\nnrows 90\nxllcorner -4.5\nyllcorner -4.5\ncellsize 0.1\nnodata_value -9\n";
    for (int j = 0; j < 90; ++j)
      for (int i = 0; i < 90; ++i)
        file << (i == 40 && j == 40 ? -9.0 : height_m * std::sin(0.3 * i) * std::cos(0.2 * j))
             << (i == 89 ? '\n' : ' ');
  };
  write_heights(0.4);
  const char* terrain = R"({"terrain": {"file": "heights.asc", "detail": "0.001 m"}, "material": "soil"})";
  const char* coarse = R"({"terrain": {"file": "heights.asc", "detail": "0.002 m"}, "material": "soil"})";
  const Run plain = render(false, terrain), first = render(true, terrain), second = render(true, terrain);
  EXPECT_GT(fs::file_size(cache()), 500000u);
  EXPECT_EQ(first.image, plain.image);
  EXPECT_EQ(second.image, plain.image);
  EXPECT_EQ(second.words, plain.words);
  EXPECT_NE(second.words.find("1 of 8100 cells have no height"), std::string::npos) << second.words;
  // Another detail and other heights are other terrains.
  EXPECT_EQ(render(true, coarse).image, render(false, coarse).image);
  write_heights(0.3);
  const Run changed = render(true, coarse);
  EXPECT_EQ(changed.image, render(false, coarse).image);
  EXPECT_NE(changed.words.find("'heights.asc' has changed since"), std::string::npos) << changed.words;
}

TEST_F(CachedScene, IsReadAgainWhereTheCacheIsDamaged) {
  const Run first = render(true);
  {
    std::fstream file(cache(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(300000);
    const char byte = static_cast<char>(file.get() ^ 4);
    file.seekp(300000);
    file.put(byte);
  }
  const Run again = render(true);
  EXPECT_EQ(again.image, first.image);
  EXPECT_NE(again.words.find("is not used: it is damaged"), std::string::npos) << again.words;
  EXPECT_EQ(render(true).words.find("damaged"), std::string::npos);
}

TEST_F(CachedScene, OfManyTrianglesIsTheSameWithAnyNumberOfThreads) {
  // More than are built at once: two triangles each for 1030 x 1030 cells.
  constexpr std::uint32_t kCells = 1030, kNodes = kCells + 1;
  {
    std::ofstream file(folder_ / "large.ply", std::ios::binary);
    file << format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        kNodes * kNodes, 2 * kCells * kCells);
    const auto put = [&](const auto& values) {
      file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(sizeof values));
    };
    for (std::uint32_t j = 0; j < kNodes; ++j)
      for (std::uint32_t i = 0; i < kNodes; ++i)
        put(std::array{0.008f * float(i) - 4.0f, 0.008f * float(j) - 4.0f,
                       0.3f * std::sin(0.03f * float(i) + 0.02f * float(j))});
    for (std::uint32_t j = 0; j < kCells; ++j)
      for (std::uint32_t i = 0; i < kCells; ++i) {
        const std::uint32_t a = j * kNodes + i, d = a + kNodes + 1;
        file.put(3), put(std::array{a, a + 1, d});
        file.put(3), put(std::array{a, d, d - 1});
      }
  }
  const char* large = R"({"mesh": {"file": "large.ply"}, "material": "soil"})";
  const Run plain = render(false, large), first = render(true, large, 1), second = render(true, large, 7);
  EXPECT_NE(plain.words.find("chunks of large meshes"), std::string::npos) << plain.words;
  EXPECT_EQ(first.image, plain.image);
  EXPECT_EQ(second.image, plain.image);
  EXPECT_EQ(second.words, plain.words);
  {  // a vertex of some chunk
    std::fstream file(cache(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8000003);
    file.put('\x41');
  }
  const Run again = render(true, large);
  EXPECT_EQ(again.image, plain.image);
  EXPECT_NE(again.words.find("is not used: it is damaged"), std::string::npos) << again.words;
  EXPECT_EQ(render(true, large).words, plain.words);
}

}  // namespace
}  // namespace ifov::session::test_cached_scene
