// How errors of neighbouring pixels go together, and whether intervals of means over regions hold: renders one document
// with many seeds and compares with points drawn at random in strata of their own.
//
//   bench_regions FILE [SEEDS [STRATA]]        120 seeds, 140 x 140 strata a pixel; first channel
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/document/document.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/means/region_interval.h"
#include "sampling/tile.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace {

using namespace ifov;

struct Image final : render::TileSink {
  Image(int image_width, int image_height, int channel_count)
      : width(image_width), channels(static_cast<std::size_t>(channel_count)) {
    const auto pixels = static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height);
    for (auto* values : {&mean, &variance, &half_width, &border_share}) values->resize(pixels);
  }
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
      for (int x = tile.tile.x0; x < tile.tile.x1; ++x) {
        const auto from =
            static_cast<std::size_t>((y - tile.tile.y0) * tile.tile.width() + x - tile.tile.x0) * channels;
        const auto to = static_cast<std::size_t>(y * width + x);
        mean[to] = tile.mean[from];
        variance[to] = tile.variance_geometry[from] + tile.variance_path[from];
        half_width[to] = tile.half_width[from];
        border_share[to] = variance[to] > 0.0 ? tile.variance_geometry[from] / variance[to] : 0.0;
      }
  }
  int width;
  std::size_t channels;
  std::vector<double> mean, variance, half_width, border_share;
};

struct Trials {
  int width = 0, height = 0;
  std::vector<double> truth, mean, variance;  ///< by pixel; the last two over all seeds
  std::vector<Image> images;
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
};

std::vector<double> plain(const session::Session::Parts& parts, int strata) {
  render::SceneField field(*parts.spectral_scene, *parts.camera, parts.job().transport,
                           render::LabelDetail::material);
  const auto stride = static_cast<std::size_t>(field.stride()),
             count = static_cast<std::size_t>(strata * strata);
  std::mt19937_64 random(12345);
  std::uniform_real_distribution<double> uniform;
  std::vector<sampling::PathRequest> requests(count);
  std::vector<sampling::Label> labels(count);
  std::vector<float> values(count * stride);
  std::vector<double> means;
  for (int y = 0; y < parts.camera->height_px(); ++y)
    for (int x = 0; x < parts.camera->width_px(); ++x) {
      for (int k = 0; k < strata * strata; ++k)
        requests[static_cast<std::size_t>(k)] = {
            {x + (k % strata + uniform(random)) / strata, y + (k / strata + uniform(random)) / strata},
            random(),
            0};
      field.values(requests, labels, values);
      double sum = 0.0;
      for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(values[k * stride]);
      means.push_back(sum / static_cast<double>(count));
    }
  return means;
}

Trials run(const session::Session::Parts& parts, int seeds, int strata) {
  Trials trials;
  trials.width = parts.camera->width_px();
  trials.height = parts.camera->height_px();
  trials.truth = plain(parts, strata);
  trials.mean.resize(trials.truth.size());
  trials.variance.resize(trials.truth.size());
  for (int k = 0; k < seeds; ++k) {
    Image image(trials.width, trials.height, static_cast<int>(parts.info.channels.size()));
    render::RenderJob job = parts.job();
    job.seed = 9000 + static_cast<std::uint64_t>(k);
    render::render_image(job, {}, image);
    for (std::size_t p = 0; p < trials.truth.size(); ++p) {
      trials.mean[p] += image.mean[p] / seeds;
      trials.variance[p] += image.variance[p] / seeds;
    }
    trials.images.push_back(std::move(image));
  }
  return trials;
}

double correlation(const Trials& trials, int dx, int dy) {
  double products = 0.0, squares_a = 0.0, squares_b = 0.0;
  for (const Image& image : trials.images)
    for (int y = 0; y + dy < trials.height; ++y)
      for (int x = 0; x + dx < trials.width; ++x) {
        const std::size_t p = trials.at(x, y), q = trials.at(x + dx, y + dy);
        if (!(trials.variance[p] > 0.0 && trials.variance[q] > 0.0)) continue;
        const double a = (image.mean[p] - trials.mean[p]) / std::sqrt(trials.variance[p]),
                     b = (image.mean[q] - trials.mean[q]) / std::sqrt(trials.variance[q]);
        products += a * b;
        squares_a += a * a;
        squares_b += b * b;
      }
  return products / std::sqrt(squares_a * squares_b);
}

void print_pixels(const Trials& trials) {
  double spread = 0.0, variance = 0.0, common = 0.0, standard_errors = 0.0;
  for (std::size_t p = 0; p < trials.truth.size(); ++p) {
    if (!(trials.variance[p] > 0.0)) continue;
    for (const Image& image : trials.images) spread += std::pow(image.mean[p] - trials.mean[p], 2);
    variance += trials.variance[p] * static_cast<double>(trials.images.size());
    common += trials.mean[p] - trials.truth[p];
    standard_errors += std::sqrt(trials.variance[p]);
  }
  std::printf("scatter over standard error %.2f; common to all pixels %+.2f standard errors\n",
              std::sqrt(spread / variance), common / standard_errors);
  std::printf("correlation of pixels at (1, 0) %.3f, (0, 1) %.3f, (1, 1) %.3f, (2, 0) %.3f, (0, 2) %.3f\n",
              correlation(trials, 1, 0), correlation(trials, 0, 1), correlation(trials, 1, 1),
              correlation(trials, 2, 0), correlation(trials, 0, 2));
}

void print_regions(const Trials& trials, const sampling::RegionRule& rule, int size) {
  std::mt19937 random(7);
  double held = 0.0, alone = 0.0, widths = 0.0, squares = 0.0, count = 0.0;
  for (int region = 0; region < 60; ++region) {
    const int x0 = static_cast<int>(random() % static_cast<unsigned>(trials.width - size + 1)),
              y0 = static_cast<int>(random() % static_cast<unsigned>(trials.height - size + 1));
    for (const Image& image : trials.images) {
      sampling::RegionSum sum;
      double truth = 0.0;
      for (int y = y0; y < y0 + size; ++y)
        for (int x = x0; x < x0 + size; ++x) {
          const std::size_t p = trials.at(x, y);
          sum.add(image.mean[p], image.half_width[p], image.border_share[p]);
          truth += trials.truth[p] / (size * size);
        }
      const double error = std::abs(sum.mean() - truth), width = sum.half_width(rule);
      held += error <= width + 1e-6 * truth ? 1.0 : 0.0;
      alone += error <= sum.half_width({1.0, 0.0, 0.0}) + 1e-6 * truth ? 1.0 : 0.0;
      widths += width;
      squares += error * error;
      ++count;
    }
  }
  std::printf(
      "%3d x %-3d coverage %.3f, half-width over RMS error %.1f; as if errors were independent: coverage %.3f\n",
      size, size, held / count, widths / count / std::sqrt(squares / count), alone / count);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fputs("bench_regions FILE [SEEDS [STRATA]]\n", stderr);
    return 1;
  }
  try {
    std::ifstream file(arguments[1]);
    std::stringstream text;
    text << file.rdbuf();
    const session::Session session =
        session::Session::load(io::parse_document(text.str(), arguments[1]), nullptr);
    const auto& parts = session.parts();
    const Trials trials =
        run(parts, count > 2 ? std::atoi(arguments[2]) : 120, count > 3 ? std::atoi(arguments[3]) : 140);
    print_pixels(trials);
    const int side = std::min(trials.width, trials.height);
    for (int size = 1; size < side; size *= 2)
      print_regions(trials, sampling::RegionRule::of_accuracy(parts.info.footprint_px), size);
    print_regions(trials, sampling::RegionRule::of_accuracy(parts.info.footprint_px), side);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
