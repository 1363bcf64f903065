// Cells of maps that outshine the rest of their pixels: against sums over the cells.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/planck.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/hash.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_standouts {
namespace {

class KeptTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

class Standouts : public testing::Test {
 protected:
  static constexpr int kPixels = 6, kCells = 20, kSide = kPixels * kCells;  // cells of 1 m, pixels of 20 m

  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_standouts_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_map(const std::string& name, const std::function<double(int column, int row)>& number) const {
    std::ofstream file(folder_ / name);
    file << format("ncols {0}\nnrows {0}\nxllcorner {1}\nyllcorner {1}\ncellsize 1\n", kSide, -0.5 * kSide);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) file << number(column, row) << " ";
      file << "\n";
    }
  }

  /// Black bodies at one wavelength, from above.
  sampling::TileResult rendered(const std::string& materials, const std::string& objects, double um) const {
    const Session session = Session::load(
        io::parse_document(
            format(
                R"({{"ifov": 1, "scene": {{"materials": {{{}}}, "objects": [{}]}}, "light": {{"sky": {{"none": {{}}}}}},
                   "sensor": {{"camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}]}}}},
                              "channels": [{{"name": "c", "monochromatic": {{"at": "{} um"}}}}]}},
                   "sampling": {{"accuracy": {{"error": "5 %"}}}}}})",
                materials, objects, kCells, kPixels, kPixels, um),
            (folder_ / "scene.json").string()),
        nullptr);
    render::RenderControl control;
    control.threads = 1;
    KeptTile tile;
    render::render_image(session.parts().job(), control, tile);
    return tile.result;
  }
  /// Every pixel that is sure has the mean of `radiance` over its cells, in nineteen of twenty cases; the share of sure pixels.
  static double expect_held(const sampling::TileResult& image,
                            const std::function<double(double east_m, double south_m)>& radiance) {
    constexpr int kFine = 4;  // points of a cell a side
    int sure = 0, held = 0;
    for (int p = 0; p < kPixels * kPixels; ++p) {
      if (image.reasons[static_cast<std::size_t>(p)] != 0) continue;
      double sum = 0.0;
      for (int k = 0; k < kCells * kFine; ++k)
        for (int l = 0; l < kCells * kFine; ++l)
          sum += radiance(kCells * (p % kPixels) + (k + 0.5) / kFine,
                          kCells * (p / kPixels) + (l + 0.5) / kFine);
      const double truth = sum / (kCells * kFine * kCells * kFine);
      ++sure;
      held += std::abs(static_cast<double>(image.mean[static_cast<std::size_t>(p)]) - truth) <=
              static_cast<double>(image.half_width[static_cast<std::size_t>(p)]) + 1e-3 * truth;
    }
    EXPECT_GE(held, sure - 3);
    return static_cast<double>(sure) / (kPixels * kPixels);
  }
  /// In one pixel of three one cell, in its inner part.
  static bool stands_out(int column, int row) {
    const int pixel = kPixels * (row / kCells) + column / kCells;
    return pixel % 3 == 0 && column % kCells == 2 + static_cast<int>(sampling::hash(5, pixel) % 16) &&
           row % kCells == 2 + static_cast<int>(sampling::hash(6, pixel) % 16);
  }

  std::filesystem::path folder_;
};

// One square metre of fire in 400, bilinear between cells, at two wavelengths: it is nearly all of the radiance, or a tenth.
TEST_F(Standouts, HotCellsOfATemperatureMapAreKnown) {
  constexpr double kGround_k = 300.0, kFire_k = 600.0;
  const auto cell_k = [](int column, int row) { return stands_out(column, row) ? kFire_k : kGround_k; };
  write_map("kelvins.asc", cell_k);
  const auto kelvins = [&](double east_m, double south_m) {
    const double a = east_m - 0.5, b = south_m - 0.5;
    const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
    const double x = a - i, y = b - j;
    return (1.0 - y) * ((1.0 - x) * cell_k(i, j) + x * cell_k(i + 1, j)) +
           y * ((1.0 - x) * cell_k(i, j + 1) + x * cell_k(i + 1, j + 1));
  };
  for (const double um : {3.9, 10.0}) {
    const sampling::TileResult image = rendered(
        R"("ground": {"emissivity": 1, "temperature": {"map": {"file": "kelvins.asc", "unit": "K"}}})",
        R"({"plane": {}, "material": "ground"})", um);
    expect_held(image, [&](double east_m, double south_m) {
      return radiometry::planck_w_m2_sr_um(um, kelvins(east_m, south_m));
    });
    // What is even takes no more rays than before.
    EXPECT_EQ(image.reasons[1], 0);
    EXPECT_LT(image.samples[1], 100u);
    EXPECT_GT(image.samples[0], 200u);
  }
}

// A roof with one hole of 1 m a pixel, over what is warm: more cells than are looked at one by one.
TEST_F(Standouts, HolesOfLargePixelsAreKnown) {
  constexpr double kRoof_k = 270.0, kFloor_k = 400.0;
  write_map("roof.asc", [](int column, int row) { return stands_out(column, row) ? 0.0 : 1.0; });
  const sampling::TileResult image = rendered(
      format(
          R"("roof": {{"emissivity": 1, "temperature": "{} K", "opacity": {{"file": "roof.asc", "cutoff": 0.5}}}},
                "floor": {{"emissivity": 1, "temperature": "{} K"}})",
          kRoof_k, kFloor_k),
      R"({"plane": {}, "material": "floor"},
         {"polygon": {"vertices": [["-60 m", "-60 m", "3 m"], ["60 m", "-60 m", "3 m"], ["60 m", "60 m", "3 m"], ["-60 m", "60 m", "3 m"]]},
          "material": "roof"})",
      10.0);
  expect_held(image, [&](double east_m, double south_m) {
    return radiometry::planck_w_m2_sr_um(
        10.0, stands_out(static_cast<int>(east_m), static_cast<int>(south_m)) ? kFloor_k : kRoof_k);
  });
}

}  // namespace
}  // namespace ifov::session::test_standouts
