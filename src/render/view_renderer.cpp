#include "render/view_renderer.h"

#include <optional>

#include "core/error.h"
#include "render/field/seen_through.h"
#include "render/image_renderer.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "render/views/point_irradiance.h"
#include "sampling/hash.h"
#include "sampling/tile.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"

namespace ifov::render {
namespace {

/// The same job of one view.
RenderJob job_of(const RenderJob& job, const sensor::SingleView& view, std::size_t number) {
  RenderJob one{job.scene, view, job.footprint, job.sampler};
  one.tolerance = job.tolerance;
  one.transport = job.transport;
  one.label_detail = job.label_detail;
  one.seed = sampling::hash(job.seed, number);
  one.tile_px = 1;
  one.pilot_rays = job.pilot_rays;
  one.steering_channels = job.steering_channels;
  one.air = job.air;
  one.nodes = job.nodes;
  one.keep_memory = job.keep_memory;
  one.keep_variances = job.keep_variances;
  one.collectors = job.collectors;
  one.emissivity = job.emissivity;
  one.thermal_errors = job.thermal_errors;
  one.parts = job.parts;
  return one;
}

/// The view's tile of an earlier run, in its own place.
class EarlierView final : public EarlierTiles {
 public:
  EarlierView(EarlierTiles& all, std::size_t number) : all_(all), number_(number) {}
  bool read(std::size_t, sampling::TileResult& tile) override {
    if (!all_.read(number_, tile)) return false;
    tile.tile = {0, 0, 1, 1};
    return true;
  }

 private:
  EarlierTiles& all_;
  std::size_t number_;
};

/// Takes the one tile of a view.
struct OneTile final : TileSink {
  void begin(const ImageInfo&) override {}
  void write(const sampling::TileResult& finished) override { tile = finished; }
  sampling::TileResult tile;
};

}  // namespace

Progress render_views(const RenderJob& job, const sensor::ViewListCamera& views, const RenderControl& control,
                      TileSink& sink) {
  const bool points = views.list()->kind == sensor::ViewList::Kind::points;
  const auto count = static_cast<std::size_t>(views.width_px());
  Tally tally(static_cast<std::int64_t>(control.tile_order.empty() ? count : control.tile_order.size()),
              control.progress);
  TilesInOrder in_order(control.tile_order, count);
  TileSource& source = control.source != nullptr ? *control.source : in_order;
  render_from(source, control.threads, [&](std::size_t k) {
    if (control.cancel != nullptr && control.cancel->cancelled()) throw Cancelled();
    RenderJob one = job_of(job, views.view(k), k);
    one.transport.sun_apart = points;  // to_irradiance adds it
    std::optional<EarlierView> earlier;
    if (job.earlier != nullptr) one.earlier = &earlier.emplace(*job.earlier, k);
    OneTile result;
    RenderControl alone;
    alone.threads = 1;
    alone.cancel = control.cancel;
    render_image(one, alone, result);
    if (points) {
      SeenThrough through(job.scene);
      ThroughPanes through_panes;
      if (through.any())
        through_panes = [&](const math::Ray& ray, sampling::RayCounts& counts) {
          return through.passed(ray, counts) != 0;
        };
      to_irradiance(job.scene, views.view(k), job.tolerance, through_panes, one.seed, result.tile);
    }
    const int column = static_cast<int>(k);
    result.tile.tile = {column, 0, column + 1, 1};
    sink.write(result.tile);
    tally.add(result.tile);
  });
  return tally.total();
}

}  // namespace ifov::render
