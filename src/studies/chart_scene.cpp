#include "studies/chart_scene.h"

#include <utility>

#include "core/format.h"
#include "sampling/random.h"

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

StudyDocument ChartScene::document(std::string sampling, std::uint64_t seed) const {
  StudyDocument document;
  std::string polygons;
  for (const Outline& bar : bars_) {
    std::string vertices;
    // The image's y axis points south: backwards, the corners run counter-clockwise from above. A tenth of a
    // millimetre over the paper is too little for shadows or light between them.
    for (std::size_t k = bar.size(); k-- > 0;)
      vertices += format("{}{}", point_text(bar[k].x_px, -bar[k].y_px, 1e-4), k == 0 ? "" : ", ");
    polygons += format(",\n      {{\"polygon\": {{\"vertices\": [{}]}}, \"material\": \"black\"}}", vertices);
  }
  document.materials =
      format("{{\"white\": {{\"reflectance\": {}}}, \"black\": {{\"reflectance\": {}}}}}", kWhite, kBlack);
  document.objects = format("[{{\"plane\": {{}}, \"material\": \"white\"}}{}]", polygons);
  document.light = "{\"sun\": {\"point\": {\"zenith\": \"0 deg\", \"azimuth\": \"0 deg\"}}}";
  document.camera = nadir_camera(kWidth_px, kWidth_px, 0.0, 0.0);
  document.channels = "[{\"name\": \"green\", \"monochromatic\": {\"at\": \"0.55 um\"}}]";
  document.sampling = std::move(sampling);
  // Light that comes by way of a second surface is left out, so that the answer is known exactly.
  document.sampling.insert(1, "\"max_depth\": 1, ");
  document.seed = seed;
  return document;
}

}  // namespace ifov::studies
