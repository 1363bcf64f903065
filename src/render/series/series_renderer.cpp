#include "render/series/series_renderer.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "render/image_renderer.h"
#include "render/image_tiles.h"
#include "render/scene_field.h"
#include "render/series/shared_paths.h"
#include "render/series/temperatures_by_time.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"

namespace ifov::render {
namespace {

bool wants(const ImageOfTime& image, std::size_t tile) { return !image.wanted.empty() && image.wanted[tile]; }

}  // namespace

std::vector<double> render_times(std::span<const ImageOfTime> images,
                                 const scene::TemperaturesOfTimes& temperatures, const RenderControl& control,
                                 std::size_t most_bytes) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::vector<std::unique_ptr<ImageTiles>> tiles;
  std::vector<std::unique_ptr<Tally>> tallies;
  std::vector<double> seconds(images.size(), 0.0);
  for (std::size_t t = 0; t < images.size(); ++t) {
    tiles.push_back(images[t].wanted.empty() && t > 0 ? nullptr
                                                      : std::make_unique<ImageTiles>(images[t].job, control));
    tallies.push_back(nullptr);
    if (images[t].wanted.empty()) continue;
    std::int64_t pixels = 0;
    for (std::size_t k = 0; k < images[t].wanted.size(); ++k)
      if (images[t].wanted[k]) pixels += tiles[t]->grid()[k].count();
    tallies[t] = std::make_unique<Tally>(pixels, images[t].progress);
    tallies[t]->add(tiles[t]->rays_before());
  }
  std::vector<int> order;
  for (std::size_t k = 0; k < tiles.front()->grid().size(); ++k)
    if (std::any_of(images.begin(), images.end(), [&](const ImageOfTime& image) { return wants(image, k); }))
      order.push_back(static_cast<int>(k));
  if (order.empty()) return seconds;
  TilesInOrder source(order, tiles.front()->grid().size());
  render_from(source, control.threads, [&](std::size_t index) {
    const std::unique_ptr<SceneField> tracer = tiles.front()->tracer();
    std::vector<std::unique_ptr<SceneField>> fields(images.size());
    std::vector<SceneField*> asked(images.size(), nullptr);
    for (std::size_t t = 0; t < images.size(); ++t)
      if (wants(images[t], index)) asked[t] = (fields[t] = tiles[t]->field()).get();
    SharedPaths paths(*tracer, asked, temperatures, most_bytes);
    TemperaturesByTime middles(temperatures);
    for (std::size_t t = 0; t < images.size(); ++t) {
      if (asked[t] == nullptr) continue;
      fields[t]->share(&paths.of(t));
      sampling::TileResult result;
      {
        const TemperaturesByTime::Scope scope(middles, t);
        result = tiles[t]->render(index, *fields[t]);
      }
      images[t].sink->write(result);
      tallies[t]->add(result);
      fields[t].reset();
    }
  });
  // Who asks first finds the paths for all: the time goes to all alike.
  const double all_s = std::chrono::duration<double>(Clock::now() - start).count();
  const auto made =
      std::count_if(tallies.begin(), tallies.end(), [](const auto& tally) { return tally != nullptr; });
  for (std::size_t t = 0; t < images.size(); ++t)
    seconds[t] = tallies[t] != nullptr ? all_s / static_cast<double>(made) : 0.0;
  return seconds;
}

}  // namespace ifov::render
