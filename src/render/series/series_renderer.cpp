#include "render/series/series_renderer.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "geometry/world.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/picture.h"
#include "render/series/shared_paths.h"
#include "render/series/temperatures_by_time.h"
#include "render/tile_grid.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

bool wants(const ImageOfTime& image, std::size_t tile) { return !image.wanted.empty() && image.wanted[tile]; }

}  // namespace

std::string cannot_share_paths(std::span<const RenderJob* const> by_time) {
  const RenderJob& first = *by_time.front();
  if (first.camera.view_list() != nullptr) return "their rays are a list";
  if (first.camera.pictures() != nullptr) return "they are made of pictures, sweeps or rows";
  if (first.camera.moves_while_exposed()) return "the camera moves while they are exposed";
  if (first.image_wide) return "the accuracy is that of the image as a whole";
  if (first.polarimetry != nullptr || first.parts || first.emissivity) return "more than radiance is told";
  if (!first.scene.scene().mirror_assignments().empty()) return "there are mirrors or panes";
  if (const auto& world = first.scene.scene().world; world != nullptr && world->moving() != nullptr)
    return "something moves";
  for (const RenderJob* job : by_time) {
    if (job->scene.scene().sun) return "the Sun lights the image";
    if (job->scene.scene().world != first.scene.scene().world) return "the scene is not the same";
  }
  return "";
}

std::vector<double> render_times(std::span<const ImageOfTime> images,
                                 const scene::TemperaturesOfTimes& temperatures, const RenderControl& control,
                                 std::size_t most_bytes) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const RenderJob& first = images.front().job;
  const std::vector<sampling::PixelRect> grid =
      tile_grid(first.camera.width_px(), first.camera.height_px(), first.tile_px);
  std::vector<std::unique_ptr<Picture>> pictures;
  std::vector<std::unique_ptr<Tally>> tallies;
  std::vector<double> seconds(images.size(), 0.0);
  for (std::size_t t = 0; t < images.size(); ++t) {
    pictures.push_back(images[t].wanted.empty() && t > 0 ? nullptr
                                                         : std::make_unique<Picture>(images[t].job, control));
    tallies.push_back(nullptr);
    if (images[t].wanted.empty()) continue;
    std::int64_t pixels = 0;
    for (std::size_t k = 0; k < images[t].wanted.size(); ++k)
      if (images[t].wanted[k]) pixels += grid[k].count();
    tallies[t] = std::make_unique<Tally>(pixels, images[t].progress);
    tallies[t]->add(pictures[t]->rays());
  }
  std::vector<int> order;
  for (std::size_t k = 0; k < grid.size(); ++k)
    if (std::any_of(images.begin(), images.end(), [&](const ImageOfTime& image) { return wants(image, k); }))
      order.push_back(static_cast<int>(k));
  if (order.empty()) return seconds;
  TilesInOrder source(order, grid.size());
  render_from(source, control.threads, [&](std::size_t index) {
    const std::unique_ptr<SceneField> tracer = pictures.front()->tracer();
    std::vector<std::unique_ptr<SceneField>> fields(images.size());
    std::vector<SceneField*> asked(images.size(), nullptr);
    for (std::size_t t = 0; t < images.size(); ++t)
      if (wants(images[t], index)) asked[t] = (fields[t] = pictures[t]->field()).get();
    SharedPaths paths(*tracer, asked, temperatures, most_bytes);
    TemperaturesByTime middles(temperatures);
    for (std::size_t t = 0; t < images.size(); ++t) {
      if (asked[t] == nullptr) continue;
      fields[t]->share(&paths.of(t));
      sampling::TileResult result;
      {
        const TemperaturesByTime::Scope scope(middles, t);
        result = pictures[t]->tile(grid[index], index, *fields[t]);
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
