// A dome of 0.4 m in a pixel of 1 m under the Sun, wherever it stands: nearly all of the light comes from a ten-thousandth of the pixel and less.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "materials/bsdf/rough_conductor.h"
#include "radiometry/spectrum.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session {
namespace {

using math::Vec3;
using std::numbers::pi;

constexpr double kRadius = 0.4, kIrradiance = 1000.0, kSky = 30.0, kMetalN = 0.15, kMetalK = 3.5;
constexpr double kUm = 0.65;
const Vec3 kSun{std::sin(pi / 6.0), 0.0, std::cos(pi / 6.0)};  // zenith 30 deg, in the east

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

struct Judged {
  int count = 0, within = 0, held = 0, sure = 0, wrong_and_sure = 0;
  double mean = 0.0, samples = 0.0, worst = 0.0;
};

/// Domes in a square, so far from each other that none matters to the next, each off the middle of its pixel by chance; on black
/// ground under a Sun of kIrradiance.
Judged judge(const std::string& metal, const std::string& sun, double sky, double truth, int across) {
  constexpr int kApart = 13;
  const int pixels = kApart * across;
  std::string domes;
  std::vector<std::size_t> where;
  for (int k = 0; k < across * across; ++k) {
    const auto number = static_cast<std::uint64_t>(2 * k);
    const double x = 0.19 * (sampling::unit_double(sampling::hash(3, number)) - 0.5),
                 y = 0.19 * (sampling::unit_double(sampling::hash(3, number + 1)) - 0.5);
    const int column = kApart * (k % across) + kApart / 2, row = kApart * (k / across) + kApart / 2;
    domes += format(
        R"(, {{"hemisphere": {{"center": ["{} m", "{} m", "0 m"], "radius": "{} m"}}, "material": "metal"}})",
        column + 0.5 - 0.5 * pixels + x, 0.5 * pixels - row - 0.5 + y, kRadius);
    where.push_back(static_cast<std::size_t>(row * pixels + column));
  }
  const sampling::TileResult tile =
      rendered(format(
                   R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": 0}}, "metal": {}}},
              "objects": [{{"plane": {{}}, "material": "ground"}}{}]}},
              "light": {{"sun": {{"{}": {{"zenith": "30 deg", "azimuth": "90 deg", "spectrum": "{} W m-2 um-1"}}}},
                         "sky": {{"radiance": "{} W m-2 sr-1 um-1"}}, "surroundings": {{"reflectance": 0}}}},
              "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [{}, {}]}}}},
                          "channels": [{{"name": "red", "monochromatic": {{"at": "{} um"}}}}]}},
              "sampling": {{"tile": {}, "accuracy": {{"error": "1 %"}}}}}})",
                   metal, domes, sun, kIrradiance, sky, pixels, pixels, kUm, pixels),
               1);
  Judged judged;
  for (const std::size_t p : where) {
    const double off = std::abs(static_cast<double>(tile.mean[p]) - truth);
    const bool held = off <= static_cast<double>(tile.half_width[p]);
    ++judged.count;
    judged.within += off <= 0.01 * truth;
    judged.held += held;
    judged.sure += tile.converged(p);
    judged.wrong_and_sure += tile.converged(p) && off > 0.03 * truth;
    judged.worst = std::max(judged.worst, off / truth);
    judged.mean += static_cast<double>(tile.mean[p]) / truth / static_cast<double>(where.size());
    judged.samples += tile.samples[p] / static_cast<double>(where.size());
  }
  return judged;
}

/// rho E R^2 / 4 of the Sun, and the sky in the inner half of the disc (normals to 45 deg from the zenith).
TEST(SmallHighlights, AMirrorDomeIsWithinAPercentWhereverItStands) {
  const double rho = 0.8;
  const double truth = rho * (kIrradiance * kRadius * kRadius / 4.0 + kSky * 0.5 * pi * kRadius * kRadius);
  for (const char* sun : {"disc", "point"}) {
    const Judged judged = judge(R"({"reflectance": 0.8, "scattering": "mirror"})", sun, kSky, truth, 5);
    EXPECT_EQ(judged.wrong_and_sure, 0) << sun;
    EXPECT_GE(judged.within, 0.95 * judged.count);
  }
}

/// Sunlight that a metal dome sends straight up: the sum over its disc, fine where the highlight is.
double metal_dome(double roughness) {
  const materials::RoughConductor metal(
      radiometry::Spectrum::constant(kMetalN), radiometry::Spectrum::constant(kMetalK),
      radiometry::Spectrum::constant(1.0), {materials::FacetShape::ggx, roughness, roughness, 0.0});
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : metal.spectra())
    values.push_back(static_cast<float>(spectrum.at(kUm)));
  for (const float& value : values) rows.push_back(&value);
  // Polar coordinates about the highlight's middle, the radius by steps that grow with it.
  const Vec3 half = math::normalized(kSun + Vec3{0.0, 0.0, 1.0});
  constexpr int kRings = 1500, kTurns = 400;
  double sum = 0.0;
  const double least = 1e-3 * roughness, most = 2.0;
  const double ratio = std::log(most / least + 1.0) / kRings;
  for (int i = 0; i < kRings; ++i) {
    const double r = least * (std::exp((i + 0.5) * ratio) - 1.0), dr = (r + least) * ratio;
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2.0 * pi * (j + 0.5) / kTurns, x = half.x + r * std::cos(turn),
                   y = half.y + r * std::sin(turn);
      if (x * x + y * y >= 1.0) continue;
      materials::BsdfEvent event;
      event.outgoing = {0.0, 0.0, 1.0};
      event.incoming = kSun;
      event.normal = math::as_normal({x, y, std::sqrt(1.0 - x * x - y * y)});
      if (!(event.incoming_cosine() > 0.0)) continue;
      float bsdf = 0.0f;
      metal.evaluate(event, rows, 1, &bsdf);
      sum += static_cast<double>(bsdf) * event.incoming_cosine() * r * dr * 2.0 * pi / kTurns;
    }
  }
  return sum * kIrradiance * kRadius * kRadius;
}

// Planted fault: a dome whose highlight is lost has a tail alone, and one that is twice as rough sends 2 % more.
TEST(SmallHighlights, ARoughMetalDomeIsWithinAPercentWhereverItStands) {
  for (const auto& [roughness, sun] : {std::pair{0.02, "disc"}, {0.05, "point"}}) {
    const double truth = metal_dome(roughness);
    const Judged judged = judge(
        format(
            R"({{"reflectance": 1, "scattering": {{"rough_conductor": {{"n": {}, "k": {}, "roughness": {}}}}}}})",
            kMetalN, kMetalK, roughness),
        sun, 0.0, truth, 2);
    EXPECT_EQ(judged.within, judged.count) << roughness;
    EXPECT_EQ(judged.wrong_and_sure, 0);
    EXPECT_NEAR(judged.mean, 1.0, 0.006);
    RecordProperty(format("mean_{}", sun), format("{:.5f}", judged.mean));
    RecordProperty(format("samples_{}", sun), format("{:.0f}", judged.samples));
  }
  EXPECT_GT(metal_dome(0.1) / metal_dome(0.05), 1.03);
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
}  // namespace ifov::session
