#pragma once

#include <cstdint>
#include <string>

#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::test {

/// The last tile of an image.
class TheTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

inline sampling::TileResult rendered_once(const std::string& document, std::uint64_t seed = 1) {
  const session::Session session =
      session::Session::load(io::parse_document(document, "polarized.json"), nullptr);
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  render::RenderControl control;
  control.threads = 1;
  TheTile tile;
  render::render_image(job, control, tile);
  return tile.result;
}

/// I, Q, U or V of a tile that has Stokes layers.
inline double stokes_of(const sampling::TileResult& tile, std::size_t pixel, int component,
                        std::size_t channel = 0) {
  const std::size_t channels = static_cast<std::size_t>(tile.columns);
  if (component == 0) return static_cast<double>(tile.mean[pixel * channels + channel]);
  return static_cast<double>(
      tile.layer(render::StokesLayers::kMean)
          ->values<float>()[(3 * pixel + static_cast<std::size_t>(component) - 1) * channels + channel]);
}

}  // namespace ifov::test
