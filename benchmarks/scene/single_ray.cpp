#include "scene/single_ray.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <vector>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "scene/forest.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::benchmarks {

namespace {

constexpr int kCheckedEvery = 521;  // of the pixels, in rows

class NoSink final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult&) override {}
};

/// Keeps every 521st pixel.
class SomePixels final : public render::TileSink {
 public:
  explicit SomePixels(int width) : width_(width) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const std::scoped_lock lock(mutex_);
    const auto columns = static_cast<std::size_t>(tile.columns);
    std::size_t k = 0;
    for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
      for (int x = tile.tile.x0; x < tile.tile.x1; ++x, ++k)
        if ((y * width_ + x) % kCheckedEvery == 0)
          spectra[y * width_ + x].assign(tile.mean.begin() + static_cast<std::ptrdiff_t>(k * columns),
                                         tile.mean.begin() + static_cast<std::ptrdiff_t>((k + 1) * columns));
  }
  std::map<int, std::vector<float>> spectra;

 private:
  int width_;
  std::mutex mutex_;
};

session::Session load(const std::filesystem::path& folder, int bands, bool gaussian) {
  ForestView view;
  view.bands = bands;
  view.gaussian = gaussian;
  view.sampling = R"({"single": {}, "max_depth": 1})";
  return session::Session::load(
      io::parse_document(forest_document(view), (folder / format("forest_{}.json", bands)).string()),
      nullptr);
}

double render_s(const session::Session& session, int threads, render::TileSink& sink) {
  const auto start = std::chrono::steady_clock::now();
  render::RenderControl control;
  control.threads = threads;
  render::render_image(session.parts().job(), control, sink);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int material_number(const std::string& name) {
  return name.starts_with("ground") ? std::stoi(name.substr(6))
                                    : kForestGroundMaterials + std::stoi(name.substr(4));
}

/// L = rho / pi * E * cos(incidence) where the point sees the Sun, one ray at a time.
double largest_relative_error(const session::Session& session) {
  const session::Session::Parts& parts = session.parts();
  const int width = parts.camera->width_px();
  SomePixels rendered(width);
  render_s(session, 0, rendered);
  double largest = 0.0;
  for (const auto& [pixel, spectrum] : rendered.spectra) {
    const sampling::FocalPoint centre{pixel % width + 0.5, static_cast<double>(pixel / width) + 0.5};
    math::Ray ray;
    geometry::SurfacePoint hit;
    parts.camera->rays({&centre, 1}, {&ray, 1});
    parts.scene.world->intersect({&ray, 1}, {&hit, 1});
    if (!hit.hit()) throw std::runtime_error("a ray of the forest benchmark meets nothing");
    const math::Vec3 to_sun = parts.scene.sun->direction;
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    double cosine = std::max(0.0, math::dot(outward, to_sun));
    if (cosine > 0.0) {
      const math::Ray shadow{hit.position_m + hit.offset_m * outward, to_sun};
      std::uint8_t blocked = 0;
      parts.scene.world->occluded({&shadow, 1}, {&blocked, 1});
      if (blocked != 0) cosine = 0.0;
    }
    const int material =
        material_number(parts.scene.materials[parts.scene.resolve(hit).constituents[0].material].name);
    for (std::size_t band = 0; band < spectrum.size(); ++band) {
      const double expected = forest_reflectance(material, static_cast<int>(band)) / std::numbers::pi *
                              kForestSun_w_m2_um * cosine;
      const double error = std::abs(static_cast<double>(spectrum[band]) - expected);
      largest = std::max(largest, expected > 0.0 ? error / expected : error);
    }
  }
  return largest;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::string time_single_rays(const std::filesystem::path& folder) {
  constexpr int kRounds = 3;
  const session::Session many = load(folder, 210, false), one = load(folder, 1, false);
  NoSink sink;
  render_s(many, 0, sink);  // pages and caches warm
  std::vector<double> many_two, many_one, one_two;
  for (int round = 0; round < kRounds; ++round) {
    many_two.push_back(render_s(many, 2, sink));
    one_two.push_back(render_s(one, 2, sink));
    many_one.push_back(render_s(many, 1, sink));
  }
  const double pixels =
      static_cast<double>(many.parts().camera->width_px()) * many.parts().camera->height_px();
  return format(
      R"({{"pixels": {}, "bands_210_threads_2_s": {}, "bands_1_threads_2_s": {}, "bands_210_threads_1_s": {}, )"
      R"("largest_relative_error": {}}})",
      pixels, median(many_two), median(one_two), median(many_one), largest_relative_error(many));
}

}  // namespace ifov::benchmarks
