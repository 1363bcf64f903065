#include "render/image_renderer.h"

#include <algorithm>

#include "render/image_tiles.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "render/view_renderer.h"
#include "sensor/camera.h"

namespace ifov::render {

Progress render_image(const RenderJob& job, const RenderControl& control, TileSink& sink) {
  if (const sensor::ViewListCamera* const views = job.camera.view_list())
    return render_views(job, *views, control, sink);
  const ImageTiles image(job, control);
  const std::vector<sampling::PixelRect>& tiles = image.grid();
  std::int64_t pixels = 0;
  for (const int index : control.tile_order) pixels += tiles[static_cast<std::size_t>(index)].count();
  if (control.tile_order.empty())
    pixels = static_cast<std::int64_t>(job.camera.width_px()) * job.camera.height_px();
  Tally tally(pixels, control.progress);
  tally.add(image.rays_before());
  TilesInOrder in_order(control.tile_order, tiles.size());
  TileSource& source = control.source != nullptr ? *control.source : in_order;
  render_from(source, control.threads, [&](std::size_t index) {
    const sampling::TileResult result = image.render(index);
    sink.write(result);
    tally.add(result);
  });
  return tally.total();
}

std::vector<int> steering_channels_of(int channels, std::span<const int> always, int count) {
  std::vector<int> chosen(always.begin(), always.end());
  const int spread = std::min(channels, count);
  for (int k = 0; k < spread; ++k)
    chosen.push_back(static_cast<int>((static_cast<std::int64_t>(2 * k + 1) * channels) / (2 * spread)));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace ifov::render
