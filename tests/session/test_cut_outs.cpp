// Surfaces with holes: light goes straight on through them, to the sensor and from Sun, sky and lamps, as closed forms have it, as
// through a mesh of the parts that are left, and with intervals that hold.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/hash.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_cut_outs {
namespace {

class WholeImage final : public render::TileSink {
 public:
  explicit WholeImage(int pixels)
      : mean(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), 0.0),
        half_width(mean.size(), 0.0),
        width_(static_cast<std::size_t>(pixels)) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const auto count = static_cast<std::size_t>(tile.tile.count()),
               across = static_cast<std::size_t>(tile.tile.width()), stride = tile.mean.size() / count;
    for (std::size_t p = 0; p < count; ++p) {
      const std::size_t at = (static_cast<std::size_t>(tile.tile.y0) + p / across) * width_ +
                             static_cast<std::size_t>(tile.tile.x0) + p % across;
      mean[at] = static_cast<double>(tile.mean[p * stride]);
      if (!tile.half_width.empty()) half_width[at] = static_cast<double>(tile.half_width[p * stride]);
    }
  }
  std::vector<double> mean, half_width;

 private:
  std::size_t width_;
};

class CutOutScenes : public testing::Test {
 protected:
  static constexpr double kGround = 0.5, kDirect = 1000.0, kDiffuse = 300.0;

  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_cut_outs_{}", getpid());
    std::filesystem::create_directories(folder_);
    // Cells of half a period: the first is there.
    map("stripes.asc", 2, 1, [](int column, int) { return column == 0; });
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  /// Rows from the north.
  template <class There>
  void map(const std::string& name, int columns, int rows, const There& there) const {
    std::string text = format("ncols {}\nnrows {}\nxllcorner 0\nyllcorner 0\ncellsize 1\n", columns, rows);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        text += format("{}{}", there(i, j) ? 255 : 0, i + 1 == columns ? "\n" : " ");
    write(name, text);
  }

  struct Setting {
    std::string screen;  ///< an object, or nothing
    std::string sun, lamps;
    double direct = 0.0, diffuse = 0.0;
    std::string opacity;  ///< the key of the screen's material with what it holds
    std::string screen_is = "\"reflectance\": 0";
    double gsd_m = 4.0;
    int pixels = 1;
    std::string sampling = R"({"accuracy": {"error": "0.3 %"}})";
  };
  Session load(const Setting& s, LogSink* log = nullptr) const {
    const std::string light = format(
        R"("light": {{{}{}}}, "atmosphere": {{"uniform": {{"direct": "{} W m-2 um-1", "diffuse": "{} W m-2 um-1"}}}},)",
        s.sun.empty() ? "" : "\"sun\": " + s.sun,
        s.lamps.empty() ? std::string() : (s.sun.empty() ? "" : ", ") + ("\"sources\": [" + s.lamps + "]"),
        s.direct, s.diffuse);
    return Session::load(
        io::parse_document(
            format(
                R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": {}}}, "screen": {{{}{}}}}},
                     "objects": [{{"plane": {{}}, "material": "ground"}}{}{}]}}, {}
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}]}}}},
                                "channels": [{{"name": "c", "monochromatic": {{"at": "0.6 um"}}}}]}},
                     "sampling": {}}})",
                kGround, s.screen_is, s.opacity.empty() ? "" : ", \"opacity\": " + s.opacity,
                s.screen.empty() ? "" : ", ", s.screen, light, s.gsd_m, s.pixels, s.pixels, s.sampling),
            (folder_ / "scene.json").string()),
        log);
  }
  WholeImage rendered(const Setting& s) const {
    const Session session = load(s);
    render::RenderControl control;
    control.threads = 1;
    WholeImage image(s.pixels);
    render::render_image(session.parts().job(), control, image);
    return image;
  }
  std::string said(const Setting& s) const {
    try {
      load(s);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  }
  static std::string square(double half_m, double height_m) {
    return format(
        R"({{"polygon": {{"vertices": [["{0} m", "{0} m", "{2} m"], ["{1} m", "{0} m", "{2} m"], ["{1} m", "{1} m", "{2} m"], ["{0} m", "{1} m", "{2} m"]]}}, "material": "screen"}})",
        -half_m, half_m, height_m);
  }
  static std::string stripes(double period_m) {
    return format(
        R"({{"file": "stripes.asc", "cutoff": 128, "low_left": ["0 m", "0 m"], "size": ["{} m", "1 m"], "tiling": "repeat"}})",
        period_m);
  }
  std::filesystem::path folder_;
};

/// Half of the ground is seen through the stripes; of it the share that their shadow, moved by h tan(zenith), leaves lit.
TEST_F(CutOutScenes, SunlightComesTwiceThroughStripes) {
  constexpr double kHeight = 4.0, kPeriod = 0.4;
  for (const auto& [shift, share] : {std::pair{2.0, 0.5}, {2.1, 0.25}, {2.2, 0.0}, {1.9, 0.25}}) {
    const double zenith = std::atan(shift / kHeight);
    Setting s;
    s.screen = square(40.0, kHeight);
    s.opacity = stripes(kPeriod);
    s.direct = kDirect;
    s.sun = format(R"({{"point": {{"zenith": "{} rad", "azimuth": "90 deg"}}}})", zenith);
    const WholeImage image = rendered(s);
    const double whole = kGround * kDirect * std::cos(zenith) / std::numbers::pi;
    EXPECT_NEAR(image.mean[0], share * whole, 0.006 * share * whole + 1e-4) << shift;
    EXPECT_LE(std::abs(image.mean[0] - share * whole), 2.0 * image.half_width[0] + 1e-4) << shift;
  }
}

/// A disc Sun overhead: each edge's penumbra of radius R takes 2 R / (3 pi) of what is seen (the mean of the positive part of a
/// disc's projection).
TEST_F(CutOutScenes, EdgesOfHolesHavePenumbrae) {
  constexpr double kHeight = 4.0, kPeriod = 0.4, kHalfAngle = std::numbers::pi / 180.0;
  Setting s;
  s.screen = square(40.0, kHeight);
  s.opacity = stripes(kPeriod);
  s.direct = kDirect;
  s.sun = R"({"disc": {"zenith": "0 deg", "azimuth": "90 deg", "diameter": "2 deg"}})";
  const WholeImage image = rendered(s);
  const double lost = 2.0 * kHeight * std::tan(kHalfAngle) / (3.0 * std::numbers::pi),
               share = 0.5 - 2.0 * lost / kPeriod;
  const double expected = share * kGround * kDirect / std::numbers::pi;
  EXPECT_NEAR(image.mean[0], expected, 0.006 * expected);
  EXPECT_GT(std::abs(0.5 / share - 1.0), 0.1) << "sharp shadows must be seen";
}

/// The sky through stripes a tenth of their period above the ground: sum of C(s) f(s), C the correlation of seen and open,
/// 1/4 + 2/pi^2 sum cos(2 pi n s / p) / n^2 over odd n, f(s) = h^2 / 2 (h^2 + s^2)^(-3/2) where cosine-weighed directions
/// meet the screen, whose cosine transform is w h K1(w h).
TEST_F(CutOutScenes, SkyComesThroughStripes) {
  constexpr double kHeight = 0.4, kPeriod = 4.0;
  double share = 0.25;
  for (int n = 1; n < 200; n += 2) {
    const double x = 2.0 * std::numbers::pi * n * kHeight / kPeriod;
    share += 2.0 / std::pow(std::numbers::pi * n, 2) * x * std::cyl_bessel_k(1.0, x);
  }
  Setting s;
  s.screen = square(60.0, kHeight);
  s.opacity = stripes(kPeriod);
  s.diffuse = kDiffuse;
  const WholeImage image = rendered(s);
  const double expected = share * kGround * kDiffuse / std::numbers::pi;
  EXPECT_NEAR(image.mean[0], expected, 0.008 * expected);
  EXPECT_GT(std::abs(share / 0.5 - 1.0), 0.05) << "a sky without the screen must be seen";
  EXPECT_GT(std::abs(share / 0.25 - 1.0), 0.05) << "a screen without its nearness must be seen";
}

/// A lamp shines through the screen from the side: its shadow is (H - h) / H as large as it lies.
TEST_F(CutOutScenes, LampsShineThroughHoles) {
  constexpr double kHeight = 1.0, kLamp = 3.0, kEast = 5.0, kPeriod = 0.8;
  Setting s;
  s.gsd_m = 3.2;
  s.lamps = format(R"({{"point": {{"at": ["{} m", "0 m", "{} m"], "spectrum": 1, "flux": "1e6 lm"}}}})",
                   kEast, kLamp);
  s.sampling = R"({"grid": {"elements": [320, 320]}})";
  const double bare = rendered(s).mean[0];
  s.screen = square(40.0, kHeight);
  s.opacity = stripes(kPeriod);
  const double through = rendered(s).mean[0];
  s.sampling = R"({"accuracy": {"error": "1 %"}})";
  const WholeImage judged = rendered(s);
  double all = 0.0, seen = 0.0;
  const auto open = [](double x) { return x / kPeriod - std::floor(x / kPeriod) >= 0.5; };
  constexpr int kSteps = 800;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = s.gsd_m * ((i + 0.5) / kSteps - 0.5), y = s.gsd_m * ((j + 0.5) / kSteps - 0.5);
      const double light = std::pow(std::pow(x - kEast, 2) + y * y + kLamp * kLamp, -1.5);
      all += light;
      if (open(x) && open(x + (kEast - x) * kHeight / kLamp)) seen += light;
    }
  EXPECT_NEAR(through / bare, seen / all, 3e-3 * seen / all);
  EXPECT_LE(std::abs(judged.mean[0] / bare - seen / all), 1.5 * judged.half_width[0] / bare);
  EXPECT_LT(seen / all, 0.23) << "seen and lit by chance, a quarter, must be told apart";
}

/// Chequers, and parts of one that are squares of a mesh: the same paths meet the same.
TEST_F(CutOutScenes, AreAsAMeshOfWhatIsLeft) {
  constexpr int kCells = 24;
  constexpr double kCell = 0.5, kHeight = 2.0;
  const auto there = [](int i, int j) { return sampling::hash(3, i, j) % 5 < 3; };
  map("random.asc", kCells, kCells, there);
  std::string mesh;
  int count = 0;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      if (!there(i, j)) continue;
      const double x = kCell * i - 6.0, y = 6.0 - kCell * (j + 1);
      for (const auto& [a, b] : {std::pair{0.0, 0.0}, {kCell, 0.0}, {kCell, kCell}, {0.0, kCell}})
        mesh += format("v {} {} {}\n", x + a, y + b, kHeight);
      mesh += format("f {} {} {} {}\n", count + 1, count + 2, count + 3, count + 4);
      count += 4;
    }
  write("cells.obj", mesh);
  Setting cut;
  cut.screen_is = "\"reflectance\": 0.4";
  cut.screen = square(6.0, kHeight);
  cut.opacity =
      R"({"file": "random.asc", "cutoff": 1, "low_left": ["-6 m", "-6 m"], "size": ["12 m", "12 m"]})";
  cut.direct = kDirect, cut.diffuse = kDiffuse;
  cut.sun = R"({"disc": {"zenith": "35 deg", "azimuth": "70 deg"}})";
  cut.lamps = R"({"point": {"at": ["1 m", "2 m", "4 m"], "spectrum": 1, "flux": "1e6 lm"}})";
  cut.gsd_m = 1.0, cut.pixels = 12;
  cut.sampling = R"({"grid": {"elements": [8, 8]}})";
  Setting left = cut;
  left.opacity.clear();
  left.screen = R"({"mesh": {"file": "cells.obj"}, "material": "screen"})";
  Setting turned = cut;
  turned.opacity.replace(turned.opacity.find("-6 m"), 4, "-5 m");
  const WholeImage a = rendered(cut), b = rendered(left), wrong = rendered(turned);
  int alike = 0, planted = 0;
  double sum = 0.0, of_mesh = 0.0;
  for (std::size_t p = 0; p < a.mean.size(); ++p) {
    alike += std::abs(a.mean[p] - b.mean[p]) <= 1e-4 * b.mean[p];
    planted += std::abs(wrong.mean[p] - b.mean[p]) <= 1e-4 * b.mean[p];
    sum += a.mean[p], of_mesh += b.mean[p];
  }
  EXPECT_GE(alike, 0.95 * static_cast<double>(a.mean.size()));
  EXPECT_NEAR(sum, of_mesh, 1e-3 * of_mesh);
  EXPECT_LT(planted, 0.2 * static_cast<double>(a.mean.size())) << "a map in another place must be seen";
}

/// A hot screen lights the ground by what is left of it.
TEST_F(CutOutScenes, EmittersShineWithoutTheirHoles) {
  const auto glow = [&](const std::string& opacity) {
    const Session session = Session::load(
        io::parse_document(
            format(
                R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": 0.5, "temperature": "200 K"}},
                     "screen": {{"emissivity": 1, "temperature": "1000 K"{}}}}},
                     "objects": [{{"plane": {{}}, "material": "ground"}}, {}]}},
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1], "center": ["4 m", "0 m"]}}}},
                                "channels": [{{"name": "c", "top_hat": {{"from": "3.5 um", "to": "4.1 um"}}}}]}},
                     "sampling": {{"accuracy": {{"error": "0.5 %"}}}}}})",
                opacity.empty() ? "" : ", \"opacity\": " + opacity, square(2.0, 3.0)),
            (folder_ / "hot.json").string()),
        nullptr);
    render::RenderControl control;
    control.threads = 1;
    WholeImage image(1);
    render::render_image(session.parts().job(), control, image);
    return image;
  };
  // The ground beside it: stripes across the line of sight, so fine that each strip counts as its neighbour.
  const WholeImage whole = glow(""),
                   half = glow(R"({"file": "stripes.asc", "cutoff": 128, "low_left": ["0 m", "0 m"],
      "size": ["0.02 m", "1 m"], "tiling": "repeat"})");
  EXPECT_NEAR(half.mean[0], 0.5 * whole.mean[0], 0.01 * whole.mean[0]);
  EXPECT_LE(std::abs(half.mean[0] - 0.5 * whole.mean[0]), 2.0 * half.half_width[0] + whole.half_width[0]);
}

/// Pixels whose interval holds the mean of a fine grid, of three seeds.
class CutOutIntervals : public CutOutScenes {
 protected:
  static constexpr int kPixels = 10;

  double held(Setting s, const Setting& judged) {
    Setting fine = s;
    fine.sampling = R"({"grid": {"elements": [48, 48]}})";
    const WholeImage truth = rendered(fine);
    int count = 0, all = 0;
    double sum = 0.0, true_sum = 0.0;
    s = judged;
    for (const int seed : {1, 2, 3}) {
      s.sampling = format(R"({{"accuracy": {{"error": "3 %"}}}}, "seed": {})", seed);
      const WholeImage image = rendered(s);
      for (std::size_t p = 0; p < image.mean.size(); ++p) {
        count += std::abs(image.mean[p] - truth.mean[p]) <= image.half_width[p] + 0.004 * truth.mean[p];
        ++all;
        sum += image.mean[p], true_sum += truth.mean[p];
      }
    }
    bias_ = sum / true_sum - 1.0;
    return static_cast<double>(count) / all;
  }
  Setting screen(const std::string& file, int cells, double height_m) const {
    Setting s;
    s.screen_is = "\"reflectance\": 0.1";
    s.screen = square(7.0, height_m);
    s.opacity = format(
        R"({{"file": "{}", "cutoff": 1, "low_left": ["-7 m", "-7 m"], "size": ["14 m", "14 m"]}})", file);
    (void)cells;
    s.direct = kDirect, s.diffuse = kDiffuse;
    s.sun = R"({"disc": {"zenith": "35 deg", "azimuth": "70 deg"}})";
    s.gsd_m = 1.0, s.pixels = kPixels;
    return s;
  }
  double bias_ = 0.0;
};

TEST_F(CutOutIntervals, HoldAboutCellsOfAQuarterPixel) {
  constexpr int kCells = 56;
  map("random.asc", kCells, kCells, [](int i, int j) { return sampling::hash(9, i, j) % 5 < 3; });
  const Setting s = screen("random.asc", kCells, 3.0);
  EXPECT_GE(held(s, s), 0.93);
  EXPECT_LT(std::abs(bias_), 2e-3);
  Setting moved = s;
  moved.opacity.replace(moved.opacity.find("-7 m"), 4, "-6.9 m");
  EXPECT_LT(held(s, moved), 0.7) << "cells in another place must be seen";
}

TEST_F(CutOutIntervals, HoldAboutHolesOfOneCell) {
  constexpr int kCells = 140;
  map("holes.asc", kCells, kCells, [](int i, int j) { return sampling::hash(9, i, j) % 100 > 0; });
  const Setting s = screen("holes.asc", kCells, 0.5);
  EXPECT_GE(held(s, s), 0.93);
  EXPECT_LT(std::abs(bias_), 2e-3);
  Setting closed = s;
  closed.opacity.clear();
  EXPECT_LT(held(s, closed), 0.7) << "a screen without holes must be seen";
}

TEST_F(CutOutIntervals, HoldAboutSpecksOfOneCell) {
  constexpr int kCells = 140;
  map("specks.asc", kCells, kCells, [](int i, int j) { return sampling::hash(9, i, j) % 100 == 0; });
  const Setting s = screen("specks.asc", kCells, 0.5);
  EXPECT_GE(held(s, s), 0.93);
  EXPECT_LT(std::abs(bias_), 2e-3);
}

TEST_F(CutOutScenes, MistakesAreShown) {
  Setting s;
  s.diffuse = 1.0;
  s.opacity = stripes(1.0);
  const auto of = [&](const std::string& shape) {
    s.screen = format("{{{}, \"material\": \"screen\"}}", shape);
    return said(s);
  };
  const std::string expected =
      "'screen' has an 'opacity' map, and this shape cannot have holes: take a polygon, a mesh, or a terrain in the form of "
      "a mesh";
  EXPECT_NE(of(R"("sphere": {"center": ["0 m", "0 m", "2 m"], "radius": "1 m"})").find(expected),
            std::string::npos)
      << of(R"("sphere": {"center": ["0 m", "0 m", "2 m"], "radius": "1 m"})");
  EXPECT_NE(of(R"("plane": {"height": "1 m"})").find(expected), std::string::npos);
  s.screen = square(2.0, 1.0);
  EXPECT_EQ(said(s), "nothing");
  s.opacity = R"({"file": "stripes.asc", "cutoff": 128, "by": "texture coordinates"})";
  EXPECT_NE(
      said(s).find("'screen' has an 'opacity' map by texture coordinates, of which this shape has none"),
      std::string::npos)
      << said(s);
  s.opacity = stripes(1.0);
  s.screen_is = R"("reflectance": 0, "scattering": {"smooth": {"index": 1.5}})";
  EXPECT_NE(said(s), "nothing");
  s.screen_is = "\"reflectance\": 0";
  s.opacity =
      R"({"file": "stripes.asc", "cutoff": 128, "band": 2, "low_left": ["0 m", "0 m"], "size": ["2 m", "1 m"]})";
  EXPECT_NE(said(s).find("stripes.asc"), std::string::npos) << said(s);
}

}  // namespace
}  // namespace ifov::session::test_cut_outs
