// Gaps, walls, wires, panels: structure finer than a pixel, in step with it or nearly.
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

/// Along the axis across what repeats, and along it, turned to east and north by chance.
struct Axes {
  bool east;
  std::array<double, 3> at(double across, double along, double up) const {
    return east ? std::array<double, 3>{across, along, up} : std::array<double, 3>{along, across, up};
  }
};

/// Where something may begin: at a border of pixels, at a third of one, or anywhere.
double beginning(WildDraft& draft) {
  return draft.random.one_of({0.0, 1.0 / 3.0, 0.5, draft.random.uniform(), draft.random.uniform()});
}

}  // namespace

void make_gaps(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("roof");
  const Axes axes{random.with(0.5)};
  const double gap = random.magnitude(0.03, 0.6), height = random.magnitude(0.05, 5.0);
  const bool alley = random.with(0.3);
  const double width =
      alley ? 12.0
            : std::max(0.2, draft.in_step(random.magnitude(0.5, 6.0)) - (random.with(0.5) ? gap : 0.0));
  const int each_side = alley ? 1 : static_cast<int>(std::min(30.0, kReach_px / (width + gap)));
  const double start = beginning(draft);
  for (int k = -each_side; k < each_side; ++k) {
    const double low = start + k * (width + gap);
    const std::array<double, 3> a = axes.at(low, -kReach_px, 0.0),
                                b = axes.at(low + width, kReach_px, height);
    draft.box({a[0], a[1], a[2]}, {b[0], b[1], b[2]}, "roof");
  }
}

void make_walls(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("wall");
  const Axes axes{random.with(0.5)};
  const double thickness = random.magnitude(0.03, 0.6), height = random.magnitude(0.5, 8.0);
  const int count = random.one_of({1, 1, 2, 5, 12});
  const double pitch = draft.in_step(random.magnitude(1.0, 6.0)),
               reach = random.one_of({2.0, 5.0, kReach_px});
  const double start = beginning(draft) - 0.5 * (count - 1) * pitch;
  for (int k = 0; k < count; ++k) {
    const double low = start + k * pitch;
    draft.box(axes.at(low, -reach, 0.0), axes.at(low + thickness, reach, height), "wall");
  }
}

void make_wires(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("wire");
  const Axes axes{random.with(0.5)};
  const int count = random.one_of({1, 2, 3, 8});
  const double height = random.magnitude(0.5, 6.0), radius = random.magnitude(0.005, 0.15);
  const double pitch = draft.in_step(random.magnitude(0.5, 3.0)),
               start = beginning(draft) - 0.5 * (count - 1) * pitch;
  const double lean = random.one_of({0.0, random.between(-0.05, 0.05), random.between(-1.0, 1.0)});
  for (int k = 0; k < count; ++k) {
    const std::array<double, 3> base = axes.at(start + k * pitch - lean * kReach_px, -kReach_px, height);
    const std::array<double, 3> end = axes.at(start + k * pitch + lean * kReach_px, kReach_px, height);
    const math::Vec3 way = draft.place(end[0], end[1], end[2]) - draft.place(base[0], base[1], base[2]);
    draft.objects.push_back(format(
        R"({{"cylinder": {{"base": {}, "radius": {}, "axis": ["{} m", "{} m", "{} m"]}}, "material": "wire"}})",
        draft.point(base[0], base[1], base[2]), draft.length(radius), way.x, way.y, way.z));
  }
}

void make_panels(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("panel");
  const Axes axes{random.with(0.5)};
  const double pitch = draft.in_step(random.magnitude(0.5, 8.0)), share = random.between(0.2, 0.9);
  const double foot = random.magnitude(0.02, 1.0),
               rise = random.one_of({0.0, random.between(0.05, 0.6)}) * pitch;
  const int each_side = static_cast<int>(std::min(30.0, kReach_px / pitch));
  const double start = beginning(draft);
  if (random.with(0.5)) {  // boxes: level, their shadows beside them
    for (int k = -each_side; k < each_side; ++k)
      draft.box(axes.at(start + k * pitch, -kReach_px, 0.0),
                axes.at(start + (k + share) * pitch, kReach_px, 0.1 * foot), "panel");
    return;
  }
  std::string mesh = "usemtl panel\n";
  for (int k = -each_side, corner = 0; k < each_side; ++k, corner += 4) {
    const double low = start + k * pitch, high = low + share * pitch;
    const std::array<double, 3> corners[4] = {
        axes.at(low, -kReach_px, foot), axes.at(high, -kReach_px, foot + rise),
        axes.at(high, kReach_px, foot + rise), axes.at(low, kReach_px, foot)};
    for (const auto& c : corners) {
      const math::Point3 p = draft.place(c[0], c[1], c[2]);
      mesh += format("v {} {} {}\n", p.x, p.y, p.z);
    }
    mesh += format("f {} {} {} {}\n", corner + 1, corner + 2, corner + 3, corner + 4);
  }
  std::ofstream file(draft.folder / (draft.name + ".obj"));
  file << mesh;
  if (!file.flush())
    throw std::runtime_error("cannot write " + (draft.folder / (draft.name + ".obj")).string());
  draft.objects.push_back(format(
      R"({{"mesh": {{"file": "{}.obj"}}, "material": {{"slots": {{"panel": "panel"}}}}}})", draft.name));
}

void make_texture(WildDraft& draft) {
  RandomStream& random = draft.random;
  const int cells = random.one_of({2, 3, 6, 8});
  const double side = draft.in_step(random.magnitude(0.1, 3.0)) * cells, start = beginning(draft);
  const math::Point3 corner = draft.place(start, start, 0.0);
  const std::string where =
      format(R"("low_left": ["{} m", "{} m"], "size": ["{} m", "{} m"], "tiling": "repeat")", corner.x,
             corner.y, side * draft.gsd_m, side * draft.gsd_m);
  std::vector<float> values;
  const bool classes = draft.regime == WildDraft::Light::solar || random.with(0.4);
  const double share = random.between(0.05, 0.95);
  for (int k = 0; k < cells * cells; ++k)
    values.push_back(classes ? (random.uniform() < share ? 1.0f : 0.0f)
                             : static_cast<float>(random.between(270.0, 330.0)));
  draft.raster(draft.name + ".img", cells, cells, values);
  if (classes) {
    draft.surface("zero");
    draft.surface("one");
    draft.objects.push_back(format(
        R"({{"plane": {{}}, "material": {{"map": {{"file": "{}.img", {}, "classes": {{"0": "zero", "1": "one"}}}}}}}})",
        draft.name, where));
  } else {
    draft.material(
        "ground",
        format(R"("emissivity": {:.3f}, "temperature": {{"map": {{"file": "{}.img", {}, "unit": "K"}}}})",
               random.between(0.8, 1.0), draft.name, where));
    draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
  }
}

void make_blocks(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("block");
  draft.surface("other");
  const int count = static_cast<int>(3 + random.index(6));
  for (int k = 0; k < count; ++k) {
    const double x = random.between(-7.0, 7.0), y = random.between(-7.0, 7.0);
    draft.box({x, y, 0.0},
              {x + random.magnitude(0.2, 5.0), y + random.magnitude(0.2, 5.0), random.magnitude(0.2, 8.0)},
              random.with(0.5) ? "block" : "other");
  }
}

void make_overhead(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("plate");
  const Axes axes{random.with(0.5)};
  const int count = random.one_of({1, 1, 2, 4});
  const math::Point3 origin = draft.place(0.0, 0.0, 0.0);
  const math::Vec3 east = draft.place(1.0, 0.0, 0.0) - origin, north = draft.place(0.0, 1.0, 0.0) - origin;
  for (int k = 0; k < count; ++k) {
    const double height = random.magnitude(5.0, 300.0);
    // Where the plate must be for its shadow to lie in the image.
    const math::Vec3 away = draft.towards_sun * (height * draft.gsd_m / draft.towards_sun.z);
    const double x = dot(away, east) / (draft.gsd_m * draft.gsd_m),
                 y = dot(away, north) / (draft.gsd_m * draft.gsd_m);
    const double across = draft.in_step(random.magnitude(0.3, 12.0)),
                 along = random.one_of({across, 3.0, kReach_px});
    const double at = beginning(draft) + random.between(-6.0, 4.0);
    std::vector<std::array<double, 3>> corners;
    for (const auto& [a, b] : {std::pair{0.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      std::array<double, 3> corner = axes.at(at + a * across, b * along, height);
      corner[0] += x, corner[1] += y;
      corners.push_back(corner);
    }
    draft.polygon(corners, "plate");
  }
}

}  // namespace ifov::benchmarks
