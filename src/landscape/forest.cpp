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
#include "landscape/views.h"

namespace ifov::landscape {
namespace {

enum class Purpose { height, cover, glade, trees, planting, shrubs, rocks, track, logs };
enum Cover { kNeedles = 1, kLeaves, kSoil, kGrass, kGravel };

constexpr double kRim_m = 20.0;
constexpr double kTrack_half_m = 1.7;

/// A track winds from west to east.
double track_y(const RandomStream& random, double x) {
  const RandomStream draw = random.of(Purpose::track);
  return draw.between(-12.0, 12.0, 0) + 9.0 * std::sin(x / 38.0 + draw.between(0.0, 6.28, 1)) +
         4.0 * std::sin(x / 17.0);
}

double glade(const RandomStream& random, Vec2 at) {
  return fractal_noise(random.of(Purpose::glade), at.x, at.y, 45.0, 2);
}

class Woodland {
 public:
  Woodland(const RandomStream& random, double half_m) : random_(random), half_m_(half_m) {}

  void plant(std::vector<Stock>& trees) {
    // Trees in cells of 8 m know their neighbours.
    const int cells = static_cast<int>(std::ceil(2.0 * half_m_ / kCell_m));
    std::vector<std::vector<std::pair<Vec2, double>>> grid(static_cast<std::size_t>(cells * cells));
    const auto cell_of = [&](double v) {
      return std::clamp(static_cast<int>((v + half_m_) / kCell_m), 0, cells - 1);
    };
    const int darts = static_cast<int>(4.0 * half_m_ * half_m_ / 4.0);
    for (int k = 0; k < darts; ++k) {
      const RandomStream draw = random_.of(Purpose::planting, k);
      const Vec2 at{draw.between(-half_m_, half_m_, 0), draw.between(-half_m_, half_m_, 1)};
      if (glade(random_, at) > 0.62 || std::abs(at.y - track_y(random_, at.x)) < kTrack_half_m + 1.2)
        continue;
      // Spruce and broadleaves grow in groups.
      const double mix = fractal_noise(random_.of(Purpose::cover), at.x, at.y, 30.0, 2);
      std::size_t choice = static_cast<std::size_t>(draw.pick(static_cast<int>(trees.size()), 2));
      if (trees[choice].low_branches != (mix > 0.5) && draw.happens(0.75, 3)) continue;
      const Planted tree{at, draw.between(0.0, 2.0 * M_PI, 4), draw.between(0.7, 1.45, 5)};
      const double crown = trees[choice].crown_radius_m * tree.scale;
      bool free = true;
      for (int row = cell_of(at.y) - 1; row <= cell_of(at.y) + 1 && free; ++row)
        for (int column = cell_of(at.x) - 1; column <= cell_of(at.x) + 1 && free; ++column) {
          if (row < 0 || column < 0 || row >= cells || column >= cells) continue;
          for (const auto& [other, radius] : grid[static_cast<std::size_t>(row * cells + column)])
            if (length(other - at) < 0.62 * (radius + crown)) free = false;
        }
      if (!free) continue;
      grid[static_cast<std::size_t>(cell_of(at.y) * cells + cell_of(at.x))].emplace_back(at, crown);
      trees[choice].copies.push_back(tree);
      trunks_.push_back(at);
    }
  }

  /// Whether nothing grows within `margin_m`.
  bool is_free(Vec2 at, double margin_m) const {
    return std::none_of(trunks_.begin(), trunks_.end(),
                        [&](Vec2 trunk) { return length(trunk - at) < margin_m; });
  }
  std::size_t size() const { return trunks_.size(); }

 private:
  static constexpr double kCell_m = 8.0;
  RandomStream random_;
  double half_m_;
  std::vector<Vec2> trunks_;
};

/// Trunks that fell, on the ground.
void add_logs(const Terrain& terrain, const Woodland& woods, const RandomStream& random, SceneFolder& folder,
              SceneMaker& scene) {
  MeshBuilder mesh;
  mesh.slot("wood");
  const int count = static_cast<int>(terrain.half_m * terrain.half_m / 90.0);
  for (int k = 0; k < count; ++k) {
    const RandomStream draw = random.of(Purpose::logs, k);
    const Vec2 at{draw.between(-0.95, 0.95, 0) * terrain.half_m,
                  draw.between(-0.95, 0.95, 1) * terrain.half_m};
    const double angle = draw.between(0.0, M_PI, 2), log = draw.between(1.5, 5.0, 3),
                 radius = draw.between(0.08, 0.22, 4);
    const Vec2 end = at + Vec2{std::cos(angle), std::sin(angle)} * log;
    if (std::max(std::abs(end.x), std::abs(end.y)) > terrain.half_m || !woods.is_free(at, 0.6) ||
        !woods.is_free(end, 0.6) || !woods.is_free((at + end) * 0.5, 0.9) ||
        std::abs(at.y - track_y(random, at.x)) < 6.5)
      continue;
    mesh.tube(std::array<Point3, 2>{{{at.x, at.y, terrain.on_mesh_m(at) + 0.8 * radius},
                                     {end.x, end.y, terrain.on_mesh_m(end) + 0.7 * radius}}},
              std::array{radius, 0.7 * radius}, 10, true);
  }
  if (!mesh.empty())
    scene.object(
        mesh_object("fallen trunks", folder.add_mesh("logs", mesh.take()), scene.slots({{"wood", "bark"}})));
}

}  // namespace

MadeScene make_forest(const MakeOptions& options) {
  check_size(options.size_m);
  const RandomStream random(sampling::hash(options.seed, std::uint64_t{0x466f72657374}));
  SceneFolder folder(options.folder, options.replace);
  SceneMaker scene(folder);

  Terrain terrain;
  terrain.half_m = 0.5 * options.size_m + kRim_m;
  terrain.height_m = [&](Vec2 at) {
    return 9.0 * fractal_noise(random.of(Purpose::height), at.x, at.y, 90.0, 3) +
           0.25 * fractal_noise(random.of(Purpose::height, 1), at.x, at.y, 4.0, 2);
  };
  terrain.cover = [&](Vec2 at) -> int {
    const double off_track = std::abs(at.y - track_y(random, at.x));
    const double tuft = fractal_noise(random.of(Purpose::cover, 2), at.x, at.y, 1.1, 3);
    if (off_track < kTrack_half_m && (off_track > 0.45 || tuft < 0.5)) return kGravel;
    if (off_track < kTrack_half_m + 1.5 || glade(random, at) > 0.6) return tuft > 0.26 ? kGrass : kSoil;
    if (tuft < 0.33) return kSoil;
    return fractal_noise(random.of(Purpose::cover), at.x, at.y, 30.0, 2) > 0.5 ? kNeedles : kLeaves;
  };
  terrain.covers = {"litter, needles", "litter, leaves", "soil, dark", "meadow", "gravel"};
  add_terrain(terrain, folder, scene);

  std::vector<int> leaves;
  std::vector<Stock> trees = add_trees(3, random.of(Purpose::trees), folder, scene, &leaves);
  Woodland woods(random, terrain.half_m);
  woods.plant(trees);
  std::vector<Stock> shrubs, rocks;
  for (int k = 1; k <= 2; ++k) {
    shrubs.push_back(add_plant(format("shrub_{}", k),
                               grow_shrub(0.6, 0.7 + 0.3 * k, 2800, 0.06, random.of(Purpose::shrubs, k)),
                               true, "leaf, hedge", "bark", folder, scene));
    const std::string rock = format("rock_{}", k);
    scene.prototype(rock,
                    {mesh_object("", folder.add_large_mesh(rock, rock_mesh(random.of(Purpose::rocks, k))),
                                 scene.only("rock"))});
    rocks.push_back({rock, 0.6, true, {}});
  }
  const int darts = static_cast<int>(terrain.half_m * terrain.half_m / 12.0);
  for (int k = 0; k < darts; ++k) {
    const RandomStream draw = random.of(Purpose::shrubs, Purpose::planting, k);
    const Vec2 at{draw.between(-0.98, 0.98, 0) * terrain.half_m,
                  draw.between(-0.98, 0.98, 1) * terrain.half_m};
    if (std::abs(at.y - track_y(random, at.x)) < kTrack_half_m + 1.0 || !woods.is_free(at, 1.1)) continue;
    auto& stocks = draw.happens(0.15, 2) ? rocks : shrubs;
    stocks[static_cast<std::size_t>(draw.pick(2, 3))].copies.push_back(
        {at, draw.between(0.0, 6.28, 4), draw.between(0.5, 1.3, 5)});
  }
  add_logs(terrain, woods, random, folder, scene);

  const Vec2 park{6.0, track_y(random, 6.0)};
  const Vec2 heading = unit(Vec2{2.0, track_y(random, 7.0) - track_y(random, 5.0)});
  scene.object(standing(mesh_object("van", folder.add_mesh("car_van", car_mesh(CarKind::van)),
                                    scene.slots({{"body", "car paint, green"},
                                                 {"glass", "window glass"},
                                                 {"tyre", "tyre"},
                                                 {"trim", "aluminium"},
                                                 {"lamp", "trim, white"}})),
                        {park, left_of(heading)}, terrain.on_mesh_m(park) + 0.03));
  for (const auto* stocks : {&trees, &shrubs, &rocks})
    place_plants(
        *stocks, [&](Vec2 at) { return terrain.on_mesh_m(at); }, folder, scene);
  return finish_scene(
      options, {format("A forest of {:g} m, seed {}.", options.size_m, options.seed), 205.0, 0.5}, scene,
      folder,
      {format("{} trees of {} individuals and {} species, {} to {} leaves each", woods.size(), trees.size(),
              tree_species().size(), *std::min_element(leaves.begin(), leaves.end()),
              *std::max_element(leaves.begin(), leaves.end()))});
}

}  // namespace ifov::landscape
