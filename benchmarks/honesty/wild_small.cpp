// Small things unlike what is about them, on copies, in maps and in meshes.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

/// Dark all over with something bright on it, or cool with something hot: `most`, `few`.
void contrast(WildDraft& draft, const char* most, const char* few) {
  RandomStream& random = draft.random;
  if (draft.regime == WildDraft::Light::solar) {
    draft.grey(most, random.between(0.02, 0.1));
    draft.grey(few, random.between(0.6, 0.95));
  } else {
    const double emissivity = random.between(0.9, 1.0), cool_k = random.between(275.0, 300.0);
    draft.warm(most, emissivity, cool_k);
    draft.warm(few, 1.0, random.between(400.0, 1000.0));
  }
}

}  // namespace

void make_copies(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  contrast(draft, "crown", "lamp");
  const double radius = random.magnitude(0.2, 2.0), height = radius * random.between(1.0, 3.0);
  const double ball = random.magnitude(0.02, 0.2) * std::min(1.0, radius), up = height + radius + 0.5 * ball;
  const auto m = [&](double px) { return px * draft.gsd_m; };
  draft.prototypes.push_back(format(
      R"("tree": [{{"sphere": {{"center": ["0 m", "0 m", "{} m"], "radius": "{} m"}}, "material": "crown"}},
        {{"sphere": {{"center": ["0 m", "0 m", "{} m"], "radius": "{} m"}}, "material": "lamp"}}])",
      m(height), m(radius), m(up), m(ball)));
  const bool grouped = random.with(0.3);
  const double aside = 2.5 * radius;
  if (grouped)
    draft.prototypes.push_back(format(
        R"("group": [{{"instance": {{"of": "tree"}}}}, {{"instance": {{"of": "tree"}}, "transform": {{"translate": ["{} m", "0 m", "0 m"]}}}}])",
        m(aside)));
  // In rows as in an orchard, or anywhere.
  const bool rows = random.with(0.5);
  const double pitch = draft.in_step(random.magnitude(std::max(1.0, 5.2 * radius), 12.0));
  const int each_side = std::min(3, static_cast<int>(12.0 / pitch)), count = 2 * each_side + 1;
  const double x = random.uniform(), y = random.uniform();
  std::string at;
  for (int j = -each_side; j <= each_side; ++j)
    for (int i = -each_side; i <= each_side; ++i) {
      const double px = rows ? x + i * pitch : random.between(-0.5, 0.5) * pitch * count,
                   py = rows ? y + j * pitch : random.between(-0.5, 0.5) * pitch * count;
      at += (at.empty() ? "" : ", ") + draft.point(px, py, 0.0);
      for (int k = 0; k <= (grouped ? 1 : 0); ++k) {
        const PlainHints::Ball lamp{draft.place(px + k * aside, py, up), m(ball)};
        if (draft.regime == WildDraft::Light::solar)
          draft.hints.bright.push_back(lamp);
        else
          draft.hints.lamps.push_back(lamp);
      }
    }
  draft.objects.push_back(
      format(R"({{"instances": {{"of": "{}", "at": [{}]}}}})", grouped ? "group" : "tree", at));
}

void make_holes(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  const int cells = random.one_of({4, 16, 64});
  const double cell = random.one_of({random.magnitude(0.05, 1.0), draft.in_step(random.magnitude(0.2, 2.0))});
  const double share = random.one_of({random.magnitude(0.002, 0.1), random.between(0.1, 0.9)}),
               height = random.magnitude(0.2, 6.0), start = random.between(-4.0, 0.0);
  std::vector<float> values;
  for (int k = 0; k < cells * cells; ++k) values.push_back(random.uniform() < share ? 0.0f : 1.0f);
  draft.raster(draft.name + ".img", cells, cells, values);
  const math::Point3 corner = draft.place(start, start, 0.0);
  const double side = cell * cells * draft.gsd_m;
  const std::string opacity = format(
      R"("opacity": {{"file": "{}.img", "low_left": ["{} m", "{} m"], "size": ["{} m", "{} m"], "tiling": "{}", "cutoff": 0.5}})",
      draft.name, corner.x, corner.y, side, side, random.one_of({"repeat", "edge"}));
  const double reflectance = random.between(0.02, 0.7), emissivity = random.between(0.8, 1.0),
               plate_k = random.between(270.0, 330.0);
  draft.material("plate", draft.regime == WildDraft::Light::solar
                              ? format(R"("reflectance": {:.3f}, {})", reflectance, opacity)
                              : format(R"("emissivity": {:.3f}, "temperature": "{:.1f} K", {})", emissivity,
                                       plate_k, opacity));
  const double half = random.one_of({kReach_px, random.between(2.0, 8.0)});
  draft.polygon({{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}},
                "plate");
}

void make_hot_cells(WildDraft& draft) {
  RandomStream& random = draft.random;
  const int cells = random.one_of({16, 48, 100});
  const double cell = random.one_of({random.magnitude(0.02, 1.0), draft.in_step(random.magnitude(0.1, 2.0))});
  const double low = random.between(-6.0, 2.0) - 0.3 * cell * cells;
  const int hot = random.one_of({1, 3, 12});
  const double cool_k = random.between(275.0, 300.0), spread_k = random.one_of({0.0, 0.5, 10.0});
  std::vector<float> values;
  for (int k = 0; k < cells * cells; ++k)
    values.push_back(static_cast<float>(cool_k + spread_k * random.uniform()));
  for (int k = 0; k < hot; ++k) {
    const std::size_t i = random.index(static_cast<std::size_t>(cells)),
                      j = random.index(static_cast<std::size_t>(cells));
    values[j * static_cast<std::size_t>(cells) + i] = static_cast<float>(random.between(400.0, 1000.0));
    const double x = low + (static_cast<double>(i) + 0.5) * cell,
                 y = low + (cells - 0.5 - static_cast<double>(j)) * cell;
    draft.hints.bright.push_back({draft.place(x, y, 0.0), 1.05 * cell * draft.gsd_m});
  }
  draft.raster(draft.name + ".img", cells, cells, values);
  const math::Point3 corner = draft.place(low, low, 0.0);
  const double side = cell * cells * draft.gsd_m;
  draft.material(
      "ground",
      format(
          R"("emissivity": {:.3f}, "temperature": {{"map": {{"file": "{}.img", "low_left": ["{} m", "{} m"], "size": ["{} m", "{} m"], "unit": "K"}}}})",
          random.between(0.8, 1.0), draft.name, corner.x, corner.y, side, side));
  draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
}

void make_faces(WildDraft& draft) {
  RandomStream& random = draft.random;
  contrast(draft, "most", "few");
  const int cells = random.one_of({10, 40, 120});
  const double width = 2.0 * kReach_px / cells, share = random.magnitude(1e-4, 0.02);
  // Hot faces that shone on others would be noise to a tracer that does not seek them.
  const double rough = draft.regime == WildDraft::Light::solar ? random.between(0.0, 0.4) * width : 0.0;
  const auto corners = static_cast<std::size_t>(cells + 1);
  std::string mesh;
  std::vector<math::Point3> points;
  for (std::size_t j = 0; j < corners; ++j)
    for (std::size_t i = 0; i < corners; ++i) {
      const double x = static_cast<double>(i) + random.between(-0.3, 0.3),
                   y = static_cast<double>(j) + random.between(-0.3, 0.3), z = rough * random.uniform();
      const math::Point3 p = draft.place(-kReach_px + x * width, -kReach_px + y * width, z);
      points.push_back(p);
      mesh += format("v {} {} {}\n", p.x, p.y, p.z);
    }
  std::string faces[2] = {"usemtl most\n", "usemtl few\n"};
  for (std::size_t j = 0; j + 1 < corners; ++j)
    for (std::size_t i = 0; i + 1 < corners; ++i) {
      const std::size_t a = j * corners + i, b = a + 1, c = a + corners + 1, d = a + corners;
      for (const auto& [second, third] : {std::pair{b, c}, std::pair{c, d}}) {
        const bool odd = random.with(share);
        faces[odd] += format("f {} {} {}\n", a + 1, second + 1, third + 1);
        if (!odd) continue;
        const math::Point3 middle =
            points[a] + (1.0 / 3.0) * ((points[second] - points[a]) + (points[third] - points[a]));
        double radius_m = 0.0;
        for (const std::size_t k : {a, second, third})
          radius_m = std::max(radius_m, length(points[k] - middle));
        draft.hints.bright.push_back({middle, radius_m});
      }
    }
  std::ofstream file(draft.folder / (draft.name + ".obj"));
  file << mesh << faces[0] << faces[1];
  if (!file.flush())
    throw std::runtime_error("cannot write " + (draft.folder / (draft.name + ".obj")).string());
  draft.objects.push_back(
      format(R"({{"mesh": {{"file": "{}.obj"}}, "material": {{"slots": {{"most": "most", "few": "few"}}}}}})",
             draft.name));
}

}  // namespace ifov::benchmarks
