// Ground with heights from a raster, and maps on it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

/// Sums of waves of falling height, with cliffs in some.
std::vector<float> heights(WildDraft& draft, int cells, double relief_m) {
  RandomStream& random = draft.random;
  struct Wave {
    double x, y, phase, height;
  };
  std::vector<Wave> waves;
  const double roughness = random.between(0.6, 1.4);
  for (int octave = 0; octave < 6; ++octave)
    for (int k = 0; k < 2; ++k) {
      const double turns = std::pow(2.0, octave), angle = random.between(0.0, 2.0 * std::numbers::pi);
      waves.push_back({2.0 * std::numbers::pi * turns * std::cos(angle) / cells,
                       2.0 * std::numbers::pi * turns * std::sin(angle) / cells,
                       random.between(0.0, 2.0 * std::numbers::pi), relief_m * std::pow(turns, -roughness)});
    }
  const double step = random.with(0.3) ? relief_m * random.between(0.2, 0.6) : 0.0;
  std::vector<float> values;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      double z = 0.0;
      for (const Wave& wave : waves) z += wave.height * std::sin(wave.x * i + wave.y * j + wave.phase);
      if (step > 0.0) z = step * std::round(z / step);
      values.push_back(static_cast<float>(z));
    }
  return values;
}

}  // namespace

void make_relief(WildDraft& draft) {
  RandomStream& random = draft.random;
  const int cells = random.one_of({24, 48, 96});
  const double cell_px = 2.0 * kReach_px / cells, relief_px = random.magnitude(0.1, 4.0);
  draft.raster(draft.name + "_heights.img", cells, cells, heights(draft, cells, relief_px * draft.gsd_m));
  const auto place = [&](double low_px, double side_px) {
    const math::Point3 corner = draft.place(low_px, low_px, 0.0);
    const double side_m = side_px * draft.gsd_m;
    return format(R"("low_left": ["{} m", "{} m"], "size": ["{} m", "{} m"])", corner.x, corner.y, side_m,
                  side_m);
  };
  const std::string terrain =
      format(R"("terrain": {{"file": "{}_heights.img", {}, "smooth": false, "form": "{}"}})", draft.name,
             place(-kReach_px, cell_px * cells), random.one_of({"mesh", "grid"}));
  const int parts = random.one_of({8, 32, 128});
  const double part_px = random.one_of({2.0 * kReach_px / parts, draft.in_step(random.magnitude(0.1, 2.0))});
  const double share = random.one_of({random.magnitude(0.005, 0.1), random.between(0.1, 0.9)});
  std::vector<float> map;
  const std::string where = place(random.between(-6.0, 0.0) - 0.3 * part_px * parts, part_px * parts);
  if (draft.regime == WildDraft::Light::solar) {
    for (int k = 0; k < parts * parts; ++k) map.push_back(random.uniform() < share ? 1.0f : 0.0f);
    draft.surface("zero");
    draft.surface("one");
    draft.objects.push_back(format(
        R"({{{}, "material": {{"map": {{"file": "{}.img", {}, "classes": {{"0": "zero", "1": "one"}}}}}}}})",
        terrain, draft.name, where));
  } else {
    const double cool_k = random.between(275.0, 300.0), spread_k = random.one_of({0.5, 10.0, 40.0});
    for (int k = 0; k < parts * parts; ++k)
      map.push_back(static_cast<float>(cool_k + spread_k * random.uniform()));
    draft.material(
        "ground",
        format(R"("emissivity": {:.3f}, "temperature": {{"map": {{"file": "{}.img", {}, "unit": "K"}}}})",
               random.between(0.8, 1.0), draft.name, where));
    draft.objects.push_back(format(R"({{{}, "material": "ground"}})", terrain));
  }
  draft.raster(draft.name + ".img", parts, parts, map);
  if (random.with(0.4)) {
    draft.surface("house");
    for (int k = 0; k < 3; ++k) {
      const double x = random.between(-6.0, 5.0), y = random.between(-6.0, 5.0);
      draft.box({x, y, -3.0 * relief_px},
                {x + random.magnitude(0.3, 3.0), y + random.magnitude(0.3, 3.0), 2.0 * relief_px}, "house");
    }
  }
}

}  // namespace ifov::benchmarks
