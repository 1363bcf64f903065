// Hot things far away: every seed finds their light, and says how sure it is.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/spectral_nodes.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/emitters.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_sought_emitters {
namespace {

class Messages final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += "warning: " + message + "\n"; }
  std::string text;
};

constexpr int kPixels = 6;
constexpr double kRadius_m = 0.15, kHeight_m = 6.0, kEast_m = 4.0;

/// Ground at 285 K and what is hot, in 3.5 to 4.1 um.
Session load(const std::string& hot, LogSink* log = nullptr, const std::string& more = {},
             double hot_k = 1300.0) {
  return Session::load(
      io::parse_document(
          format(
              R"({{"ifov": 1, "scene": {{"materials": {{"soil": {{"emissivity": 0.9, "temperature": "285 K"}},
                                                     "hot": {{"emissivity": 1, "temperature": "{} K"{}}},
                                                     "glass": {{"reflectance": 0.9, "scattering": "mirror", "temperature": "285 K"}}}},
                     "objects": [{{"plane": {{}}, "material": "soil"}}, {}]}},
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [{}, {}], "center": ["{} m", "0 m"]}}}},
                       "channels": [{{"name": "c", "top_hat": {{"from": "3.5 um", "to": "4.1 um"}}}}]}},
                     "sampling": {{"accuracy": {{"error": "1 %", "max_samples": 500}}}}}})",
              hot_k, more, hot, kPixels, kPixels, kEast_m),
          "hot.json"),
      log);
}

const char* const kSphere =
    R"({"sphere": {"center": ["0 m", "0 m", "6 m"], "radius": "0.15 m"}, "material": "hot"})";

TEST(SoughtEmitters, WaysByMirrorsThatAreNotSoughtAreSaid) {
  const std::string pane = format(
      R"({}, {{"polygon": {{"vertices": [["3 m", "-2 m", "0 m"], ["3 m", "2 m", "0 m"], ["3 m", "0 m", "4 m"]]}},
              "material": "glass"}})",
      kSphere);
  const std::string ball = format(
      R"({}, {{"sphere": {{"center": ["3 m", "0 m", "1 m"], "radius": "0.5 m"}}, "material": "glass"}})",
      pane);
  constexpr const char* kText =
      "warning: light of surfaces that outshine the scene is sought by way of one mirror that is flat, a ball "
      "or a round column, not of other shapes or of several in turn: what those throw of it on other surfaces "
      "is found by chance alone; pixels are marked that it may reach\n";
  for (const auto& [objects, said] : {std::pair{std::string(kSphere), false}, {pane, false}, {ball, true}}) {
    Messages messages;
    load(objects, &messages);
    EXPECT_EQ(messages.text.find(kText) != std::string::npos, said) << messages.text;
  }
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sampling::TileResult render_with(const Session& session, std::uint64_t seed, bool seek) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  job.transport.seek_emitters = seek;
  render::RenderControl control;
  control.threads = 1;
  OneTile tile;
  render::render_image(job, control, tile);
  return tile.result;
}

/// Mean over a pixel: what the ground emits, and 0.1 of the sphere's light by its view factor cos(theta) R^2 / d^2.
double expected(const Session& session, int x, int y, double hot_k = 1300.0) {
  double seen = 0.0;
  constexpr int kGrid = 32;
  for (int k = 0; k < kGrid * kGrid; ++k) {
    const double east = kEast_m - 0.5 * kPixels + x + (k % kGrid + 0.5) / kGrid;
    const double north = 0.5 * kPixels - y - (k / kGrid + 0.5) / kGrid;
    seen += kRadius_m * kRadius_m * kHeight_m /
            std::pow(east * east + north * north + kHeight_m * kHeight_m, 1.5);
  }
  std::vector<double> ground(1), hot(1);
  session.parts().nodes->planck_channels(285.0, ground);
  session.parts().nodes->planck_channels(hot_k, hot);
  return 0.9 * ground[0] + 0.1 * hot[0] * seen / (kGrid * kGrid);
}

struct Judged {
  int outside = 0, converged = 0, pixels = 0;
  double rays = 0.0;
};

Judged judge(const Session& session, bool seek) {
  Judged judged;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const sampling::TileResult tile = render_with(session, seed, seek);
    for (int k = 0; k < kPixels * kPixels; ++k) {
      const auto p = static_cast<std::size_t>(k);
      const double wanted = expected(session, k % kPixels, k / kPixels);
      const double tolerance = static_cast<double>(tile.half_width[p]) + 1e-4 * wanted;
      judged.outside += std::abs(static_cast<double>(tile.mean[p]) - wanted) > tolerance && tile.converged(p);
      judged.converged += tile.converged(p);
      ++judged.pixels;
    }
    judged.rays += static_cast<double>(tile.rays.total());
  }
  judged.rays /= judged.pixels;
  return judged;
}

TEST(SoughtEmitters, HotSphereIsRightInAllSeeds) {
  const Session session = load(kSphere);
  const Judged judged = judge(session, true);
  EXPECT_LE(judged.outside, judged.pixels / 14);
  EXPECT_EQ(judged.converged, judged.pixels);
  EXPECT_LT(judged.rays, 1000.0);  // 194,000 when it was found by chance, and not converged then
}

TEST(SoughtEmitters, PlantedFaultNothingSoughtIsWrongAndSure) {
  const Session session = load(kSphere);
  const Judged judged = judge(session, false);
  EXPECT_GT(judged.outside, judged.pixels / 14);
}

TEST(SoughtEmitters, AMaterialMayDeclineAndItsLightIsMarked) {
  Messages messages;
  const Session session = load(kSphere, &messages, R"(, "emitter": false)");
  ASSERT_NE(session.parts().spectral_scene->emitters(), nullptr);
  EXPECT_EQ(session.parts().spectral_scene->emitters()->count(), 0u);
  EXPECT_NE(
      messages.text.find(
          "warning: light of materials with \"emitter\": false that outshine the scene is found by random "
          "paths alone: pixels are marked that they may light\n"),
      std::string::npos)
      << messages.text;
  const Judged judged = judge(session, true);
  EXPECT_EQ(judged.outside, 0);
  EXPECT_LT(judged.converged, judged.pixels / 4);
}

TEST(SoughtEmitters, AMaterialMayInsist) {
  // 298 K beside 285 K is not bright enough to be sought by itself.
  const Session usual = load(kSphere, nullptr, {}, 298.0),
                asked = load(kSphere, nullptr, R"(, "emitter": true)", 298.0);
  EXPECT_EQ(usual.parts().spectral_scene->emitters(), nullptr);
  ASSERT_NE(asked.parts().spectral_scene->emitters(), nullptr);
  EXPECT_EQ(asked.parts().spectral_scene->emitters()->count(), 1u);
  const sampling::TileResult sought = render_with(asked, 3, true);
  for (int k = 0; k < kPixels * kPixels; ++k) {
    const auto p = static_cast<std::size_t>(k);
    const double wanted = expected(asked, k % kPixels, k / kPixels, 298.0);
    EXPECT_NEAR(sought.mean[p], wanted, static_cast<double>(sought.half_width[p]) + 1e-5 * wanted);
  }
}

TEST(SoughtEmitters, AreToldOf) {
  Messages some, none, left;
  load(kSphere, &some);
  EXPECT_NE(some.text.find("emitters: lamps, and faces brighter than the scene, whose light is sought: 1\n"),
            std::string::npos)
      << some.text;
  load(R"({"sphere": {"center": ["0 m", "0 m", "6 m"], "radius": "0.15 m"}, "material": "soil"})", &none);
  EXPECT_EQ(none.text.find("emitters:"), std::string::npos) << none.text;
  load(
      R"({"plane": {"height": "-1 m"}, "material": "soil"}, {"plane": {"height": "-5 m"}, "material": "hot"})",
      &left);
  EXPECT_EQ(left.text.find("emitters:"), std::string::npos) << left.text;
  EXPECT_NE(
      left.text.find(
          "warning: light of some surfaces that outshine the scene is found by random paths alone: it is not sought from planes and terrain, nor from more than 1048576 faces; of those beyond that number, pixels are "
          "marked that they may light\n"),
      std::string::npos)
      << left.text;
}

}  // namespace
}  // namespace ifov::session::test_sought_emitters
