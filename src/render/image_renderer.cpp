#include "render/image_renderer.h"

#include <algorithm>

#include "render/picture.h"
#include "render/scan_renderer.h"
#include "render/tile_grid.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "render/view_renderer.h"
#include "sensor/camera.h"

namespace ifov::render {

Progress render_image(const RenderJob& job, const RenderControl& control, TileSink& sink) {
  if (const sensor::ViewListCamera* const views = job.camera.view_list())
    return render_views(job, *views, control, sink);
  if (const sensor::PictureStack* const pictures = job.camera.pictures())
    return render_scans(job, *pictures, control, sink);
  const int width = job.camera.width_px(), height = job.camera.height_px();
  const std::vector<sampling::PixelRect> tiles = tile_grid(width, height, job.tile_px);
  const Picture picture(job, control);
  Tally tally(pixels_of(control.tile_order, tiles), control.progress);
  tally.add(picture.rays());
  const auto render_tile = [&](std::size_t index) {
    const sampling::TileResult result = picture.tile(tiles[index], index);
    sink.write(result);
    tally.add(result);
  };
  TilesInOrder in_order(control.tile_order, tiles.size());
  TileSource& source = control.source != nullptr ? *control.source : in_order;
  render_from(source, control.threads, render_tile);
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
