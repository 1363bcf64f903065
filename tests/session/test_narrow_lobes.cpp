// Hot things beside lobes so narrow that they throw their light rarely: such scenes load, and pixels that may lack it say so.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/image/survey.h"
#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_narrow_lobes {
namespace {

constexpr int kAcross = 8;

/// A ball and a wall of polished metal, and 93 times as bright as the ground a ball of 690 K between them, at 8 um.
std::string hot_beside_chrome(const std::string& sampling, const std::string& scattering) {
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{
           "soil": {{"reflectance": 0.3, "temperature": "290 K"}}, "hot": {{"emissivity": 1, "temperature": "690 K"}},
           "chrome": {{"reflectance": 1, "temperature": "290 K", "scattering": {2}}}}},
          "objects": [{{"plane": {{}}, "material": "soil"}},
            {{"sphere": {{"center": ["-2 m", "0 m", "1 m"], "radius": "0.9 m"}}, "material": "chrome"}},
            {{"box": {{"low": ["2.5 m", "-2 m", "0 m"], "high": ["3 m", "2 m", "2 m"]}}, "material": "chrome"}},
            {{"sphere": {{"center": ["0 m", "0.3 m", "1.5 m"], "radius": "0.3 m"}}, "material": "hot"}}]}},
          "light": {{"sky": {{"radiance": "2.73 W m-2 sr-1 um-1"}}, "surroundings": {{"reflectance": 0, "temperature": "290 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.75 m", "pixels": [{0}, {0}]}}}},
                      "channels": [{{"name": "thermal", "monochromatic": {{"at": "8 um"}}}}]}},
          "sampling": {1}}})",
      kAcross, sampling, scattering);
}

std::string metal(double roughness) {
  return format(R"({{"rough_conductor": {{"n": 0.01, "k": 50, "roughness": {}}}}})", roughness);
}

class Warnings final : public LogSink {
 public:
  void info(const std::string&) override {}
  void warn(const std::string& message) override { text += message + "\n"; }
  std::string text;
};

class Tile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

/// Keeps what paths alone say of a tile, before anything is marked.
class Overheard final : public sampling::PixelSampler {
 public:
  explicit Overheard(const sampling::PixelSampler& sampler) : sampler_(sampler) {}
  void sample(const sampling::TileProblem& problem, sampling::Field& field,
              sampling::TileResult& result) const override {
    sampler_.sample(problem, field, result);
    said = result;
  }
  int halo_px() const override { return sampler_.halo_px(); }
  int block_px() const override { return sampler_.block_px(); }
  std::unique_ptr<const sampling::ImageSurvey> survey(const sampling::SurveyRequest& request) const override {
    return sampler_.survey(request);
  }
  bool takes_many_values() const override { return sampler_.takes_many_values(); }
  mutable sampling::TileResult said;

 private:
  const sampling::PixelSampler& sampler_;
};

/// The tile, and what paths alone said of it.
std::array<sampling::TileResult, 2> rendered(const std::string& sampling, std::uint64_t seed,
                                             const std::string& scattering) {
  const Session session =
      Session::load(io::parse_document(hot_beside_chrome(sampling, scattering), "chrome.json"), nullptr);
  const render::RenderJob& whole = session.parts().job();
  const Overheard sampler(whole.sampler);
  render::RenderJob job{whole.scene, whole.camera, whole.footprint, sampler};
  job.tolerance = whole.tolerance;
  job.transport = whole.transport;
  job.label_detail = whole.label_detail;
  job.steering_channels = whole.steering_channels;
  job.seed = seed;
  render::RenderControl control;
  control.threads = 1;
  Tile tile;
  render::render_image(job, control, tile);
  return {tile.result, sampler.said};
}

TEST(NarrowLobes, PolishedMetalBesideHotThingsLoadsWithAWord) {
  Warnings warnings;
  Session::load(
      io::parse_document(hot_beside_chrome(R"({"accuracy": {"error": "3 %"}})", metal(0.05)), "chrome.json"),
      &warnings);
  EXPECT_NE(warnings.text.find(
                "material 'chrome' has a lobe of roughness 0.05: what lobes narrower than 0.1 throw on "
                "other surfaces of the light of what outshines the scene, and small highlights of it, are "
                "found by chance alone; pixels are marked that it may reach\n"),
            std::string::npos)
      << warnings.text;
}

/// `blur`: half-widths that a pixel may be off.
int wrong_and_sure(const sampling::TileResult& said, const sampling::TileResult& truth, double blur) {
  int wrong = 0;
  for (std::size_t p = 0; p < truth.mean.size(); ++p) {
    const double off = std::abs(static_cast<double>(said.mean[p] - truth.mean[p])),
                 known = static_cast<double>(said.half_width[p] + truth.half_width[p]);
    wrong += said.converged(p) && off > blur * known;
  }
  return wrong;
}

/// Of a metal that is nearly a mirror all is known from the mirror's picture, where all is sought. Planted fault: what paths alone say.
TEST(NarrowLobes, PixelsThatMayLackTheirLightAreNotSure) {
  const sampling::TileResult truth = rendered(R"({"accuracy": {"error": "0.5 %"}})", 7, R"("mirror")")[0];
  constexpr double kBlur = 1.5;  // a lobe's image of an edge is as blurred as the lobe is wide
  int sure = 0, wrong = 0, marked = 0, wrong_unmarked = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto [tile, alone] = rendered(R"({"accuracy": {"error": "3 %"}})", seed, metal(0.02));
    sure += static_cast<int>(tile.converged_count());
    for (const sampling::Reasons reasons : tile.reasons)
      marked += (reasons & sampling::bit(sampling::Reason::unseen_light)) != 0;
    wrong += wrong_and_sure(tile, truth, kBlur);
    wrong_unmarked += wrong_and_sure(alone, truth, 1.0);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(sure, 3 * kAcross * kAcross / 3);
  EXPECT_GT(marked, 20);
  EXPECT_GT(wrong_unmarked, 3);
  RecordProperty("wrong", wrong);
  RecordProperty("sure", sure);
  RecordProperty("marked", marked);
  RecordProperty("wrong_unmarked", wrong_unmarked);
}

}  // namespace
}  // namespace ifov::session::test_narrow_lobes
