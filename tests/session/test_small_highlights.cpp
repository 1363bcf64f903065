// Light that narrow lobes throw on other surfaces. Domes smaller than a pixel are in tests/studies.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_small_highlights {
namespace {

constexpr double kIrradiance = 1000.0, kUm = 0.65;

class Kept final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sampling::TileResult rendered(const std::string& document, std::uint64_t seed) {
  const Session session = Session::load(io::parse_document(document, "small.json"), nullptr);
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  render::RenderControl control;
  control.threads = 1;
  Kept kept;
  render::render_image(job, control, kept);
  return kept.result;
}

/// A ball and a wall on grey ground that they throw sunlight on, of one material.
std::string thrown(const std::string& metal, const std::string& error) {
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": 0.3}}, "metal": {}}},
          "objects": [{{"plane": {{}}, "material": "ground"}},
                      {{"sphere": {{"center": ["-2 m", "0 m", "1.2 m"], "radius": "1 m"}}, "material": "metal"}},
                      {{"box": {{"low": ["3 m", "-2 m", "0 m"], "high": ["3.5 m", "2 m", "2 m"]}}, "material": "metal"}}]}},
          "light": {{"sun": {{"disc": {{"zenith": "50 deg", "azimuth": "250 deg", "spectrum": "{} W m-2 um-1"}}}},
                     "sky": {{"radiance": "20 W m-2 sr-1 um-1"}}, "surroundings": {{"reflectance": 0.3}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1.5 m", "pixels": [14, 12]}}}},
                      "channels": [{{"name": "red", "monochromatic": {{"at": "{} um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "{}"}}}}}})",
      metal, kIrradiance, kUm, error);
}

/// Of a metal that is nearly a mirror everything is known from the mirror's picture, where all of it is sought. What lobes throw on
/// other surfaces is not: pixels have to say so.
TEST(SmallHighlights, PixelsThatNarrowLobesThrowLightOnAreNotSure) {
  const sampling::TileResult truth =
      rendered(thrown(R"({"reflectance": 1, "scattering": "mirror"})", "0.5 %"), 7);
  for (const double roughness : {0.02}) {
    const sampling::TileResult tile = rendered(
        thrown(
            format(
                R"({{"reflectance": 1, "scattering": {{"rough_conductor": {{"n": 0.01, "k": 50, "roughness": {}}}}}}})",
                roughness),
            "1 %"),
        3);
    int sure = 0, wrong_and_sure = 0, lacking = 0;
    for (std::size_t p = 0; p < truth.mean.size(); ++p) {
      const double off = static_cast<double>(truth.mean[p] - tile.mean[p]),
                   known = static_cast<double>(truth.half_width[p] + tile.half_width[p]);
      sure += tile.converged(p);
      // A lobe's image of an edge is as blurred as the lobe is wide.
      wrong_and_sure += tile.converged(p) && std::abs(off) > 2.0 * known;
      lacking += off > 0.03 * static_cast<double>(truth.mean[p]);
    }
    EXPECT_EQ(wrong_and_sure, 0);
    EXPECT_GT(lacking, 5) << "nothing was thrown";
    EXPECT_GT(sure, 20);
  }
}

}  // namespace
}  // namespace ifov::session::test_small_highlights
