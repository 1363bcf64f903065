#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>

#include "render/image_renderer.h"
#include "render/tile_grid.h"
#include "render/tile_sink.h"
#include "sampling/grid_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_image_renderer {
namespace {

using test::SmallScene;

/// Which tiles came, in their order.
struct Order final : render::TileSink {
  explicit Order(const std::vector<sampling::PixelRect>& tiles) : grid(tiles) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const auto place = std::find_if(grid.begin(), grid.end(), [&](const sampling::PixelRect& rect) {
      return rect.x0 == tile.tile.x0 && rect.y0 == tile.tile.y0;
    });
    const std::scoped_lock lock(mutex);
    came.push_back(static_cast<int>(place - grid.begin()));
  }
  std::vector<sampling::PixelRect> grid;
  std::mutex mutex;
  std::vector<int> came;
};

constexpr int kSide = 48, kTile = 8;

std::vector<int> order_of(int threads, std::span<const int> wanted) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.5, 300.0));
  const transport::SpectralScene& spectral = scene.build();
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.gsd_m = 1.0;
  settings.start_height_m = 10.0;
  const sensor::OrthographicCamera camera(settings);
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const sampling::SingleSampler sampler;
  render::RenderJob job{spectral, camera, footprint, sampler};
  job.tile_px = kTile;
  render::RenderControl control;
  control.threads = threads;
  control.tile_order = wanted;
  Order order(render::tile_grid(kSide, kSide, kTile));
  render::render_image(job, control, order);
  return order.came;
}

TEST(RenderImage, TilesComeLineByLine) {
  std::vector<int> all(36);
  for (int k = 0; k < 36; ++k) all[static_cast<std::size_t>(k)] = k;
  EXPECT_EQ(order_of(1, {}), all);
  std::vector<int> came = order_of(4, {});
  std::sort(came.begin(), came.end());
  EXPECT_EQ(came, all);
}

TEST(RenderImage, WantedTilesComeInTheirOrder) {
  const std::vector<int> wanted{7, 3, 30, 4};
  EXPECT_EQ(order_of(1, wanted), wanted);
}

}  // namespace
}  // namespace ifov::test_image_renderer
