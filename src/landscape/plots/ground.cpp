#include "landscape/plots/ground.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/document/shapes/flat_primitives.h"
#include "landscape/plots/garden_plan.h"
#include "landscape/plots/lawn_map.h"
#include "landscape/shapes/mesh_builder.h"
#include "landscape/streets/road_markings.h"
#include "landscape/things/court.h"

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr double kPaint_m = 0.004;
constexpr double kApronEdge_m = 0.02;  // lip between gutter and driveway
constexpr double kPoolWater_m = 0.1;   // water below the deck

Region all_rectangles(const std::vector<Footprint>& footprints) {
  std::vector<Region> parts;
  for (const Footprint& footprint : footprints) parts.push_back(Region::rectangle(footprint));
  return Region::all_of(parts);
}

/// A level area, with walls down to `skirt_to_m` where that is below it.
void add(MeshBuilder& mesh, const char* slot, const Region& region, double height_m, double skirt_to_m) {
  const Region::Height height = [height_m](Vec2) { return height_m; };
  mesh.slot(slot);
  region.pave(mesh, height);
  if (skirt_to_m < height_m) region.skirt(mesh, height, skirt_to_m);
}

/// Repairs and manholes in the asphalt.
void plan_repairs(const StreetPlan& streets, const RandomStream& random, std::vector<Region>& patches,
                  std::vector<Region>& covers) {
  int number = 0;
  for (const auto* kind : {&streets.mains, &streets.sides})
    for (const Street& street : *kind) {
      const double total = street.length_m();
      for (double along = 8.0; along < total - 8.0; along += 14.0) {
        const RandomStream draw = random.of(++number);
        const double at = along + draw.between(-5.0, 5.0, 0);
        const Stand stand{street.at(at) + left_of(street.direction(at)) * draw.between(-2.3, 2.3, 1),
                          street.direction(at)};
        if (draw.happens(0.3, 2)) {
          const double half_width = draw.between(0.4, 1.0, 3), half_length = draw.between(0.6, 2.6, 4);
          patches.push_back(Region::rectangle({stand, -half_width, half_width, -half_length, half_length}));
        } else if (draw.happens(0.3, 5)) {
          covers.push_back(Region::disc(stand.origin, 0.33));
        }
      }
    }
}

void lay_streets(MeshBuilder& mesh, const StreetPlan& streets, const RandomStream& random) {
  std::vector<Region> patches, covers;
  plan_repairs(streets, random, patches, covers);
  const Region cover = Region::all_of(covers) & streets.asphalt;
  const Region patch = (Region::all_of(patches) & streets.asphalt) - cover;
  add(mesh, "asphalt", streets.asphalt - patch - cover, 0.0, 0.0);
  add(mesh, "repair", patch, 0.0, 0.0);
  add(mesh, "manhole", cover, 0.0, 0.0);
  const RoadMarkings paint = paint_streets(streets);
  add(mesh, "white paint", paint.white - cover, kPaint_m, 0.0);
  add(mesh, "yellow paint", paint.yellow - cover, kPaint_m, 0.0);
}

/// The piece of a driveway between gutter and sidewalk rises with it.
void lay_aprons(MeshBuilder& mesh, const PlotPlan& plots, const Region& verge_and_kerb) {
  mesh.slot("apron");
  for (const Plot& plot : plots.plots) {
    const Region apron = Region::rectangle(plot.driveway) & verge_and_kerb;
    if (apron.empty()) continue;
    const double rise = (Section::kLand - kApronEdge_m) / (Section::kKerb + Section::kVerge);
    const auto height = [&](Vec2 p) {
      const double inward = dot(p - plot.stand.origin, plot.stand.inward) + Section::kSidewalk;
      return std::clamp(Section::kLand + rise * inward, 0.0, Section::kLand);
    };
    apron.pave(mesh, height);
    apron.skirt(mesh, height, 0.0);
  }
}

}  // namespace

void lay_ground(const StreetPlan& streets, const PlotPlan& plots, const RandomStream& random,
                SceneFolder& folder, SceneMaker& scene) {
  const Region land = streets.domain - streets.asphalt;
  const Region to_kerb = streets.asphalt.grown(Section::kKerb) & streets.domain;
  const Region to_verge = streets.asphalt.grown(Section::kKerb + Section::kVerge) & streets.domain;
  const Region lots = streets.domain - streets.corridor;

  std::vector<Footprint> concrete, asphalt, walks, patios, decks, pools, beds;
  for (const Plot& plot : plots.plots) {
    (plot.paved_driveway ? concrete : asphalt).push_back(plot.driveway);
    walks.push_back(plot.front_walk);
    patios.push_back(plot.patio);
    beds.push_back(front_bed(plot, plots.designs[static_cast<std::size_t>(plot.design)]));
    if (!plot.has_pool) continue;
    decks.push_back(plot.pool_deck);
    pools.push_back(plot.pool);
  }
  const Footprint court{plots.court_stand, -0.5 * CourtSize::kLot_length, 0.5 * CourtSize::kLot_length,
                        -0.5 * CourtSize::kLot_width, 0.5 * CourtSize::kLot_width};
  const Footprint court_path{plots.court_stand, -1.0, 1.0, -0.5 * CourtSize::kLot_width - 20.0,
                             -0.5 * CourtSize::kLot_width};
  const Region concrete_drives = all_rectangles(concrete), drives = concrete_drives + all_rectangles(asphalt);
  walks.push_back(court_path);

  MeshBuilder mesh;
  lay_streets(mesh, streets, random.of(1));
  const Region kerb_and_verge = to_verge & land;
  add(mesh, "kerb", (to_kerb & land) - drives, Section::kLand, 0.0);
  lay_aprons(mesh, plots, kerb_and_verge);
  add(mesh, "sidewalk", (streets.corridor - to_verge) & land, Section::kLand, 0.0);

  Region free = lots;
  const auto take = [&](const char* slot, const Region& wanted, double height_m, double skirt_to) {
    const Region region = wanted & free;
    if (!region.empty()) add(mesh, slot, region, height_m, skirt_to);
    free = free - region;
  };
  const Region water = all_rectangles(pools);
  take("water", water, Section::kLand - kPoolWater_m, Section::kLand);
  take("deck", all_rectangles(decks), Section::kLand, Section::kLand - kPoolWater_m);
  free = free - Region::rectangle(court);
  take("concrete driveway", concrete_drives, Section::kLand, Section::kLand);
  take("asphalt driveway", drives, Section::kLand, Section::kLand);
  take("walk", all_rectangles(walks), Section::kLand, Section::kLand);
  take("patio", all_rectangles(patios), Section::kLand, Section::kLand);
  take("bed", all_rectangles(beds), Section::kLand, Section::kLand);

  const std::string file = folder.add_mesh("ground", mesh.take());
  scene.object(mesh_object("streets and paths", file,
                           scene.slots({{"asphalt", "asphalt, street"},
                                        {"repair", "asphalt, repaired"},
                                        {"manhole", "steel, galvanised"},
                                        {"white paint", "road paint, white"},
                                        {"yellow paint", "road paint, yellow"},
                                        {"kerb", "concrete, kerb"},
                                        {"apron", "concrete, driveway"},
                                        {"sidewalk", "concrete, pavement"},
                                        {"water", "water, pool"},
                                        {"deck", "concrete, slab"},
                                        {"concrete driveway", "concrete, driveway"},
                                        {"asphalt driveway", "asphalt, driveway"},
                                        {"walk", "concrete, pavement"},
                                        {"patio", "concrete, slab"},
                                        {"bed", "soil, dark"}})));

  MeshBuilder lawn;
  const Region verges = (kerb_and_verge - to_kerb) - drives;
  add(lawn, "lawn", free + verges, Section::kLand, 0.0);
  const std::string lawn_file = folder.add_mesh("lawn", lawn.take());
  scene.object(mesh_object("lawns", lawn_file, lawn_material(streets, plots, random.of(2), folder, scene)));
  io::PolygonPrimitive subsoil;
  const double half = to_millimetre(streets.half_m), below = -0.05;
  subsoil.vertices_m = {
      {-half, -half, below}, {half, -half, below}, {half, half, below}, {-half, half, below}};
  io::ObjectDocument object;
  object.name = "subsoil";
  object.shape = io::PrimitiveShape{std::string(io::PolygonPrimitive::kModel.key),
                                    std::make_shared<const io::PolygonPrimitive>(subsoil)};
  object.material = scene.only("soil");
  scene.object(std::move(object));
}

}  // namespace ifov::landscape
