#include "scene/converge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "scene/forest.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::benchmarks {

namespace {

class Image final : public render::TileSink {
 public:
  Image(int width, int height, int bands)
      : width_(width),
        bands_(bands),
        mean(static_cast<std::size_t>(width) * static_cast<std::size_t>(height * bands)) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const std::scoped_lock lock(mutex_);
    std::size_t k = 0;
    for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
      for (int x = tile.tile.x0; x < tile.tile.x1; ++x, ++k) {
        const std::size_t to = static_cast<std::size_t>((y * width_ + x) * bands_);
        for (int b = 0; b < bands_; ++b)
          mean[to + static_cast<std::size_t>(b)] =
              tile.mean[k * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(b)];
        samples += tile.samples[k];
        paths += tile.radiance_evaluations[k];
      }
  }

 private:
  int width_, bands_;
  std::mutex mutex_;

 public:
  std::vector<float> mean;
  double samples = 0.0, paths = 0.0;
};

ForestView view_of(const CloseView& close, std::string sampling) {
  ForestView view;
  view.bands = close.bands;
  view.pixels = close.pixels;
  view.side_m = close.side_m;
  view.sky_w_m2_sr_um = kCloseViewSky_w_m2_sr_um;
  view.sampling = std::move(sampling);
  return view;
}

session::Session load(const std::filesystem::path& folder, const ForestView& view) {
  return session::Session::load(io::parse_document(forest_document(view), (folder / "close.json").string()),
                                nullptr);
}

double render_s(const session::Session& session, std::uint64_t seed, Image& image) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  const auto start = std::chrono::steady_clock::now();
  render::render_image(job, {}, image);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += format("{}{:.7g}", text.empty() ? "" : ", ", value);
  return "[" + text + "]";
}

/// Three renderings of the view against the reference, as JSON. The variance of a rendering is taken to fall
/// with its paths, so that the share of the difference that is the reference's own can be removed.
std::string measure(const session::Session& session, const CloseView& view, const Image& reference,
                    double reference_paths) {
  constexpr int kTrials = 3;
  const auto bands = static_cast<std::size_t>(view.bands);
  const double pixels = static_cast<double>(view.pixels) * view.pixels;
  std::vector<double> seconds, rms(bands);
  double samples = 0.0, paths = 0.0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Image image(view.pixels, view.pixels, view.bands);
    seconds.push_back(render_s(session, 100 + trial, image));
    std::vector<double> squares(bands);
    for (std::size_t k = 0; k < image.mean.size(); ++k) {
      const double difference = static_cast<double>(image.mean[k]) - static_cast<double>(reference.mean[k]);
      squares[k % bands] += difference * difference;
    }
    const double own_share = 1.0 / (1.0 + image.paths / pixels / reference_paths);
    for (std::size_t b = 0; b < bands; ++b) rms[b] += std::sqrt(own_share * squares[b] / pixels) / kTrials;
    samples += image.samples / pixels / kTrials;
    paths += image.paths / pixels / kTrials;
  }
  std::sort(seconds.begin(), seconds.end());
  return format(R"({{"seconds": {}, "rms": {}, "samples": {}, "paths": {}}})", seconds[kTrials / 2],
                list(rms), samples, paths);
}

}  // namespace

std::string converge(const std::filesystem::path& folder, const CloseView& view, const std::string& error,
                     int reference_samples) {
  const auto bands = static_cast<std::size_t>(view.bands);
  const auto grid = [](int side) {
    return format(R"({{"grid": {{"elements": [{}, {}]}}, "tile": 32}})", side, side);
  };
  Image reference(view.pixels, view.pixels, view.bands);
  render_s(load(folder, view_of(view, grid(static_cast<int>(std::lround(std::sqrt(reference_samples)))))),
           4711, reference);
  std::vector<double> mean(bands);
  for (std::size_t k = 0; k < reference.mean.size(); ++k)
    mean[k % bands] +=
        static_cast<double>(reference.mean[k]) / (static_cast<double>(view.pixels) * view.pixels);

  const std::string accuracy = format(R"({{"accuracy": {{"error": "{}"}}, "tile": 32}})", error);
  return format(R"({{"accuracy": {}, "grid": {}, "mean": {}}})",
                measure(load(folder, view_of(view, accuracy)), view, reference, reference_samples),
                measure(load(folder, view_of(view, grid(6))), view, reference, reference_samples),
                list(mean));
}

std::string describe(const CloseView& view) {
  std::string rows;
  for (int m = 0; m < kForestGroundMaterials + 2; ++m) {
    std::vector<double> row;
    for (int b = 0; b < view.bands; ++b) row.push_back(forest_reflectance(m, b));
    rows += (m > 0 ? ", " : "") + list(row);
  }
  const double zenith_rad = 35.0 * std::numbers::pi / 180.0, azimuth_rad = 135.0 * std::numbers::pi / 180.0;
  const std::vector<double> sun{std::sin(zenith_rad) * std::sin(azimuth_rad),
                                std::sin(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad)};
  return format(
      R"({{"reflectance": [{}], "light": {{"sun_direction": {}, "sun_irradiance": {}, "sky_radiance": {}}}, )"
      R"("pixels": {}, "side_m": {}}})",
      rows, list(sun), kForestSun_w_m2_um, kCloseViewSky_w_m2_sr_um, view.pixels, view.side_m);
}

}  // namespace ifov::benchmarks
