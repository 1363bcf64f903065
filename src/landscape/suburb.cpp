#include <algorithm>
#include <array>

#include "core/format.h"
#include "landscape/landscapes.h"
#include "landscape/plants/bush.h"
#include "landscape/plants/plants.h"
#include "landscape/plots/garden_plan.h"
#include "landscape/plots/ground.h"
#include "landscape/plots/power_line.h"
#include "landscape/plots/traffic.h"
#include "landscape/things/court.h"
#include "landscape/views.h"

namespace ifov::landscape {
namespace {

enum class Purpose { streets, plots, ground, trees, planting, hedges, shrubs, cars, colours };

// The scene goes on beyond the images, so that shadows and reflections at their rims are right.
constexpr double kRim_m = 20.0;
constexpr double kLand_m = StreetSection::kLand;

constexpr std::array kRoofs{"roof tile, terracotta", "roof tile, red", "roof tile, brown",
                            "roof shingle, grey", "roof shingle, brown"};
constexpr std::array kWalls{"brick, red", "brick, weathered", "wall paint, white", "wall paint, cream"};
constexpr std::array kDoors{"door, green", "door, red", "timber, weathered"};

template <std::size_t N>
const char* one_of(const std::array<const char*, N>& choices, const RandomStream& draw, int index) {
  return choices[static_cast<std::size_t>(draw.pick(static_cast<int>(N), index))];
}

void add_houses(const PlotPlan& plots, const RandomStream& random, SceneFolder& folder, SceneMaker& scene) {
  std::vector<std::string> files(plots.designs.size());
  for (const Plot& plot : plots.plots) {
    const auto design = static_cast<std::size_t>(plot.design);
    const HousePlan& plan = plots.designs[design];
    if (files[design].empty())
      files[design] = folder.add_mesh(
          format("house_{:02}_{}", plot.design + 1, plan.roof == RoofKind::gabled ? "gabled" : "hipped"),
          house_mesh(plan));
    const RandomStream draw = random.of(plot.number);
    scene.object(standing(
        mesh_object(format("house {}", plot.number), files[design],
                    scene.slots({{"roof", one_of(kRoofs, draw, 0)},
                                 {"wall", one_of(kWalls, draw, 1)},
                                 {"trim", "trim, white"},
                                 {"window", "window glass"},
                                 {"door", one_of(kDoors, draw, 2)},
                                 {"garage door", draw.happens(0.6, 3) ? "trim, white" : "timber, weathered"},
                                 {"brick", "brick, weathered"},
                                 {"concrete", "concrete, slab"}})),
        plot.house, kLand_m));
  }
}

void add_cars(const std::vector<ParkedCar>& cars, SceneFolder& folder, SceneMaker& scene) {
  constexpr std::array<const char*, kCarKinds> kNames{"car_sedan", "car_estate", "car_van"};
  std::array<std::string, kCarKinds> files;
  for (const ParkedCar& car : cars) {
    const auto kind = static_cast<std::size_t>(car.kind);
    if (files[kind].empty()) files[kind] = folder.add_mesh(kNames[kind], car_mesh(car.kind));
    scene.object(standing(mesh_object("car", files[kind],
                                      scene.slots({{"body", car.paint},
                                                   {"glass", "window glass"},
                                                   {"tyre", "tyre"},
                                                   {"trim", "aluminium"},
                                                   {"lamp", "trim, white"}})),
                          car.stand, car.ground_m));
  }
}

void add_power_line(const PowerLine& line, SceneFolder& folder, SceneMaker& scene) {
  if (line.poles.empty()) return;
  const std::string pole = folder.add_mesh("pole", pole_mesh());
  for (const Stand& stand : line.poles)
    scene.object(standing(
        mesh_object(
            "pole", pole,
            scene.slots({{"pole", "pole wood"}, {"steel", "steel, galvanised"}, {"insulator", "insulator"}})),
        stand, kLand_m));
  if (line.poles.size() > 1)
    scene.object(mesh_object("wires", folder.add_mesh("wires", wire_mesh(line, kLand_m)),
                             scene.slots({{"wire", "aluminium"}})));
}

}  // namespace

MadeScene make_suburb(const MakeOptions& options) {
  check_size(options.size_m);
  const RandomStream random(sampling::hash(options.seed, std::uint64_t{0x5375627572626961}));
  SceneFolder folder(options.folder, options.replace);
  SceneMaker scene(folder);

  const StreetPlan streets = plan_streets(0.5 * options.size_m + kRim_m, random.of(Purpose::streets));
  const PlotPlan plots = plan_plots(streets, random.of(Purpose::plots));
  const PowerLine line = plan_power_line(streets.mains[plots.court_street], plots.plots, streets.half_m);
  const std::vector<ParkedCar> cars = plan_cars(streets, plots, random.of(Purpose::cars));

  lay_ground(streets, plots, random.of(Purpose::ground), folder, scene);
  scene.object(standing(mesh_object("tennis court", folder.add_mesh("court", court_mesh()),
                                    scene.slots({{"surround", "court, green"},
                                                 {"court", "court, red"},
                                                 {"line", "court line"},
                                                 {"steel", "steel, galvanised"},
                                                 {"net", "net"},
                                                 {"concrete", "concrete, slab"}})),
                        plots.court_stand, kLand_m));
  add_houses(plots, random.of(Purpose::colours), folder, scene);
  add_cars(cars, folder, scene);
  add_power_line(line, folder, scene);

  std::vector<int> leaves;
  std::vector<Stock> trees = add_trees(3, random.of(Purpose::trees), folder, scene, &leaves);
  plant_trees(trees, {streets, plots, line}, random.of(Purpose::planting));
  std::vector<Stock> hedges, shrubs;
  for (int k = 1; k <= 2; ++k) {
    hedges.push_back(add_plant(format("hedge_{}", k), grow_hedge(random.of(Purpose::hedges, k)), true,
                               "leaf, hedge", "bark", folder, scene));
    shrubs.push_back(add_plant(format("shrub_{}", k),
                               grow_shrub(0.5, 0.75 + 0.2 * k, 2600, 0.05, random.of(Purpose::shrubs, k)),
                               true, "leaf, shrub", "bark", folder, scene));
  }
  plant_hedges(hedges, trees, {streets, plots, line}, random.of(Purpose::hedges));
  plant_shrubs(shrubs, {streets, plots, line}, random.of(Purpose::shrubs));
  for (const auto* stocks : {&trees, &hedges, &shrubs})
    place_plants(
        *stocks, [](Vec2) { return kLand_m; }, folder, scene);

  std::size_t tree_count = 0;
  for (const Stock& stock : trees) tree_count += stock.copies.size();
  return finish_scene(
      options, {format("A suburb of {:g} m, seed {}.", options.size_m, options.seed)}, scene, folder,
      {format("{} houses, {} cars", plots.plots.size(), cars.size()),
       format("{} trees of {} individuals and {} species, {} to {} leaves each", tree_count, trees.size(),
              tree_species().size(), *std::min_element(leaves.begin(), leaves.end()),
              *std::max_element(leaves.begin(), leaves.end()))});
}

}  // namespace ifov::landscape
