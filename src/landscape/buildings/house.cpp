#include "landscape/buildings/house.h"

#include <array>

#include "landscape/buildings/house_parts.h"

namespace ifov::landscape {
namespace {

constexpr double kRoofThickness_m = 0.18;
constexpr double kPlinth_m = 0.25;

void main_walls(MeshBuilder& mesh, const HousePlan& plan, bool gabled) {
  // Walls end inside the roof's thickness, so that no light gets in between.
  const double x = 0.5 * plan.width, top = plan.wall_height - 0.5 * kRoofThickness_m;
  const double ridge = plan.ridge_height() - 0.5 * kRoofThickness_m, middle = 0.5 * plan.depth;
  mesh.slot("concrete");
  mesh.box({-x - 0.02, -0.02, 0.0}, {x + 0.02, plan.depth + 0.02, kPlinth_m});
  mesh.slot("wall");
  mesh.quad({-x, 0.0, 0.0}, {x, 0.0, 0.0}, {x, 0.0, top}, {-x, 0.0, top});
  mesh.quad({x, plan.depth, 0.0}, {-x, plan.depth, 0.0}, {-x, plan.depth, top}, {x, plan.depth, top});
  std::vector<Point3> end{{x, 0.0, 0.0}, {x, plan.depth, 0.0}, {x, plan.depth, top}};
  if (gabled) end.push_back({x, middle, ridge});
  end.push_back({x, 0.0, top});
  mesh.polygon(end);
  std::vector<Point3> other;
  for (std::size_t k = end.size(); k-- > 0;) other.push_back({-x, end[k].y, end[k].z});
  mesh.polygon(other);
}

void main_roof(MeshBuilder& mesh, const HousePlan& plan) {
  const bool hipped = plan.roof == RoofKind::hipped;
  const double x = 0.5 * plan.width + (hipped ? plan.eaves : 0.7 * plan.eaves);
  const double front = -plan.eaves, back = plan.depth + plan.eaves, middle = 0.5 * plan.depth;
  const double eave = plan.wall_height - plan.slope * plan.eaves, ridge = plan.ridge_height();
  const double end = hipped ? x - (middle - front) : x;
  std::vector<std::vector<Point3>> faces{
      {{-x, front, eave}, {x, front, eave}, {end, middle, ridge}, {-end, middle, ridge}},
      {{x, back, eave}, {-x, back, eave}, {-end, middle, ridge}, {end, middle, ridge}}};
  if (hipped) {
    faces.push_back({{x, front, eave}, {x, back, eave}, {end, middle, ridge}});
    faces.push_back({{-x, back, eave}, {-x, front, eave}, {-end, middle, ridge}});
  }
  mesh.slot("roof");
  mesh.slab(faces, kRoofThickness_m);
}

/// The garage's roof meets the main roof in valleys where their eaves are level, and the front wall where the
/// house is higher.
void garage_roof(MeshBuilder& mesh, const HousePlan& plan, double wall_top) {
  const double left = plan.garage_middle() - 0.5 * plan.garage_width - plan.eaves;
  const double right = plan.garage_middle() + 0.5 * plan.garage_width + plan.eaves;
  const double middle = plan.garage_middle(), half = middle - left;
  const bool hipped = plan.roof == RoofKind::hipped;
  const double front = -plan.garage_depth - (hipped ? plan.eaves : 0.7 * plan.eaves);
  const bool level = wall_top == plan.wall_height;
  const double eave = wall_top - plan.slope * plan.eaves, ridge = eave + plan.slope * half;
  const double eave_end = level ? -plan.eaves : 0.05, ridge_end = level ? -plan.eaves + half : 0.05;
  const double ridge_start = hipped ? front + half : front;
  std::vector<std::vector<Point3>> faces{
      {{left, front, eave}, {middle, ridge_start, ridge}, {middle, ridge_end, ridge}, {left, eave_end, eave}},
      {{right, eave_end, eave},
       {middle, ridge_end, ridge},
       {middle, ridge_start, ridge},
       {right, front, eave}}};
  if (hipped) faces.push_back({{left, front, eave}, {right, front, eave}, {middle, ridge_start, ridge}});
  mesh.slot("roof");
  mesh.slab(faces, kRoofThickness_m);
}

void garage(MeshBuilder& mesh, const HousePlan& plan) {
  const double wall_top = plan.wall_height < 3.5 ? plan.wall_height : HousePlan::garage_wall_height;
  const double left = plan.garage_middle() - 0.5 * plan.garage_width, right = left + plan.garage_width;
  const double front = -plan.garage_depth, top = wall_top - 0.5 * kRoofThickness_m, inside = 0.1;
  const double ridge = wall_top + plan.slope * 0.5 * plan.garage_width - 0.5 * kRoofThickness_m;
  mesh.slot("wall");
  mesh.quad({left, inside, 0.0}, {left, front, 0.0}, {left, front, top}, {left, inside, top});
  mesh.quad({right, front, 0.0}, {right, inside, 0.0}, {right, inside, top}, {right, front, top});
  std::vector<Point3> face{{left, front, 0.0}, {right, front, 0.0}, {right, front, top}};
  if (plan.roof == RoofKind::gabled) face.push_back({plan.garage_middle(), front, ridge});
  face.push_back({left, front, top});
  mesh.polygon(face);
  garage_roof(mesh, plan, wall_top);
  garage_door(mesh, {plan.garage_middle(), front, 0.0}, std::min(4.9, plan.garage_width - 0.9), 2.15);
}

void openings(MeshBuilder& mesh, const HousePlan& plan) {
  const bool two_storeys = plan.wall_height > 4.5;
  const double half = 0.5 * plan.width;
  const double free_low = plan.garage_side > 0 ? -half : -half + plan.garage_width;
  const double free_high = plan.garage_side > 0 ? half - plan.garage_width : half;
  front_door(mesh, {plan.door_x, 0.0, kPlinth_m});
  const Facing front{{0.0, -1.0, 0.0}}, back{{0.0, 1.0, 0.0}}, east{{1.0, 0.0, 0.0}}, west{{-1.0, 0.0, 0.0}};
  for (const double x : {free_low + 1.3, free_high - 1.3})
    if (std::abs(x - plan.door_x) > 1.6) window(mesh, {x, 0.0, 1.0}, front, 1.5, 1.3);
  for (int k = 0; k < 3; ++k)
    window(mesh, {-half + plan.width * (k + 0.5) / 3.0, plan.depth, k == 1 ? 0.35 : 1.0}, back,
           k == 1 ? 2.4 : 1.5, k == 1 ? 2.0 : 1.3);
  for (const double y : {0.28 * plan.depth, 0.72 * plan.depth}) {
    window(mesh, {half, y, 1.0}, east, 1.1, 1.3);
    window(mesh, {-half, y, 1.0}, west, 1.1, 1.3);
  }
  if (!two_storeys) return;
  for (int k = 0; k < 4; ++k) {
    const double x = -half + plan.width * (k + 0.5) / 4.0;
    // Over the garage its roof stands before the wall.
    const double above = x > free_low && x < free_high ? 3.7 : 4.1;
    if (above < 4.0) window(mesh, {x, 0.0, above}, front, 1.1, 1.2);
    window(mesh, {x, plan.depth, 3.7}, back, 1.1, 1.2);
  }
}

}  // namespace

Footprint HousePlan::footprint(const Stand& stand) const {
  return {stand, -0.5 * width - eaves, 0.5 * width + eaves, -garage_depth - eaves, depth + eaves};
}

HousePlan draw_house(const RandomStream& random) {
  HousePlan plan;
  plan.roof = random.happens(0.45, 0) ? RoofKind::hipped : RoofKind::gabled;
  const bool two_storeys = random.happens(0.3, 1);
  plan.width = two_storeys ? random.between(11.0, 13.0, 2) : random.between(12.5, 15.5, 2);
  plan.depth = two_storeys ? random.between(7.5, 9.0, 3) : random.between(8.5, 10.5, 3);
  plan.wall_height = two_storeys ? random.between(5.2, 5.6, 4) : random.between(2.6, 2.9, 4);
  plan.slope = std::tan(random.between(22.0, 38.0, 5) * M_PI / 180.0);
  plan.eaves = random.between(0.4, 0.65, 6);
  plan.garage_side = random.happens(0.5, 7) ? 1 : -1;
  plan.garage_width = random.between(5.6, 6.4, 8);
  plan.garage_depth = random.between(3.0, 5.5, 9);
  // The roof of the garage stays below the windows over it, and below the main ridge.
  if (two_storeys) plan.slope = std::min(plan.slope, 0.55);
  const double free_middle = -plan.garage_side * 0.5 * plan.garage_width;
  plan.door_x = free_middle + plan.garage_side * (0.5 * (plan.width - plan.garage_width) - 1.2);
  plan.chimney = random.happens(0.7, 10);
  plan.chimney_x = -plan.garage_side * random.between(0.0, 0.12, 11) * plan.width;
  return plan;
}

geometry::TriangleMesh house_mesh(const HousePlan& plan) {
  MeshBuilder mesh;
  main_walls(mesh, plan, plan.roof == RoofKind::gabled);
  main_roof(mesh, plan);
  garage(mesh, plan);
  openings(mesh, plan);
  if (plan.chimney) {
    const double y = 0.5 * plan.depth + 1.1;
    chimney(mesh, {plan.chimney_x, y, plan.wall_height}, plan.ridge_height() + 0.7);
  }
  return mesh.take();
}

}  // namespace ifov::landscape
