// Panes and media from a document: a floor of tiles seen, lit and shaded through a pane against the closed form; mistakes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_panes {
namespace {

constexpr int kSide = 8;
constexpr double kTile_m = 0.83, kLight = 0.6, kDark = 0.1;
// A pane 2 m above the floor with a black bar on it; the Sun 40 deg from the zenith in the east.
constexpr double kPaneFrom_m = -9.0, kPaneTo_m = 1.3, kBarFrom_m = -1.4, kBarTo_m = -0.9, kHeight_m = 2.0;
constexpr double kSunZenith = 40.0 * std::numbers::pi / 180.0;
constexpr double kIndex = 1.52;

Session load(const std::string& materials, const std::string& objects) {
  return Session::load(
      io::parse_document(
          format(
              R"({{"ifov": 1, "scene": {{"materials": {{"light": {{"reflectance": {}}}, "dark": {{"reflectance": {}}}, "bar": {{"reflectance": 0}},
               {}}},
 "objects": [{}]}},
 "light": {{"sun": {{"point": {{"zenith": "40 deg", "azimuth": "90 deg"}}}}}},
 "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [{}, {}]}}}},
   "channels": [{{"name": "c", "top_hat": {{"from": "0.54 um", "to": "0.56 um"}}}}]}},
 "sampling": {{"accuracy": {{"error": "1 %"}}}}}})",
              kLight, kDark, materials, objects, kSide, kSide),
          "pane.json"),
      nullptr);
}

/// Of reflectances in a row of tiles: 1 or -1.
double tint(double along_m, double from_m) {
  return static_cast<long>(std::floor((along_m + from_m) / kTile_m)) % 2 == 0 ? 1.0 : -1.0;
}

std::string rectangle(double x0, double x1, double y0, double y1, double z, const char* material) {
  return format(
      R"({{"polygon": {{"vertices": [["{0} m", "{2} m", "{4} m"], ["{1} m", "{2} m", "{4} m"], ["{1} m", "{3} m", "{4} m"],
      ["{0} m", "{3} m", "{4} m"]]}}, "material": "{5}"}})",
      x0, x1, y0, y1, z, material);
}

constexpr double kFrom_m = 12 * kTile_m;  // tiles from -kFrom_m on

std::string scene(bool with_pane) {
  std::string objects;
  for (int i = 4; i < 20; ++i)
    for (int j = 6; j < 18; ++j) {
      const double x = i * kTile_m - kFrom_m, y = j * kTile_m - kFrom_m;
      objects += rectangle(x, x + kTile_m, y, y + kTile_m, 0.0, (i + j) % 2 == 0 ? "light" : "dark") + ",\n";
    }
  if (with_pane) {
    objects += rectangle(kPaneFrom_m, kBarFrom_m, -9.0, 9.0, kHeight_m, "pane") + ",\n";
    objects += rectangle(kBarTo_m, kPaneTo_m, -9.0, 9.0, kHeight_m, "pane") + ",\n";
  }
  return objects + rectangle(kBarFrom_m, kBarTo_m, -9.0, 9.0, kHeight_m, "bar");
}

/// What a pane lets through that does not absorb, (1 - R) / (1 + R) for either polarization (Born and Wolf, section 7.6).
double lets_through(double angle) {
  const double within = std::asin(std::sin(angle) / kIndex);
  const double c = std::cos(angle), w = std::cos(within);
  const double s = std::pow((c - kIndex * w) / (c + kIndex * w), 2),
               p = std::pow((kIndex * c - w) / (kIndex * c + w), 2);
  return 0.5 * ((1.0 - s) / (1.0 + s) + (1.0 - p) / (1.0 + p));
}

/// What comes through above a point of the pane's plane; a bar lets nothing through.
double above(double x, double through) {
  if (x > kBarFrom_m && x < kBarTo_m) return 0.0;
  return x > kPaneFrom_m && x < kPaneTo_m ? through : 1.0;
}

/// Of sunlight on a white surface that faces the zenith: mean over a pixel.
double expected(int column, int row, double sun_through) {
  constexpr int kPoints = 8000;
  constexpr double kGsd = 0.5;
  double across = 0.0;  // mean tint of the row of pixels
  for (int k = 0; k < kPoints; ++k)
    across += tint(kGsd * (0.5 * kSide - row - (k + 0.5) / kPoints), kFrom_m) / kPoints;
  double sum = 0.0;
  for (int k = 0; k < kPoints; ++k) {
    const double x = kGsd * (column - 0.5 * kSide + (k + 0.5) / kPoints);
    const double reflectance = 0.5 * (kLight + kDark) + 0.5 * (kLight - kDark) * tint(x, kFrom_m) * across;
    sum += above(x, lets_through(0.0)) * above(x + kHeight_m * std::tan(kSunZenith), sun_through) *
           reflectance / kPoints;
  }
  return sum;
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sampling::TileResult rendered(const Session& session, std::uint64_t seed) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  job.transport.maximum_scatterings = 2;  // without what goes to and fro between floor and pane
  render::RenderControl control;
  control.threads = 1;
  OneTile tile;
  render::render_image(job, control, tile);
  return tile.result;
}

struct Held {
  int truth = 0, fault = 0, converged = 0, pixels = 0;
};

Held held(const char* pane) {
  const Session session = load(pane, scene(true));
  const double white = [&] {
    // A tile in full light tells what sunlight a white surface sends up.
    const Session bright = load(pane, R"({"plane": {}, "material": "light"})");
    return static_cast<double>(rendered(bright, 1).mean[0]) / kLight;
  }();
  Held held;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const sampling::TileResult tile = rendered(session, seed);
    for (int p = 0; p < kSide * kSide; ++p) {
      const auto at = static_cast<std::size_t>(p * tile.columns), pixel = static_cast<std::size_t>(p);
      const double mean = static_cast<double>(tile.mean[at]);
      const auto within = [&](double sun_through) {
        const double truth = white * expected(p % kSide, p / kSide, sun_through);
        return std::abs(mean - truth) <= static_cast<double>(tile.half_width[pixel]) + 5e-4 * white;
      };
      ++held.pixels;
      held.converged += tile.converged(pixel);
      held.truth += within(lets_through(kSunZenith));
      held.fault += within(1.0);
    }
  }
  return held;
}

constexpr const char* kPane =
    R"("pane": {"reflectance": 1, "scattering": {"slab": {"n": 1.52, "k": 0, "thickness": "4 mm"}}})";

TEST(PanesOfDocuments, TiledFloorBehindAPaneIsWithinItsIntervals) {
  const Held found = held(kPane);
  EXPECT_GE(found.truth, 0.95 * found.pixels);
  EXPECT_GE(found.converged, 0.9 * found.pixels);
  // Sunlight that the pane does not dim is a fault that is seen.
  EXPECT_LT(found.fault, 0.8 * found.pixels);
}

std::string mistake(const std::string& material, const std::string& shape) {
  try {
    load(format(R"("glass": {{"reflectance": 1, "scattering": {}}})", material),
         format(R"({{{}, "material": "glass"}})", shape));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(PanesOfDocuments, MistakesAreTold) {
  const std::string ball = R"("sphere": {"center": ["0 m", "0 m", "1 m"], "radius": "1 m"})",
                    disk =
                        R"("disk": {"center": ["0 m", "0 m", "1 m"], "normal": [0, 0, 1], "radius": "1 m"})";
  EXPECT_EQ(mistake(R"({"smooth": {"n": 1.5, "k": 0}})", ball), "none");
  EXPECT_EQ(mistake(R"({"slab": {"n": 1.5, "k": 0, "thickness": "4 mm"}})", disk), "none");
  EXPECT_EQ(mistake(R"({"smooth": {"n": 1.5, "k": 0, "over": "absorber"}})", disk), "none");
  const std::string no_inside = mistake(R"({"smooth": {"n": 1.5, "k": 0}})", disk);
  EXPECT_EQ(
      no_inside.substr(0, no_inside.find('\n')),
      "pane.json:3:108: light is refracted into 'glass', but this shape has no inside: take a solid (a box, a "
      "sphere, a closed mesh) or a plane, {\"slab\": ...} for a pane, or \"over\": \"absorber\" where what "
      "enters it ends there");
  EXPECT_NE(mistake(R"({"smooth": {"n": -1.5, "k": 0}})", ball).find("'n' is -1.5, below 0.01"),
            std::string::npos);
  EXPECT_NE(mistake(R"({"slab": {"n": 1.5, "k": -0.1, "thickness": "4 mm"}})", disk)
                .find("'k' is -0.1, below 0: it lies between 0 and 1000"),
            std::string::npos);
  EXPECT_NE(
      mistake(R"({"slab": {"n": 1.5, "k": 0, "thickness": "0 mm"}})", disk).find("between 1 um and 10 m"),
      std::string::npos);
  EXPECT_NE(mistake(R"({"slab": {"n": 1.5, "k": 0}})", disk).find("'thickness'"), std::string::npos);
  EXPECT_NE(
      mistake(R"({"smooth": {"index": "water"}})", ball)
          .find(
              "'index' is 'water': the built-in table tells what a surface reflects, not how little is absorbed "
              "on a way through; give 'n' and 'k'"),
      std::string::npos);
  EXPECT_EQ(mistake(R"({"smooth": {"index": "silver"}})", disk), "none");
  // A coated pane is seen otherwise from behind.
  const std::string coated =
      R"({"film": {"n": 2, "k": 0, "thickness": "1e-4 mm", "substrate_n": 1.5, "substrate_k": 0, "pane": "4 mm"}})";
  EXPECT_EQ(mistake(coated, disk), "none");
}

}  // namespace
}  // namespace ifov::session::test_panes
