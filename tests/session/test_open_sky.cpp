// The open sky's integral in place of what paths draw from it (TransportOptions::sky_shares): the same mean, less noise.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/document/document.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/open_sky.h"
#include "sampling/hash.h"
#include "sampling/image/levels.h"
#include "sampling/random.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::test_open_sky {
namespace {

constexpr const char* kDome = R"({"ifov": 1,
 "scene": {
   "materials": {"lawn": {"reflectance": 0.12}, "stone": {"reflectance": 0.5}},
   "objects": [{"plane": {}, "material": "lawn"},
               {"hemisphere": {"center": ["0 m", "0 m", "0 m"], "radius": "3 m"}, "material": "stone"}]},
 "light": {"sun": {"disc": {"zenith": "45 deg", "azimuth": "225 deg"}}}, "atmosphere": {"profile": "mid-latitude summer"},
 "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [16, 12]}},
            "channels": [{"name": "blue", "gaussian": {"center": "0.45 um", "fwhm": "20 nm"}},
                         {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "20 nm"}}]},
 "sampling": {"accuracy": {"error": "1 %"}}})";

/// The same with a dome of metal, whose lobes rays are sent to from the lawn.
std::string metal_dome() {
  std::string text = kDome;
  const std::string stone = R"("stone": {"reflectance": 0.5})";
  return text.replace(
      text.find(stone), stone.size(),
      R"("stone": {"reflectance": 0.8, "scattering": {"rough_conductor": {"index": "aluminium", "roughness": 0.25}}})");
}

struct Moments {
  double mean[2] = {}, variance[2] = {};
};

/// Of paths through random points of a square of the image, in both channels.
class OpenSky : public testing::Test {
 protected:
  static constexpr int kPaths = 20000;

  std::vector<float> values(const std::vector<float>* shares, double x0_px, double y0_px,
                            double side_px) const {
    const render::RenderJob job = session_.parts().job();
    transport::TransportOptions options = job.transport;
    options.sky_shares = shares;
    render::SceneField field(job.scene, job.camera, options, render::LabelDetail::material, nullptr);
    std::vector<sampling::PathRequest> requests(kPaths);
    for (int k = 0; k < kPaths; ++k)
      requests[static_cast<std::size_t>(k)] = {
          {x0_px + side_px * sampling::unit_double(sampling::hash(k, 1)),
           y0_px + side_px * sampling::unit_double(sampling::hash(k, 2))},
          7,
          static_cast<std::uint32_t>(k)};
    std::vector<sampling::Label> labels(kPaths);
    const std::size_t stride = static_cast<std::size_t>(field.stride());
    std::vector<float> rows(kPaths * stride), out;
    field.values(requests, labels, rows);
    for (std::size_t k = 0; k < kPaths; ++k) out.insert(out.end(), &rows[k * stride], &rows[k * stride] + 2);
    return out;
  }
  static Moments of(const std::vector<float>& values) {
    Moments m;
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t k = c; k < values.size(); k += 2) m.mean[c] += static_cast<double>(values[k]) / kPaths;
      for (std::size_t k = c; k < values.size(); k += 2)
        m.variance[c] += std::pow(static_cast<double>(values[k]) - m.mean[c], 2) / (kPaths - 1);
    }
    return m;
  }
  /// z of the difference of two sets' means, of independent paths.
  static double z(const Moments& a, const Moments& b, int c) {
    return (a.mean[c] - b.mean[c]) / std::sqrt((a.variance[c] + b.variance[c]) / kPaths);
  }

  explicit OpenSky(const std::string& document = kDome)
      : session_(session::Session::load(io::parse_document(document, "dome.json"), nullptr)) {}

  void judge_means() const;

  session::Session session_;
};

class OpenSkyBesideLobes : public OpenSky {
 protected:
  OpenSkyBesideLobes() : OpenSky(metal_dome()) {}
};

void OpenSky::judge_means() const {
  const std::vector<float> half(session_.parts().scene.materials.size(), 0.5f), most(half.size(), 0.9f);
  // Sides of the dome, with the ground before it, and open ground. The same paths weighed by two shares differ by a part of
  // what is 0 in the mean, which shows what is wrong by a thousandth.
  for (const auto& [x, y] : {std::pair{6.0, 5.5}, {8.0, 4.0}, {5.0, 4.0}, {0.0, 0.0}}) {
    const Moments without = of(values(nullptr, x, y, 2.0));
    const std::vector<float> less = values(&half, x, y, 2.0), more = values(&most, x, y, 2.0);
    std::vector<float> difference;
    for (std::size_t k = 0; k < less.size(); ++k) difference.push_back(more[k] - less[k]);
    const Moments with = of(more), apart = of(difference);
    for (int c = 0; c < 2; ++c) {
      EXPECT_LT(std::abs(z(with, without, c)), 4.0) << x << " " << c;
      EXPECT_LE(std::abs(apart.mean[c]), 4.0 * std::sqrt(apart.variance[c] / kPaths)) << x << " " << c;
      EXPECT_LT(std::abs(apart.mean[c]), 2e-3 * with.mean[c]) << x << " " << c;
    }
  }
}

TEST_F(OpenSky, ChangesNoMean) { judge_means(); }

// A path that was sent to a lobe besides is another path of the same first surface, whose share of the sky counts once.
TEST_F(OpenSkyBesideLobes, ChangesNoMean) { judge_means(); }

TEST_F(OpenSky, TakesTheNoiseOfOpenGround) {
  const render::RenderJob job = session_.parts().job();
  const std::vector<float> shares = render::open_sky_shares(job.scene, job.camera);
  ASSERT_FALSE(shares.empty());
  for (const float share : shares) {
    EXPECT_GT(share, 0.5f);
    EXPECT_LE(share, 0.9f);
  }
  const Moments without = of(values(nullptr, 0.0, 0.0, 2.0)), with = of(values(&shares, 0.0, 0.0, 2.0));
  for (int c = 0; c < 2; ++c) EXPECT_LT(with.variance[c], 0.25 * without.variance[c]) << c;
}

// Of values in two levels the first has what the open sky gives, whether a path is followed or not, and both add up to what they did.
TEST_F(OpenSky, BelongsToTheFirstLevel) {
  constexpr std::uint32_t kGroup = 500;
  const render::RenderJob job = session_.parts().job();
  const std::vector<float> shares = render::open_sky_shares(job.scene, job.camera);
  std::vector<sampling::PathRequest> requests(kPaths);
  for (int k = 0; k < kPaths; ++k)
    requests[static_cast<std::size_t>(k)] = {{2.0 * sampling::unit_double(sampling::hash(k, 1)),
                                              2.0 * sampling::unit_double(sampling::hash(k, 2))},
                                             7,
                                             static_cast<std::uint32_t>(k)};
  const std::vector<std::uint32_t> counts(kPaths / kGroup, kGroup);
  const auto levels = [&](const std::vector<float>* taken, std::uint8_t followed, bool direct) {
    transport::TransportOptions options = job.transport;
    options.sky_shares = taken;
    render::SceneField field(job.scene, job.camera, options, render::LabelDetail::material, nullptr);
    sampling::LevelSums sums;
    field.levels({requests, std::vector<std::uint8_t>(kPaths, followed), counts}, sums);
    const std::vector<float>& rows = direct ? sums.direct : sums.rest;
    std::array<double, 2> mean{};
    for (std::size_t g = 0; g < counts.size(); ++g)
      for (std::size_t c = 0; c < 2; ++c)
        mean[c] += static_cast<double>(rows[g * static_cast<std::size_t>(field.stride()) + c]) /
                   static_cast<double>(counts.size());
    return mean;
  };
  const auto direct = levels(&shares, 1, true), unfollowed = levels(&shares, 0, true),
             rest = levels(&shares, 1, false), plain_direct = levels(nullptr, 1, true),
             plain_rest = levels(nullptr, 1, false);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(unfollowed[c], direct[c]) << c;
    EXPECT_LT(rest[c], 0.6 * plain_rest[c]) << c;
    EXPECT_NEAR(direct[c] + rest[c], plain_direct[c] + plain_rest[c], 5e-3 * direct[c]) << c;
  }
}

}  // namespace
}  // namespace ifov::test_open_sky
