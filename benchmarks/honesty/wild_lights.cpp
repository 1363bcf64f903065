// Mirrors in the Sun, and small hot things.
#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

void mirror(WildDraft& draft) {
  draft.material("mirror",
                 format(R"("reflectance": {:.3f}, "scattering": "mirror")", draft.random.between(0.5, 0.95)));
}

/// The ball about a box.
PlainHints::Ball around(const WildDraft& draft, std::array<double, 3> low, std::array<double, 3> high) {
  const math::Point3 a = draft.place(low[0], low[1], low[2]), b = draft.place(high[0], high[1], high[2]);
  return {a + 0.5 * (b - a), 0.5 * math::length(b - a) * (1.0 + 1e-6)};
}

}  // namespace

void make_facade(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  mirror(draft);
  draft.surface("house");
  const double width = random.between(3.0, 9.0), height = random.between(2.0, 8.0),
               foot = random.one_of({0.0, 0.0, 1.0});
  const double shift = random.between(-2.0, 2.0), depth = 3.0, apart = 0.01;
  // The mirror is on the side of the house that the Sun stands on.
  const bool east = std::abs(draft.towards_sun.x) > std::abs(draft.towards_sun.y);
  const double side = (east ? draft.towards_sun.x : draft.towards_sun.y) > 0.0 ? 1.0 : -1.0;
  const double wall = -2.0 * side;
  const auto at = [&](double across, double along, double up) {
    return east ? std::array<double, 3>{across, along, up} : std::array<double, 3>{along, across, up};
  };
  const double back = wall - side * depth, front = wall - side * apart;
  draft.box(at(std::min(back, front), shift - 0.5 * width, 0.0),
            at(std::max(back, front), shift + 0.5 * width, foot + height), "house");
  draft.polygon({at(wall, shift - 0.5 * width, foot), at(wall, shift + 0.5 * width, foot),
                 at(wall, shift + 0.5 * width, foot + height), at(wall, shift - 0.5 * width, foot + height)},
                "mirror");
  draft.hints.around_mirrors.push_back(
      around(draft, at(wall, shift - 0.5 * width, foot), at(wall, shift + 0.5 * width, foot + height)));
}

void make_yard(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  mirror(draft);
  const int count = random.one_of({1, 2, 3});
  for (int k = 0; k < count; ++k) {
    const double x = -6.0 + 4.5 * k + random.between(0.0, 1.0), y = random.between(-5.0, 0.0);
    const std::array<double, 3> low{x, y, 0.0},
        high{x + 2.0, y + random.between(3.0, 6.0), random.between(1.5, 3.0)};
    draft.box(low, high, "mirror");
    draft.hints.around_mirrors.push_back(around(draft, low, high));
  }
}

void make_ball(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  mirror(draft);
  const double radius = random.magnitude(0.3, 3.0);
  const double x = random.between(-2.0, 2.0), y = random.between(-2.0, 2.0),
               z = radius + random.one_of({0.0, 1.0}) + 0.01;
  draft.sphere({x, y, z}, radius, "mirror");
  const PlainHints::Ball ball{draft.place(x, y, z), radius * draft.gsd_m};
  draft.hints.mirrors.push_back(ball);
  draft.hints.around_mirrors.push_back({ball.centre_m, ball.radius_m * 1.000001});
}

void make_hemisphere(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  mirror(draft);
  const double radius = random.magnitude(0.5, 4.0), x = random.between(-2.0, 2.0),
               y = random.between(-2.0, 2.0);
  draft.sphere({x, y, 0.0}, radius, "mirror", "hemisphere");
  const PlainHints::Ball ball{draft.place(x, y, 0.0), radius * draft.gsd_m};
  draft.hints.mirrors.push_back(ball);
  draft.hints.around_mirrors.push_back({ball.centre_m, ball.radius_m * 1.000001});
}

void make_hot_sphere(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.warm("ground", random.between(0.8, 0.98), random.between(280.0, 300.0));
  draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
  draft.warm("lamp", 1.0, random.between(900.0, 1300.0));
  draft.channels = random.one_of({R"({"name": "4 um", "top_hat": {"from": "3.5 um", "to": "4.1 um"}})",
                                  R"({"name": "11 um", "top_hat": {"from": "10.5 um", "to": "11.5 um"}})"});
  const double radius = random.magnitude(0.03, 0.6), height = random.magnitude(1.0, 8.0) + radius;
  const double x = random.between(-4.0, 4.0), y = random.between(-4.0, 4.0);
  draft.sphere({x, y, height}, radius, "lamp");
  draft.hints.lamps.push_back({draft.place(x, y, height), radius * draft.gsd_m});
}

void make_lamps(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.ground();
  draft.surface("house");
  draft.warm("lamp", 1.0, random.between(600.0, 1300.0));
  const double street = random.between(2.0, 6.0), height = random.between(2.0, 6.0);
  draft.box({-0.5 * street - 5.0, -20.0, 0.0}, {-0.5 * street, 20.0, height}, "house");
  draft.box({0.5 * street, -20.0, 0.0}, {0.5 * street + 5.0, 20.0, height * random.between(0.5, 1.0)},
            "house");
  const int count = random.one_of({1, 2, 3});
  for (int k = 0; k < count; ++k) {
    const double radius = random.magnitude(0.02, 0.15), x = random.between(-0.35, 0.35) * street;
    const double y = random.between(-6.0, 6.0), z = height * random.between(0.3, 0.9);
    draft.sphere({x, y, z}, radius, "lamp");
    draft.hints.lamps.push_back({draft.place(x, y, z), radius * draft.gsd_m});
  }
}

void make_night(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.warm("ground", random.between(0.5, 0.95), random.between(275.0, 290.0));
  draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
  draft.warm("slab", random.between(0.6, 0.98), random.between(300.0, 330.0));
  draft.warm("lamp", 1.0, random.between(800.0, 1300.0));
  draft.channels = R"({"name": "1.6 um", "top_hat": {"from": "1.55 um", "to": "1.65 um"}},
      {"name": "11 um", "top_hat": {"from": "10.5 um", "to": "11.5 um"}})";
  const double pitch = draft.in_step(random.magnitude(0.5, 4.0)), width = pitch * random.between(0.1, 0.5);
  const int each_side = static_cast<int>(std::min(30.0, kReach_px / pitch));
  const double start = random.uniform();
  for (int k = -each_side; k <= each_side; ++k)
    draft.box({start + k * pitch, -kReach_px, 0.0},
              {start + k * pitch + width, kReach_px, random.magnitude(0.02, 0.3)}, "slab");
  const double radius = random.magnitude(0.01, 0.1), height = random.magnitude(1.0, 8.0) + radius;
  const double x = random.between(-4.0, 4.0), y = random.between(-4.0, 4.0);
  draft.sphere({x, y, height}, radius, "lamp");
  draft.hints.lamps.push_back({draft.place(x, y, height), radius * draft.gsd_m});
}

}  // namespace ifov::benchmarks
