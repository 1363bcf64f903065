// What a run costs that is taken from twice an error to it, against one that is at it from the start; rays
// are counted.
//   bench_refine DOCUMENT [FACTOR]         the document says the tighter error
// Prints one JSON object.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_grid.h"
#include "render/tile_sink.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace {

using namespace ifov;

/// Keeps the tiles of a run.
class Tiles final : public render::TileSink, public render::EarlierTiles {
 public:
  Tiles(int width, int height, int tile_px)
      : width_(width), tile_px_(tile_px), tiles_(render::tile_grid(width, height, tile_px).size()) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const std::scoped_lock lock(mutex_);
    tiles_[render::tile_index(tile.tile.x0, tile.tile.y0, width_, tile_px_)] = tile;
  }
  bool read(std::size_t index, sampling::TileResult& tile) override {
    tile = tiles_[index];
    return true;
  }
  const std::vector<sampling::TileResult>& all() const { return tiles_; }

 private:
  int width_, tile_px_;
  std::mutex mutex_;
  std::vector<sampling::TileResult> tiles_;
};

struct Cost {
  double rays = 0.0, samples = 0.0, values = 0.0, pixels = 0.0, converged = 0.0, memory = 0.0;
};

Cost cost(const Tiles& tiles) {
  Cost sum;
  for (const sampling::TileResult& tile : tiles.all()) {
    sum.rays += static_cast<double>(tile.rays.total());
    sum.memory += static_cast<double>(tile.memory.size());
    sum.samples += static_cast<double>(tile.halo_samples);
    sum.pixels += tile.tile.count();
    for (std::size_t p = 0; p < tile.samples.size(); ++p) {
      sum.samples += tile.samples[p];
      sum.values += tile.radiance_evaluations[p];
      sum.converged += tile.converged(p);
    }
  }
  return sum;
}

/// Share of the values that differ by more than both half-widths allow.
double disagreement(const Tiles& a, const Tiles& b) {
  double apart = 0.0, count = 0.0;
  for (std::size_t t = 0; t < a.all().size(); ++t)
    for (std::size_t i = 0; i < a.all()[t].mean.size(); ++i) {
      const auto &one = a.all()[t], &other = b.all()[t];
      const double allowed = std::hypot(one.half_width[i], other.half_width[i]);
      apart += std::abs(one.mean[i] - other.mean[i]) > allowed + 1e-6 * std::abs(one.mean[i]);
      count += 1.0;
    }
  return apart / count;
}

void run(const char* path, double factor) {
  const session::Session session = session::Session::load(io::read_document(path), nullptr);
  const session::Session::Parts& parts = session.parts();
  if (!parts.tolerance || !parts.plan.sampler->can_refine())
    throw InputError("the document asks for no accuracy");
  session::SamplingPlan loose = session::assemble_sampling(parts.document.sources, parts.document.sampling,
                                                           parts.document.sensor.channels, parts.channels);
  loose.request->error *= factor;
  const auto loose_limits = parts.tolerance_of(loose);
  const auto render = [&](render::RenderJob job, bool keep, render::EarlierTiles* earlier) {
    job.keep_memory = keep;
    job.earlier = earlier;
    auto tiles = std::make_unique<Tiles>(parts.info.width_px, parts.info.height_px, job.tile_px);
    render::render_image(job, {}, *tiles);
    return tiles;
  };
  const auto first = render(parts.job(loose, loose_limits.get()), true, nullptr);
  const auto refined = render(parts.job(), true, first.get());
  const auto direct = render(parts.job(), false, nullptr);
  const Cost a = cost(*first), b = cost(*refined), c = cost(*direct);
  std::puts(
      format(
          R"({{"ratio": {:.4f}, "ratio_samples": {:.4f}, "first_over_direct": {:.4f}, "rays_direct": {}, "samples_per_pixel": {:.1f}, "values_per_pixel": {:.1f}, )"
          R"("disagree": {:.5f}, "disagree_first": {:.5f}, "converged": {:.5f}, "converged_direct": {:.5f}, "bytes_per_pixel": {:.0f}, "bytes_per_pixel_first": {:.0f}}})",
          b.rays / c.rays, b.samples / c.samples, a.rays / c.rays, c.rays, c.samples / c.pixels,
          c.values / c.pixels, disagreement(*refined, *direct), disagreement(*refined, *first),
          b.converged / b.pixels, c.converged / c.pixels, b.memory / b.pixels, a.memory / a.pixels)
          .c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: bench_refine DOCUMENT [FACTOR]\n");
    return 2;
  }
  try {
    run(argv[1], argc == 3 ? std::atof(argv[2]) : 2.0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_refine: %s\n", error.what());
    return 1;
  }
  return 0;
}
