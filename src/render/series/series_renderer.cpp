#include "render/series/series_renderer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>

#include "geometry/world.h"
#include "radiometry/spectral_nodes.h"
#include "render/image_renderer.h"
#include "render/image_tiles.h"
#include "render/scene_field.h"
#include "render/series/shared_paths.h"
#include "render/series/temperatures_by_time.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "sampling/pixel_sampler.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

bool same_nodes(const radiometry::SpectralNodes& one, const radiometry::SpectralNodes& other) {
  if (one.node_count() != other.node_count() || one.channel_count() != other.channel_count()) return false;
  for (std::size_t n = 0; n < one.node_count(); ++n)
    if (one.node_wavelength_um(n) != other.node_wavelength_um(n) ||
        one.node_weight(n) != other.node_weight(n))
      return false;
  return true;
}

}  // namespace

std::string cannot_share_paths(std::span<const RenderJob* const> by_time) {
  const RenderJob& first = *by_time.front();
  if (first.camera.view_list() != nullptr) return "their rays are a list";
  if (first.sampler.takes_many_values()) return "the accuracy is that of the image as a whole";
  if (first.polarimetry != nullptr || first.parts) return "more than radiance is told";
  if (!first.scene.scene().mirror_assignments().empty()) return "there are mirrors or panes";
  for (const RenderJob* job : by_time) {
    if (job->scene.scene().sun) return "the Sun lights the image";
    if (job->scene.scene().world != first.scene.scene().world) return "the scene is not the same";
    if (!same_nodes(job->scene.nodes(), first.scene.nodes())) return "their spectral nodes differ";
  }
  return "";
}

std::vector<double> render_times(std::span<const ImageOfTime> images,
                                 const scene::TemperaturesOfTimes& temperatures, const RenderControl& control,
                                 std::size_t most_bytes) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::unique_ptr<ImageTiles>> tiles;
  std::vector<std::unique_ptr<Tally>> tallies;
  std::vector<double> seconds(images.size(), 0.0);
  std::mutex mutex;
  for (const ImageOfTime& image : images) {
    const auto begin = Clock::now();
    tiles.push_back(std::make_unique<ImageTiles>(image.job, control));
    seconds[tiles.size() - 1] += std::chrono::duration<double>(Clock::now() - begin).count();
    std::int64_t pixels = 0;
    for (std::size_t k = 0; k < image.wanted.size(); ++k)
      if (image.wanted[k]) pixels += tiles.back()->grid()[k].count();
    tallies.push_back(std::make_unique<Tally>(pixels, image.progress));
    tallies.back()->add(tiles.back()->rays_before());
  }
  std::vector<int> order;
  for (std::size_t k = 0; k < tiles.front()->grid().size(); ++k)
    if (std::any_of(images.begin(), images.end(), [&](const ImageOfTime& image) { return image.wanted[k]; }))
      order.push_back(static_cast<int>(k));
  if (order.empty()) return seconds;
  TilesInOrder source(order, tiles.front()->grid().size());
  render_from(source, control.threads, [&](std::size_t index) {
    const std::unique_ptr<SceneField> tracer = tiles.front()->field();
    std::vector<std::unique_ptr<SceneField>> fields(images.size());
    std::vector<SceneField*> asked(images.size(), nullptr);
    for (std::size_t t = 0; t < images.size(); ++t)
      if (images[t].wanted[index]) asked[t] = (fields[t] = tiles[t]->field()).get();
    SharedPaths paths(*tracer, asked, temperatures, most_bytes);
    TemperaturesByTime middles(temperatures);
    for (std::size_t t = 0; t < images.size(); ++t) {
      if (asked[t] == nullptr) continue;
      const auto begin = Clock::now();
      fields[t]->share(&paths.of(t));
      sampling::TileResult result;
      {
        const TemperaturesByTime::Scope scope(middles, t);
        result = tiles[t]->render(index, *fields[t]);
      }
      images[t].sink.write(result);
      tallies[t]->add(result);
      fields[t].reset();
      const std::scoped_lock lock(mutex);
      seconds[t] += std::chrono::duration<double>(Clock::now() - begin).count();
    }
  });
  return seconds;
}

}  // namespace ifov::render
