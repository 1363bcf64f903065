#include "honesty/single_tile.h"

#include <stdexcept>

#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"

namespace ifov::benchmarks {

namespace {

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    if (result.tile.count() > 0) throw std::runtime_error("an image of more than one tile");
    result = tile;
  }
  sampling::TileResult result;
};

}  // namespace

session::Session load_text(const std::string& text, const std::filesystem::path& file) {
  return session::Session::load(io::parse_document(text, file.string()), nullptr);
}

sampling::TileResult render_tile(const render::RenderJob& job) {
  render::RenderControl control;
  control.threads = 1;
  OneTile tile;
  render::render_image(job, control, tile);
  return tile.result;
}

sampling::TileResult render_tile(const session::Session& session, std::uint64_t seed) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  return render_tile(job);
}

}  // namespace ifov::benchmarks
