// Intervals of means over regions hold as often as they say: in flat scenes under a Sun in the zenith, where the truth is a
// sum of areas, and over a texture, where it is a sum over many points.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/intervals/bounded_error.h"
#include "sampling/means/region_interval.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_region_coverage {
namespace {

const sampling::BoundedError kJoint(0.95);

using sampling::RegionRule;
using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

constexpr int kSide = 12, kSeeds = 100, kRegions = 25;
constexpr double kDark = 0.05, kBright = 0.6;

Polygon quad(double x, double y, double radius, double turn, double stretch = 1.0) {
  Polygon corners;
  for (const auto& [u, v] : {Point{1, 1}, Point{-1, 1}, Point{-1, -1}, Point{1, -1}}) {
    const double a = u * radius * stretch, b = v * radius;
    corners.push_back(
        {x + a * std::cos(turn) - b * std::sin(turn), y + a * std::sin(turn) + b * std::cos(turn)});
  }
  return corners;
}

/// What is left of a polygon where sign * (coordinate - bound) <= 0.
Polygon cut(const Polygon& polygon, std::size_t axis, double bound, double sign) {
  Polygon left;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
    if (da <= 0.0) left.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
      const double t = da / (da - db);
      left.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return left;
}

double area_inside(const Polygon& polygon, double x0, double y0, double x1, double y1) {
  const Polygon p = cut(cut(cut(cut(polygon, 0, x0, -1), 0, x1, 1), 1, y0, -1), 1, y1, 1);
  double twice = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Point &a = p[k], &b = p[(k + 1) % p.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * std::abs(twice);
}

struct Flat {
  const char* name;
  std::vector<Polygon> bright;  ///< apart from each other
  const char* error = "1 %";
  double psf_px = 0.0;  ///< with one, only the whole image, in which all lies well inside
};

std::string text_of(const Flat& flat) {
  std::string objects = R"({"plane": {}, "material": "dark"})";
  for (const Polygon& polygon : flat.bright) {
    std::string corners;
    for (const Point& p : polygon)
      corners += format("{}[\"{:.9f} m\", \"{:.9f} m\", \"1 cm\"]", corners.empty() ? "" : ", ", p[0], p[1]);
    objects += format(R"(, {{"polygon": {{"vertices": [{}]}}, "material": "bright"}})", corners);
  }
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{"dark": {{"reflectance": {}}}, "bright": {{"reflectance": {}}}}}, "objects": [{}]}},
          "light": {{"sun": {{"point": {{"zenith": "0 deg", "azimuth": "0 deg"}}}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [{}, {}]}}}}, {}
            "channels": [{{"name": "red", "top_hat": {{"from": "0.63 um", "to": "0.68 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "{}"}}}}}})",
      kDark, kBright, objects, kSide, kSide,
      flat.psf_px > 0.0 ? format(R"("psf": {{"gaussian": {{"sigma": "{} px"}}}},)", flat.psf_px) : "",
      flat.error);
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kSide + x); }

struct Trials {
  std::vector<double> truth;  ///< radiance, by pixel
  std::vector<sampling::TileResult> results;
  RegionRule rule;
};

void render_seeds(const Session::Parts& parts, Trials& trials) {
  trials.rule = RegionRule::of_accuracy(parts.info.footprint_px);
  for (int k = 0; k < kSeeds; ++k) {
    render::RenderJob job = parts.job();
    job.seed = 400 + static_cast<std::uint64_t>(k);
    render::RenderControl control;
    control.threads = 1;
    OneTile tile;
    render::render_image(job, control, tile);
    trials.results.push_back(std::move(tile.result));
  }
}

Trials trials_of(const Flat& flat) {
  Trials trials;
  const double half = 0.5 * kSide;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double share = 0.0;
      for (const Polygon& p : flat.bright)
        share += area_inside(p, x - half, half - y - 1, x - half + 1, half - y);
      trials.truth.push_back(share);
    }
  const Session session = Session::load(io::parse_document(text_of(flat), "flat.json"), nullptr);
  render_seeds(session.parts(), trials);
  // Open ground has this radiance to the last bit, bare and seen through a PSF alike.
  const double dark = *std::min_element(trials.results[0].mean.begin(), trials.results[0].mean.end());
  for (double& share : trials.truth) share = dark * (1.0 + (kBright / kDark - 1.0) * share);
  return trials;
}

/// Warm ground with a pattern of waves, 0.25 m a cell.
Trials trials_of_texture() {
  const auto file = std::filesystem::temp_directory_path() / format("ifov_texture_{}.asc", getpid());
  constexpr int kCells = 64;
  std::ofstream map(file);
  map << format("ncols {0}\nnrows {0}\nxllcorner -8\nyllcorner -8\ncellsize 0.25\n", kCells);
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i)
      map << format("{:.3f}\n",
                    25.0 + 4.0 * std::sin(0.9 * i + 0.31 * j) + 2.0 * std::sin(1.7 * i - 1.3 * j));
  map.close();
  const std::string text = format(
      R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"emissivity": 1, "temperature":
            {{"map": {{"file": "{}", "low_left": ["-8 m", "-8 m"], "size": ["16 m", "16 m"], "unit": "degC"}}}}}}}},
            "objects": [{{"plane": {{}}, "material": "ground"}}]}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [{}, {}]}}}},
            "channels": [{{"name": "11 um", "monochromatic": {{"at": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "0.1 K"}}}}}})",
      file.string(), kSide, kSide);
  const Session session = Session::load(io::parse_document(text, "texture.json"), nullptr);
  std::filesystem::remove(file);
  Trials trials;
  render_seeds(session.parts(), trials);
  render::SceneField field(*session.parts().spectral_scene, *session.parts().camera,
                           session.parts().job().transport, render::LabelDetail::material);
  constexpr int kPoints = 48;
  std::vector<sampling::PathRequest> requests(kPoints * kPoints);
  std::vector<sampling::Label> labels(requests.size());
  std::vector<float> values(requests.size() * static_cast<std::size_t>(field.stride()));
  for (int p = 0; p < kSide * kSide; ++p) {
    for (int k = 0; k < kPoints * kPoints; ++k)
      requests[static_cast<std::size_t>(k)] = {
          {p % kSide + (k % kPoints + 0.5) / kPoints, p / kSide + (k / kPoints + 0.5) / kPoints},
          static_cast<std::uint64_t>(k),
          0};
    field.values(requests, labels, values);
    double sum = 0.0;
    for (std::size_t k = 0; k < requests.size(); ++k)
      sum += static_cast<double>(values[k * static_cast<std::size_t>(field.stride())]);
    trials.truth.push_back(sum / (kPoints * kPoints));
  }
  return trials;
}

struct Judged {
  double coverage = 0.0;
  double width_over_rms = 0.0;  ///< half-width over the RMS error
};

Judged judge(const Trials& trials, const RegionRule& rule, int size, bool whole_image) {
  std::mt19937 random(7);
  double held = 0.0, widths = 0.0, squares = 0.0, count = 0.0;
  for (int region = 0; region < (whole_image ? 1 : kRegions); ++region) {
    std::uniform_int_distribution<int> place(0, kSide - size);
    const int x0 = place(random), y0 = place(random);
    for (const sampling::TileResult& r : trials.results) {
      sampling::RegionSum sum;
      double truth = 0.0;
      for (int y = y0; y < y0 + size; ++y)
        for (int x = x0; x < x0 + size; ++x) {
          const std::size_t p = at(x, y);
          const float geometry = r.variance_geometry[p], all = geometry + r.variance_path[p];
          sum.add(r.mean[p], r.half_width[p], all > 0.0f ? geometry / all : 0.0f);
          truth += trials.truth[p] / (size * size);
        }
      const double error = std::abs(sum.mean() - truth), width = sum.half_width(rule, kJoint);
      held += error <= width + 1e-6 * truth ? 1.0 : 0.0;
      widths += width;
      squares += error * error;
      ++count;
    }
  }
  return {held / count, widths / count / std::sqrt(squares / count)};
}

Flat slab(double turn) {
  return {turn == 0.0 ? "aligned slab" : "turned slab", {quad(0.13, -0.21, 4.37, turn)}};
}

Flat rows() {
  Flat flat{"aligned rows", {}};
  for (int k = 0; k < 5; ++k)
    flat.bright.push_back(quad(-4.1 + 2.03 * k, 0.17, 0.31, std::numbers::pi / 2, 16.0));
  return flat;
}

Flat patches(double pitch, double radius, const char* error) {
  Flat flat{"patches", {}, error};
  const int n = static_cast<int>(4.5 / pitch);
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      flat.bright.push_back(quad(pitch * i + 0.03, pitch * j - 0.05, radius, 0.65 * i + 1.07 * j));
  return flat;
}

Flat blurred() {
  Flat flat{"blurred slab", {quad(0.13, -0.21, 2.37, 0.0)}};
  flat.psf_px = 0.6;
  return flat;
}

void expect_that_intervals_hold(const Trials& trials, const char* name, bool whole_only) {
  for (const int size : {1, 2, 4, 8, kSide}) {
    if (whole_only && size < kSide) continue;
    const Judged judged = judge(trials, trials.rule, size, size == kSide);
    std::printf("%-14s %2d x %-2d coverage %.3f, half-width over RMS error %.1f\n", name, size, size,
                judged.coverage, judged.width_over_rms);
    EXPECT_GE(judged.coverage, 0.93) << size;
    // A region's mean is known better than its pixels are.
    if (size > 2) {
      EXPECT_LT(judged.width_over_rms, 60.0) << size;
    }
  }
}

class RegionCoverage : public testing::TestWithParam<Flat> {};

TEST_P(RegionCoverage, IntervalsHoldAndAreNotIdle) {
  expect_that_intervals_hold(trials_of(GetParam()), GetParam().name, GetParam().psf_px > 0.0);
}

TEST(RegionCoverageOfTexture, IntervalsHoldAndAreNotIdle) {
  expect_that_intervals_hold(trials_of_texture(), "texture", false);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegionCoverage,
                         testing::Values(slab(0.0), slab(0.12), rows(), patches(1.03, 0.35, "2 %"),
                                         blurred()),
                         [](const auto& scene) {
                           std::string name = scene.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

/// The planted fault: errors of pixels taken for independent.
TEST(RegionFault, IntervalsOfIndependentErrorsFailWherePixelsErrAlike) {
  const Trials trials = trials_of(patches(1.03, 0.35, "2 %"));
  EXPECT_LT(judge(trials, {1.0, 0.0, 0.0}, kSide, true).coverage, 0.7);
  EXPECT_GE(judge(trials, trials.rule, kSide, true).coverage, 0.93);
}

}  // namespace
}  // namespace ifov::session::test_region_coverage
