#include <array>
#include <cmath>

#include "core/format.h"
#include "landscape/landscapes.h"
#include "landscape/shapes/mesh_builder.h"
#include "landscape/shapes/random_stream.h"
#include "landscape/shapes/region.h"
#include "landscape/things/car.h"
#include "landscape/things/harbour_things.h"
#include "landscape/views.h"

namespace ifov::landscape {
namespace {

enum class Purpose { waves, ships, stacks, sheds, traffic, boats };

constexpr double kRim_m = 20.0;
constexpr double kQuay_m = 2.6;    // of the quay above the water
constexpr double kEdge_y = 0.0;    // the quay's face; water to the north
constexpr double kRail_y = -4.0;   // of the crane's seaward rail
constexpr double kYard_y = -28.0;  // of the first row of containers

constexpr std::array kPaints{"container paint, red", "container paint, blue", "container paint, green",
                             "wall paint, white", "crane paint, yellow"};

/// Small waves, as facets half a metre across near the quay.
geometry::TriangleMesh water_mesh(double half_m, const RandomStream& random) {
  geometry::TriangleMesh mesh;
  const double cell = half_m > 200.0 ? 2.0 : 0.6;
  const int columns = static_cast<int>(std::ceil(2.0 * half_m / cell)),
            rows = static_cast<int>(std::ceil((half_m - kEdge_y + 0.5) / cell));
  const double dx = 2.0 * half_m / columns, dy = (half_m - kEdge_y + 0.5) / rows;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const double x = -half_m + column * dx, y = kEdge_y - 0.5 + row * dy;
      mesh.vertices_m.push_back({x, y, 0.12 * (fractal_noise(random, x, 1.7 * y, 3.0, 3) - 0.5)});
    }
  const auto index = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      mesh.triangles.push_back({index(column, row), index(column + 1, row), index(column + 1, row + 1)});
      mesh.triangles.push_back({index(column, row), index(column + 1, row + 1), index(column, row + 1)});
    }
  return mesh;
}

void add_quay(double half, SceneFolder& folder, SceneMaker& scene) {
  MeshBuilder mesh;
  const auto strip = [&](const char* slot, double south, double north) {
    mesh.slot(slot);
    mesh.quad({-half, south, kQuay_m}, {half, south, kQuay_m}, {half, north, kQuay_m},
              {-half, north, kQuay_m});
  };
  strip("coping", kEdge_y - 1.2, kEdge_y);
  strip("apron", kYard_y + 5.5, kEdge_y - 1.2);
  strip("yard", -0.62 * half, kYard_y + 5.5);
  strip("road", -0.62 * half - 9.0, -0.62 * half);
  strip("yard", -half, -0.62 * half - 9.0);
  mesh.slot("wall");
  mesh.quad({-half, kEdge_y, -0.8}, {-half, kEdge_y, kQuay_m}, {half, kEdge_y, kQuay_m},
            {half, kEdge_y, -0.8});
  mesh.slot("rail");
  for (const double y : {kRail_y, kRail_y - 15.0})
    mesh.box({-half, y - 0.05, kQuay_m}, {half, y + 0.05, kQuay_m + 0.04});
  mesh.slot("line");
  for (double x = -half + 1.0; x < half - 3.0; x += 6.0)
    mesh.quad({x, -0.62 * half - 4.6, kQuay_m + 0.004}, {x + 3.0, -0.62 * half - 4.6, kQuay_m + 0.004},
              {x + 3.0, -0.62 * half - 4.4, kQuay_m + 0.004}, {x, -0.62 * half - 4.4, kQuay_m + 0.004});
  mesh.slot("bollard");
  for (double x = -half + 6.0; x < half; x += 18.0) {
    mesh.tube({x, kEdge_y - 0.6, kQuay_m}, {x, kEdge_y - 0.6, kQuay_m + 0.45}, 0.22, 12);
    mesh.tube({x, kEdge_y - 0.6, kQuay_m + 0.45}, {x, kEdge_y - 0.6, kQuay_m + 0.6}, 0.32, 12);
  }
  mesh.slot("fender");
  for (double x = -half + 3.0; x < half; x += 9.0)
    mesh.tube({x, kEdge_y + 0.42, 0.4}, {x, kEdge_y + 0.42, 2.2}, 0.4, 12);
  scene.object(mesh_object("quay", folder.add_mesh("quay", mesh.take()),
                           scene.slots({{"coping", "concrete, slab"},
                                        {"apron", "concrete, pavement"},
                                        {"yard", "asphalt, driveway"},
                                        {"road", "asphalt, street"},
                                        {"wall", "concrete, kerb"},
                                        {"rail", "steel, galvanised"},
                                        {"line", "road paint, white"},
                                        {"bollard", "crane paint, yellow"},
                                        {"fender", "tyre"}})));
}

void add_ship(const char* name, double length_m, double beam_m, Vec2 at, const char* hull,
              SceneFolder& folder, SceneMaker& scene) {
  scene.object(moved(mesh_object(name, folder.add_mesh(name, ship_mesh(length_m, beam_m)),
                                 scene.slots({{"hull", hull},
                                              {"bottom", "hull paint, red"},
                                              {"deck", "deck paint, green"},
                                              {"house", "wall paint, white"},
                                              {"window", "window glass"},
                                              {"trim", "steel, galvanised"}})),
                     {at.x, at.y, 0.0}));
}

struct Yard {
  std::string container;
  SceneMaker& scene;
  std::size_t count = 0;

  void stack(Vec2 at, double floor_m, int high, const RandomStream& draw) {
    for (int level = 0; level < high; ++level, ++count)
      scene.object(moved(
          mesh_object("container", container,
                      scene.slots({{"container",
                                    kPaints[static_cast<std::size_t>(draw.pick(kPaints.size(), level))]}})),
          {at.x, at.y, floor_m + 2.6 * level}));
  }
};

}  // namespace

MadeScene make_harbour(const MakeOptions& options) {
  check_size(options.size_m);
  const RandomStream random(sampling::hash(options.seed, std::uint64_t{0x486172626f7572}));
  SceneFolder folder(options.folder, options.replace);
  SceneMaker scene(folder);
  const double half = 0.5 * options.size_m + kRim_m;

  scene.object(mesh_object("water",
                           folder.add_large_mesh("water", water_mesh(half, random.of(Purpose::waves))),
                           scene.only("water, harbour")));
  add_quay(half, folder, scene);

  const RandomStream draw = random.of(Purpose::ships);
  const double ship = std::min(1.15 * half, 118.0), beam = ship / 6.2;
  const Vec2 berth{draw.between(-0.12, 0.12, 0) * half, kEdge_y + 0.9 + 0.5 * beam};
  add_ship("cargo_ship", ship, beam, berth, "hull paint, black", folder, scene);
  add_ship("tug", 24.0, 7.5,
           {draw.between(-0.6, 0.4, 1) * half, std::min(0.7 * half, berth.y + 0.5 * beam + 22.0)},
           "container paint, blue", folder, scene);

  Yard yard{folder.add_mesh("container", container_mesh()), scene};
  const double hold = berth.x - 0.5 * ship + 0.05 * ship + std::min(0.13 * ship, 14.0) + 4.0;
  for (double x = hold + 3.3; x + 3.3 < berth.x + 0.34 * ship; x += 7.5)
    for (double y = -0.36 * beam + 1.3; y + 1.2 < 0.36 * beam; y += 2.55) {
      const RandomStream own =
          random.of(Purpose::stacks, 1, static_cast<int>(10.0 * x), static_cast<int>(10.0 * y));
      if (static_cast<int>((x - hold) / 15.0) * 15.0 + hold + 13.0 < berth.x + 0.36 * ship &&
          std::fmod(x - hold, 15.0) < 10.0)
        yard.stack({x, berth.y + y}, 0.055 * ship + 1.3, own.pick(4, 40), own);
    }
  for (double y = kYard_y; y > -0.42 * half; y -= 2.7)
    for (double x = -0.9 * half; x < 0.9 * half; x += 6.6) {
      const RandomStream own =
          random.of(Purpose::stacks, 2, static_cast<int>(10.0 * x), static_cast<int>(10.0 * y));
      // Lanes for vehicles between blocks of five rows and of eight columns.
      const int row = static_cast<int>((kYard_y - y) / 2.7),
                column = static_cast<int>((x + 0.9 * half) / 6.6);
      if (row % 7 > 4 || column % 8 > 6) continue;
      yard.stack({x, y}, kQuay_m, own.pick(5, 40), own);
    }

  const std::string crane = folder.add_mesh("crane", crane_mesh());
  int cranes = 0;
  for (double x = -0.45 * half; x < 0.6 * half; x += std::max(45.0, 0.55 * half), ++cranes)
    scene.object(moved(
        mesh_object("crane", crane,
                    scene.slots({{"steel", cranes % 2 == 0 ? "container paint, blue" : "crane paint, yellow"},
                                 {"cable", "steel, galvanised"},
                                 {"window", "window glass"}})),
        {x, kRail_y - 15.0, kQuay_m}));

  const double road = -0.62 * half;
  const double shed_width = std::min(26.0, 0.28 * half), shed_length = std::min(60.0, 0.7 * half);
  const std::string shed = folder.add_mesh("shed", shed_mesh(shed_length, shed_width));
  int sheds = 0;
  for (double x = -half + 0.5 * shed_length + 4.0; x + 0.5 * shed_length < half - 2.0;
       x += shed_length + 12.0, ++sheds)
    scene.object(
        moved(mesh_object("shed", shed,
                          scene.slots({{"wall", sheds % 2 == 0 ? "brick, red" : "cinder block"},
                                       {"roof", sheds % 2 == 0 ? "roof, bitumen" : "steel, galvanised"},
                                       {"door", "door, green"},
                                       {"trim", "steel, galvanised"}})),
              {x, road - 9.0 - 4.0 - 0.5 * shed_width, kQuay_m}));
  const std::string lorry = folder.add_mesh("lorry", lorry_mesh());
  for (double x = -half + 12.0; x < half - 8.0; x += 24.0) {
    const RandomStream own = random.of(Purpose::traffic, static_cast<int>(x));
    if (own.happens(0.35, 0)) continue;
    const bool east = own.happens(0.5, 1);
    const Vec2 at{x + own.between(-4.0, 4.0, 2), road - (east ? 6.7 : 2.3)};
    scene.object(standing(
        mesh_object(
            "lorry", lorry,
            scene.slots({{"cab", own.happens(0.5, 3) ? "car paint, white" : "car paint, red"},
                         {"glass", "window glass"},
                         {"tyre", "tyre"},
                         {"bed", "steel, galvanised"},
                         {"container", kPaints[static_cast<std::size_t>(own.pick(kPaints.size(), 4))]}})),
        {at, left_of(Vec2{east ? 1.0 : -1.0, 0.0})}, kQuay_m));
  }
  return finish_scene(
      options, {format("A harbour of {:g} m, seed {}.", options.size_m, options.seed), 30.0, 0.4}, scene,
      folder, {format("2 ships, {} cranes, {} containers, {} sheds", cranes, yard.count, sheds)});
}

}  // namespace ifov::landscape
