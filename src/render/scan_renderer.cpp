#include "render/scan_renderer.h"

#include <memory>
#include <mutex>
#include <vector>

#include "render/image_renderer.h"
#include "render/picture.h"
#include "render/tile_grid.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "sampling/hash.h"
#include "sensor/camera.h"
#include "sensor/flying/picture_stack.h"

namespace ifov::render {
namespace {

/// Tiles of an earlier run, as they lie in their sweep.
class EarlierSweep final : public EarlierTiles {
 public:
  EarlierSweep(EarlierTiles& all, int first_line) : all_(all), first_line_(first_line) {}
  bool read(std::size_t number, sampling::TileResult& tile) override {
    if (!all_.read(number, tile)) return false;
    tile.tile.y0 -= first_line_, tile.tile.y1 -= first_line_;
    return true;
  }

 private:
  EarlierTiles& all_;
  int first_line_;
};

/// A sweep's picture with all that it refers to.
class Sweep {
 public:
  Sweep(const RenderJob& all, const sensor::PictureStack& pictures, int number, const RenderControl& control)
      : camera_(pictures.picture(number)),
        first_line_(number * pictures.lines_of_each()),
        job_(of_camera(all, *camera_)) {
    job_.seed = sampling::hash(all.seed, static_cast<std::uint64_t>(number));
    if (all.earlier != nullptr)
      job_.earlier = (earlier_ = std::make_unique<EarlierSweep>(*all.earlier, first_line_)).get();
    RenderControl alone;
    alone.threads = 1;  // others render tiles of other sweeps
    alone.cancel = control.cancel;
    picture_ = std::make_unique<const Picture>(job_, alone);
  }

  sampling::TileResult tile(sampling::PixelRect tile, std::size_t index) const {
    tile.y0 -= first_line_, tile.y1 -= first_line_;
    sampling::TileResult result = picture_->tile(tile, index);
    result.tile.y0 += first_line_, result.tile.y1 += first_line_;
    return result;
  }
  const sampling::RayCounts& rays() const { return picture_->rays(); }

 private:
  static RenderJob of_camera(const RenderJob& all, const sensor::Camera& camera) {
    RenderJob one{all.scene, camera, all.footprint, all.sampler};
    one.tolerance = all.tolerance;
    one.transport = all.transport;
    one.label_detail = all.label_detail;
    one.tile_px = all.tile_px;
    one.pilot_rays = all.pilot_rays;
    one.steering_channels = all.steering_channels;
    one.air = all.air;
    one.nodes = all.nodes;
    one.groups = all.groups;
    one.wings = all.wings;
    one.cut = all.cut;
    one.outshining = all.outshining;
    one.image_wide = all.image_wide;
    one.keep_memory = all.keep_memory;
    one.keep_variances = all.keep_variances;
    one.collectors = all.collectors;
    one.polarimetry = all.polarimetry;
    one.emissivity = all.emissivity;
    one.thermal_errors = all.thermal_errors;
    one.parts = all.parts;
    one.responses = all.responses;
    return one;
  }

  std::unique_ptr<const sensor::Camera> camera_;
  int first_line_;
  RenderJob job_;
  std::unique_ptr<EarlierSweep> earlier_;
  std::unique_ptr<const Picture> picture_;
};

/// The sweeps whose tiles are being rendered, each made once by the first thread that asks while others wait for it.
class Sweeps {
 public:
  Sweeps(const RenderJob& job, const sensor::PictureStack& pictures, const RenderControl& control,
         Tally& tally)
      : job_(job), pictures_(pictures), control_(control), tally_(tally) {}

  std::shared_ptr<const Sweep> get(int number) {
    std::shared_ptr<Place> place;
    {
      const std::scoped_lock lock(mutex_);
      for (const auto& kept : kept_)
        if (kept->number == number) place = kept;
      if (place == nullptr) {
        place = std::make_shared<Place>();
        place->number = number;
        kept_.push_back(place);
        if (kept_.size() > kKept) kept_.erase(kept_.begin());
      }
    }
    const std::scoped_lock lock(place->mutex);
    if (place->sweep == nullptr) {
      place->sweep = std::make_shared<const Sweep>(job_, pictures_, number, control_);
      tally_.add(place->sweep->rays());
    }
    return place->sweep;
  }

 private:
  static constexpr std::size_t kKept = 64;
  struct Place {
    int number = 0;
    std::mutex mutex;
    std::shared_ptr<const Sweep> sweep;
  };
  const RenderJob& job_;
  const sensor::PictureStack& pictures_;
  const RenderControl& control_;
  Tally& tally_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<Place>> kept_;
};

}  // namespace

Progress render_scans(const RenderJob& job, const sensor::PictureStack& pictures,
                      const RenderControl& control, TileSink& sink) {
  const int lines = pictures.lines_of_each();
  const std::vector<sampling::PixelRect> tiles =
      tile_grid(job.camera.width_px(), job.camera.height_px(), job.tile_px, lines);
  Tally tally(pixels_of(control.tile_order, tiles), control.progress);
  Sweeps sweeps(job, pictures, control, tally);
  TilesInOrder in_order(control.tile_order, tiles.size());
  TileSource& source = control.source != nullptr ? *control.source : in_order;
  render_from(source, control.threads, [&](std::size_t index) {
    const sampling::TileResult result = sweeps.get(tiles[index].y0 / lines)->tile(tiles[index], index);
    sink.write(result);
    tally.add(result);
  });
  return tally.total();
}

}  // namespace ifov::render
