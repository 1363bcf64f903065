#include "studies/chart_scene.h"

#include <utility>

#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "sampling/random.h"
#include "studies/common/study_document.h"

namespace ifov::studies {

namespace {

constexpr int kFirstGroup = -2, kLastGroup = 3;
constexpr double kPxPerMm = 1.3;
constexpr std::uint64_t kShift = 0x7368696674ull;

}  // namespace

ChartScene::ChartScene(double angle_rad, std::uint64_t seed) {
  ChartPlacement placement;
  placement.centre_x_px = 0.5 * kWidth_px + sampling::unit_double(sampling::hash(seed, kShift, 0)) - 0.5;
  placement.centre_y_px = 0.5 * kWidth_px + sampling::unit_double(sampling::hash(seed, kShift, 1)) - 0.5;
  placement.px_per_mm = kPxPerMm;
  placement.angle_rad = angle_rad;
  bars_ = chart_bars(kFirstGroup, kLastGroup, placement);
  black_ = covered_fraction(bars_, kWidth_px, kWidth_px);
}

io::Document ChartScene::document(io::SamplingDocument sampling, std::uint64_t seed) const {
  // Light that comes by way of a second surface is left out, so that the answer is known exactly.
  sampling.max_depth = 1;
  io::Document document =
      nadir_document(nadir_camera(kWidth_px, kWidth_px, 0.0, 0.0), "green", 0.55, std::move(sampling), seed);
  document.scene.materials = {grey("white", kWhite), grey("black", kBlack)};
  document.scene.objects.push_back(object_of(io::PlanePrimitive(), "white"));
  for (const Outline& bar : bars_) {
    io::PolygonPrimitive polygon;
    // The image's y axis points south: backwards, the corners run counter-clockwise from above. A tenth of a
    // millimetre over the paper is too little for shadows or light between them.
    for (std::size_t k = bar.size(); k-- > 0;)
      polygon.vertices_m.push_back({bar[k].x_px, -bar[k].y_px, 1e-4});
    document.scene.objects.push_back(object_of(std::move(polygon), "black"));
  }
  document.light.sun.emplace().direction.emplace();
  return document;
}

}  // namespace ifov::studies
