#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.h"
#include "landscape/landscapes.h"
#include "landscape/plants/bush.h"
#include "landscape/plants/plants.h"
#include "landscape/terrain/rock.h"
#include "landscape/terrain/terrain.h"
#include "landscape/things/car.h"
#include "landscape/things/harbour_things.h"
#include "landscape/views.h"

namespace ifov::landscape {
namespace {

enum class Purpose { plain, dunes, cover, shrubs, rocks, track };
enum Cover { kSand = 1, kPale, kGravel, kTrack };

constexpr double kRim_m = 20.0;

double track_y(const RandomStream& random, double x) {
  const RandomStream draw = random.of(Purpose::track);
  return draw.between(-20.0, 0.0, 0) + 7.0 * std::sin(x / 55.0 + draw.between(0.0, 6.28, 1));
}

/// 1 where dunes stand, 0 on the plain, which the track and the camp keep to.
double dune_share(const RandomStream& random, Vec2 at) {
  const double where = fractal_noise(random.of(Purpose::dunes), at.x, at.y, 110.0, 2);
  const double off_track = std::abs(at.y - track_y(random, at.x));
  return std::clamp((where - 0.38) * 6.0, 0.0, 1.0) * std::clamp((off_track - 18.0) / 25.0, 0.0, 1.0);
}

/// Transverse dunes: long windward slopes to the west, steep lee slopes, crests that meander.
double dune_height(const RandomStream& random, Vec2 at) {
  const double meander = 26.0 * fractal_noise(random.of(Purpose::dunes, 1), at.x, at.y, 70.0, 2);
  const double phase = (at.x + meander) / 34.0;
  const double t = phase - std::floor(phase);
  const double profile =
      t < 0.76 ? 0.5 - 0.5 * std::cos(M_PI * t / 0.76) : 0.5 + 0.5 * std::cos(M_PI * (t - 0.76) / 0.24);
  return 4.2 * profile * (0.55 + 0.9 * fractal_noise(random.of(Purpose::dunes, 2), at.x, at.y, 60.0, 2));
}

}  // namespace

MadeScene make_desert(const MakeOptions& options) {
  check_size(options.size_m);
  const RandomStream random(sampling::hash(options.seed, std::uint64_t{0x446573657274}));
  SceneFolder folder(options.folder, options.replace);
  SceneMaker scene(folder);

  Terrain terrain;
  terrain.half_m = 0.5 * options.size_m + kRim_m;
  terrain.mesh_m = 1.0;
  terrain.height_m = [&](Vec2 at) {
    const double plain = 1.2 * fractal_noise(random.of(Purpose::plain), at.x, at.y, 80.0, 3) +
                         0.06 * fractal_noise(random.of(Purpose::plain, 1), at.x, at.y, 2.5, 2);
    return plain + dune_share(random, at) * dune_height(random, at);
  };
  terrain.cover = [&](Vec2 at) -> int {
    const double off_track = std::abs(at.y - track_y(random, at.x));
    const double grain = fractal_noise(random.of(Purpose::cover), at.x, at.y, 1.6, 3);
    if (std::abs(off_track - 0.85) < 0.3) return kTrack;
    const double dunes = dune_share(random, at);
    if (dunes > 0.25 + 0.3 * grain) return kSand;
    return fractal_noise(random.of(Purpose::cover, 1), at.x, at.y, 24.0, 3) + 0.25 * (grain - 0.5) > 0.47
               ? kGravel
               : kPale;
  };
  terrain.covers = {"sand", "sand, pale", "gravel", "soil"};
  add_terrain(terrain, folder, scene);
  const auto ground = [&](Vec2 at) { return terrain.on_mesh_m(at); };

  std::vector<Stock> shrubs, rocks;
  for (int k = 1; k <= 3; ++k) {
    shrubs.push_back(add_plant(
        format("shrub_{}", k),
        grow_shrub(0.45 + 0.15 * k, 0.5 + 0.25 * k, 1800 + 900 * k, 0.022, random.of(Purpose::shrubs, k)),
        true, "leaf, desert shrub", "bark", folder, scene));
    const std::string rock = format("rock_{}", k);
    scene.prototype(rock,
                    {mesh_object("", folder.add_large_mesh(rock, rock_mesh(random.of(Purpose::rocks, k))),
                                 scene.only("rock"))});
    rocks.push_back({rock, 0.6, true, {}});
  }
  const Vec2 camp{12.0, track_y(random, 12.0) + 14.0};
  const int darts = static_cast<int>(terrain.half_m * terrain.half_m / 10.0);
  for (int k = 0; k < darts; ++k) {
    const RandomStream draw = random.of(Purpose::cover, 7, k);
    const Vec2 at{draw.between(-0.98, 0.98, 0) * terrain.half_m,
                  draw.between(-0.98, 0.98, 1) * terrain.half_m};
    if (std::abs(at.y - track_y(random, at.x)) < 3.5 || length(at - camp) < 17.0 ||
        draw.unit(2) < 1.6 * dune_share(random, at))
      continue;
    const bool is_rock = draw.happens(0.4, 3);
    auto& stocks = is_rock ? rocks : shrubs;
    const double scale = is_rock ? 0.12 + 0.9 * std::pow(draw.unit(5), 4.0) : draw.between(0.5, 1.4, 5);
    stocks[static_cast<std::size_t>(draw.pick(3, 6))].copies.push_back(
        {at, draw.between(0.0, 6.28, 4), scale});
  }
  const auto add_car = [&](CarKind kind, const char* name, Vec2 at, Vec2 heading, const char* paint) {
    scene.object(standing(mesh_object(name, folder.add_mesh(name, car_mesh(kind)),
                                      scene.slots({{"body", paint},
                                                   {"glass", "window glass"},
                                                   {"tyre", "tyre"},
                                                   {"trim", "aluminium"},
                                                   {"lamp", "trim, white"}})),
                          {at, left_of(heading)}, ground(at) + 0.05));
  };
  const Vec2 on_track{-15.0, track_y(random, -15.0)};
  add_car(CarKind::van, "car_van", on_track, unit(Vec2{2.0, track_y(random, -14.0) - track_y(random, -16.0)}),
          "car paint, green");
  add_car(CarKind::estate, "car_estate", camp + Vec2{-7.0, -5.0}, unit(Vec2{0.4, 1.0}), "car paint, white");
  const std::string container = folder.add_mesh("container", container_mesh());
  int number = 0;
  for (const Vec2 off : {Vec2{-4.0, 4.0}, Vec2{4.0, 5.5}, Vec2{6.0, -3.0}}) {
    const Stand stand{camp + off, unit(Vec2{0.3 * number - 0.2, 1.0})};
    scene.object(standing(mesh_object("cabin", container,
                                      scene.slots({{"container", number == 0 ? "wall paint, white"
                                                                             : "container paint, green"}})),
                          stand, ground(stand.origin) - 0.06));
    ++number;
  }
  std::size_t count = 0;
  for (const auto* stocks : {&shrubs, &rocks}) {
    place_plants(*stocks, ground, folder, scene);
    for (const Stock& stock : *stocks) count += stock.copies.size();
  }
  return finish_scene(options,
                      {format("A desert of {:g} m, seed {}.", options.size_m, options.seed), 215.0, 0.3,
                       "sand, beach", 48, "tropical", "rural"},
                      scene, folder, {format("{} shrubs and rocks", count)});
}

}  // namespace ifov::landscape
