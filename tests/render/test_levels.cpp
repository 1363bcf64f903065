#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

#include "materials/bsdf/mirror.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/tile_grid.h"
#include "render/tile_sink.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "sampling/hash.h"
#include "sampling/image/audited_sampler.h"
#include "sampling/image/image_sampler.h"
#include "sampling/image/levels.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_levels {
namespace {

/// Ground with a wall on it, one of them a mirror, under a Sun, warm things and a sky.
struct Yard {
  test::SmallScene scene;
  sensor::OrthographicCamera::Settings settings;

  Yard() {
    scene.place(geometry::Plane{}, scene.material(0.3, 300.0));
    scene.place(geometry::Polygon{{{0.0, -90.0, 0.0}, {0.0, 90.0, 0.0}, {0.0, 90.0, 4.0}, {0.0, -90.0, 4.0}}},
                scene.material(0.6));
    scene.place(geometry::Polygon{{{-3.0, -9.0, 0.5}, {-1.0, -9.0, 0.5}, {-1.0, 9.0, 0.5}, {-3.0, 9.0, 0.5}}},
                scene.material(0.8, 0.0, materials::Mirror::shared()));
    scene.sun({1.0, 0.3, 2.0}, 1000.0, 0.00465);
    settings.width_px = settings.height_px = 12;
    settings.start_height_m = 100.0;
  }
};

constexpr std::uint32_t kGroup = 16;

std::vector<sampling::PathRequest> requests_of(int pixels) {
  std::vector<sampling::PathRequest> requests;
  for (int p = 0; p < pixels; ++p)
    for (std::uint32_t k = 0; k < kGroup; ++k)
      requests.push_back({{12.0 * sampling::unit_double(sampling::hash(p, k, 1)),
                           12.0 * sampling::unit_double(sampling::hash(p, k, 2))},
                          sampling::hash(p, 3),
                          k});
  return requests;
}

// Both levels of a path make its value, and the first is what it is when the path is not followed.
TEST(Levels, AddUpToValues) {
  Yard yard;
  const sensor::OrthographicCamera camera(yard.settings);
  const transport::SpectralScene& scene = yard.scene.build();
  render::SceneField field(scene, camera, {}, render::LabelDetail::material);
  constexpr int kPixels = 60;
  const std::vector<sampling::PathRequest> requests = requests_of(kPixels);
  const auto stride = static_cast<std::size_t>(field.stride()),
             columns = static_cast<std::size_t>(field.columns());
  std::vector<sampling::Label> labels(requests.size());
  std::vector<float> values(requests.size() * stride);
  field.values(requests, labels, values);

  const std::vector<std::uint32_t> counts(kPixels, kGroup);
  const std::vector<std::uint8_t> all(requests.size(), 1), none(requests.size(), 0);
  std::vector<std::uint8_t> some;
  for (std::size_t k = 0; k < requests.size(); ++k) some.push_back(sampling::hash(k) % 3 == 0);
  sampling::LevelSums whole, direct, partly;
  field.levels({requests, all, counts}, whole);
  field.levels({requests, none, counts}, direct);
  field.levels({requests, some, counts}, partly);
  double rest = 0.0;
  for (std::size_t p = 0; p < kPixels; ++p)
    for (std::size_t c = 0; c < columns; ++c) {
      double mean = 0.0;
      for (std::size_t k = 0; k < kGroup; ++k)
        mean += static_cast<double>(values[(p * kGroup + k) * stride + c]) / kGroup;
      const std::size_t at = p * stride + c;
      const double sum = static_cast<double>(whole.direct[at]) + static_cast<double>(whole.rest[at]);
      EXPECT_NEAR(sum, mean, 1e-5 * std::abs(mean) + 1e-7);
      EXPECT_EQ(direct.direct[at], whole.direct[at]);
      EXPECT_EQ(direct.direct_variance[at], whole.direct_variance[at]);
      EXPECT_EQ(partly.direct[at], whole.direct[at]);
      EXPECT_EQ(direct.rest[at], 0.0f);
      rest += static_cast<double>(whole.rest[at]);
    }
  EXPECT_GT(rest, 0.0);
  for (std::size_t k = 0; k < requests.size(); ++k)
    EXPECT_EQ(field.material_of(whole.labels[k]), field.material_of(labels[k]));
  EXPECT_EQ(partly.labels, whole.labels);
}

// Fewer rays are sent where paths are not followed.
TEST(Levels, FollowOnlyWhatIsWanted) {
  Yard yard;
  const sensor::OrthographicCamera camera(yard.settings);
  const transport::SpectralScene& scene = yard.scene.build();
  const std::vector<sampling::PathRequest> requests = requests_of(20);
  const std::vector<std::uint32_t> counts(20, kGroup);
  const std::vector<std::uint8_t> all(requests.size(), 1), none(requests.size(), 0);
  sampling::LevelSums sums;
  render::SceneField first(scene, camera, {}, render::LabelDetail::material);
  first.levels({requests, none, counts}, sums);
  EXPECT_EQ(first.counts().continuation, 0u);
  render::SceneField second(scene, camera, {}, render::LabelDetail::material);
  second.levels({requests, all, counts}, sums);
  EXPECT_GT(second.counts().continuation, requests.size() / 2);
}

// Variances of channels of several nodes, and of both levels, against those of the values themselves.
TEST(Levels, TellVariances) {
  sampling::LevelAccumulator group(2);
  const float rows[8][2] = {{1, 2}, {3, 2}, {2, 2}, {4, 2}, {0, 5}, {0, 6}, {0, 7}, {4, 9}};
  for (const auto& row : rows) group.add_direct(row), group.add_rest(row);
  float direct[2], direct_variance[2], rest[2], rest_variance[2];
  group.take(direct, direct_variance, rest, rest_variance);
  EXPECT_FLOAT_EQ(direct[0], 14.0f / 8);
  EXPECT_FLOAT_EQ(rest[1], 35.0f / 8);
  // Contrasts a - b - c + d: 0 and 4 in one column, 0 and 1 in the other; a quarter of their mean square.
  EXPECT_FLOAT_EQ(direct_variance[0], 0.25f * 16.0f / 2.0f);
  EXPECT_FLOAT_EQ(direct_variance[1], 0.25f * 1.0f / 2.0f);
  EXPECT_FLOAT_EQ(rest_variance[0], (46.0f - 14.0f * 14.0f / 8) / 7);
}

/// Puts tiles together.
struct Whole final : render::TileSink {
  Whole(int side_px, int columns)
      : side(side_px), mean(static_cast<std::size_t>(side * side * columns)), half_width(mean.size()) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const std::scoped_lock lock(mutex);
    const auto columns = static_cast<std::size_t>(tile.columns);
    std::size_t from = 0;
    for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
      for (int x = tile.tile.x0; x < tile.tile.x1; ++x)
        for (std::size_t c = 0; c < columns; ++c, ++from) {
          mean[static_cast<std::size_t>(y * side + x) * columns + c] = tile.mean[from];
          half_width[static_cast<std::size_t>(y * side + x) * columns + c] = tile.half_width[from];
        }
    converged += tile.converged_count();
    for (const sampling::ColumnError& error : tile.column_errors)
      limits += error.limit > 0.0f && error.audited > 0.0f;
  }
  int side;
  std::vector<float> mean, half_width;
  std::int64_t converged = 0, limits = 0;
  std::mutex mutex;
};

// Every tile finds the same of the image, whichever process asks, so that no byte depends on tiles, their order or threads.
TEST(ImageWide, IsTheSameInAnyTilesThreadsAndShares) {
  Yard yard;
  const sensor::OrthographicCamera camera(yard.settings);
  const transport::SpectralScene& scene = yard.scene.build();
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const render::ChannelBrightness brightness(scene.nodes());
  render::AccuracyRequest request;
  request.unit = render::ErrorUnit::percent;
  request.error = 0.02;
  request.image_wide = true;
  const int side = yard.settings.width_px, columns = static_cast<int>(scene.nodes().channel_count());
  const render::AccuracyTolerance tolerance(request, brightness, scene.white_reflected(), side * side);
  const sampling::AuditedSampler sampler(std::make_unique<sampling::ImageSampler>(4096), 30);
  render::RenderJob job{scene, camera, footprint, sampler};
  job.tolerance = &tolerance;
  job.image_wide = true;
  job.label_detail = render::LabelDetail::material;
  job.pilot_rays = false;
  const auto rendered = [&](int tile_px, int threads, bool in_two_shares) {
    job.tile_px = tile_px;
    auto whole = std::make_unique<Whole>(side, columns);
    std::vector<int> odd, even;
    for (int k = 0; k < static_cast<int>(render::tile_grid(side, side, tile_px).size()); ++k)
      (k % 2 == 0 ? even : odd).push_back(k);
    render::RenderControl control;
    control.threads = threads;
    if (!in_two_shares) {
      render::render_image(job, control, *whole);
      return whole;
    }
    for (const std::vector<int>& share : {odd, even}) {
      control.tile_order = share;
      render::render_image(job, control, *whole);
    }
    return whole;
  };
  const auto first = rendered(12, 1, false);
  EXPECT_EQ(first->converged, side * side);
  EXPECT_EQ(first->limits, columns);
  for (const auto& other : {rendered(4, 2, false), rendered(5, 1, true)}) {
    EXPECT_EQ(other->mean, first->mean);
    EXPECT_EQ(other->half_width, first->half_width);
  }
}

}  // namespace
}  // namespace ifov::test_levels
