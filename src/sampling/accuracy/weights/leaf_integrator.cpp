#include "sampling/accuracy/weights/leaf_integrator.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/edge_cells.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/weights/cell_weights.h"
#include "sampling/accuracy/weights/polygon_fan.h"
#include "sampling/accuracy/weights/polygon_nodes.h"

namespace ifov::sampling {

namespace {

/// Triangles are this long at most: a table has eight cells over the finest structure that there is.
constexpr double kLongest_cells = 4.0;

}  // namespace

struct LeafIntegrator::Shared {
  Shared(const ColumnFootprints& footprints, int cells_per_pixel) {
    if (!footprints.by_column()) weights.emplace(footprints, cells_per_pixel);
    for (std::size_t group = 0; group < footprints.groups(); ++group) {
      const double limit = kLongest_cells * footprints.footprint(group).cell_px();
      const auto at = std::find(longest.begin(), longest.end(), limit);
      rule_of.push_back(static_cast<std::size_t>(at - longest.begin()));
      if (at == longest.end()) longest.push_back(limit);
    }
    for (std::vector<Placed>& of_polygon : placed) of_polygon.resize(longest.size());
  }

  struct Placed {
    PolygonNodes nodes;
    bool ready = false;
  };
  std::optional<CellWeights> weights;  // of footprints that lie alike in all columns of the image
  std::vector<double> longest;         // of triangles, by rule
  std::vector<std::size_t> rule_of;    // by group
  std::vector<Placed> placed[3];       // of up to three polygons at a time, by rule
};

LeafIntegrator::LeafIntegrator(const EdgeTracer& tracer, const ColumnFootprints& footprints, PixelRect tile)
    : tree_(tracer.tree()),
      edge_cells_(tracer.edge_cells()),
      model_(tracer.model()),
      lattice_(tracer.lattice()),
      footprints_(footprints),
      tile_(tile),
      unit_box_(footprints.whole_pixel()) {
  // Added up as for any other pixel, so that it makes no difference which way a pixel went.
  const double side = lattice_.side_px(0);
  for (int i = 0; i < lattice_.cells_per_pixel() * lattice_.cells_per_pixel(); ++i)
    plain_weight_ += side * side;
  if (footprints.groups() > 1) shared_ = std::make_unique<Shared>(footprints, lattice_.cells_per_pixel());
}

LeafIntegrator::~LeafIntegrator() = default;

bool LeafIntegrator::plain(int source, int& output, std::uint32_t& label, double& weight) const {
  if (!unit_box_ || edge_cells_.crossed(static_cast<std::uint32_t>(source))) return false;
  const PixelRect& domain = lattice_.domain();
  const int x = domain.x0 + source % domain.width(), y = domain.y0 + source / domain.width();
  if (x < tile_.x0 || x >= tile_.x1 || y < tile_.y0 || y >= tile_.y1) return false;
  output = (y - tile_.y0) * tile_.width() + x - tile_.x0;
  label = tree_[lattice_.first_cell(source)].corner[0];
  weight = plain_weight_;
  return true;
}

/// The leaves of a pixel in the order of their making, in leaves_.
void LeafIntegrator::leaves_of(int source) const {
  const int k = lattice_.cells_per_pixel(), columns = lattice_.columns();
  const std::uint32_t first = lattice_.first_cell(source);
  leaves_.clear();
  std::size_t split = 0;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) {
      leaves_.push_back(first + static_cast<std::uint32_t>(j * columns + i));
      split += tree_[leaves_.back()].kind == CellKind::split;
    }
  if (split == 0) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const Cell& cell = tree_[leaves_[i]];
    if (cell.kind == CellKind::split)
      for (std::uint32_t child = 0; child < 4; ++child) leaves_.push_back(cell.children + child);
    else
      leaves_[kept++] = leaves_[i];
  }
  leaves_.resize(kept);
  std::sort(leaves_.begin(), leaves_.end());
}

Point2 LeafIntegrator::centre(int output, std::size_t group) const {
  const Point2 shift = footprints_.shift_px(group, tile_.x0 + output % tile_.width());
  return {tile_.x0 + output % tile_.width() + 0.5 + shift.x,
          tile_.y0 + output / tile_.width() + 0.5 + shift.y};
}

void LeafIntegrator::outputs_of(int source, PixelModel& model) const {
  const PixelRect& domain = lattice_.domain();
  const int x = domain.x0 + source % domain.width(), y = domain.y0 + source / domain.width();
  const int reach = footprints_.reach();
  model.groups = footprints_.groups();
  model.outputs.clear();
  slots_.clear();
  for (int j = std::max(tile_.y0, y - reach); j <= std::min(tile_.y1 - 1, y + reach); ++j)
    for (int i = std::max(tile_.x0, x - reach); i <= std::min(tile_.x1 - 1, x + reach); ++i) {
      const int output = (j - tile_.y0) * tile_.width() + i - tile_.x0;
      for (std::size_t group = 0; group < model.groups; ++group)
        if (footprints_.reaches(group, i, x - i, y - j))
          slots_.push_back({model.slots() + group, group, centre(output, group),
                            (i - domain.x0) * lattice_.cells_per_pixel(),
                            (j - domain.y0) * lattice_.cells_per_pixel()});
      model.outputs.push_back(output);
    }
}

double LeafIntegrator::whole_weight(int source, int output, std::size_t group) const {
  const PixelRect& domain = lattice_.domain();
  if (shared_ && shared_->weights)
    return shared_->weights->of_pixel(
        group, domain.x0 + source % domain.width() - tile_.x0 - output % tile_.width(),
        domain.y0 + source / domain.width() - tile_.y0 - output / tile_.width());
  const Point2 c = centre(output, group);
  const double x = domain.x0 + source % domain.width() - c.x, y = domain.y0 + source / domain.width() - c.y;
  return footprint(group).integral(x, y, x + 1.0, y + 1.0);
}

double LeafIntegrator::over_polygon(const Polygon& polygon, const Slot& slot) const {
  const PixelFootprint& footprint_of_slot = footprint(slot.group);
  const Point2 c = slot.centre;
  if (footprint_of_slot.uniform()) {
    const double h = footprint_of_slot.half_width_px();
    const Polygon inside = polygon.clipped(-1.0, 0.0, -(c.x - h))
                               .clipped(1.0, 0.0, c.x + h)
                               .clipped(0.0, -1.0, -(c.y - h))
                               .clipped(0.0, 1.0, c.y + h);
    return inside.signed_area() * 0.25 / (h * h);
  }
  if (!footprint_of_slot.pieces().empty()) {
    const double h = footprint_of_slot.half_width_across_px();
    const bool turned = footprint_of_slot.along_x();
    const double across = turned ? c.y : c.x, along = turned ? c.x : c.y;
    const auto place = [&](Point2 p) { return (turned ? p.x : p.y) - along; };
    // What lies above a line (sign -1) or below it, across the pieces or along them.
    const auto cut = [&](const Polygon& of, bool along_pieces, double sign, double at) {
      const bool x = along_pieces == turned;
      return of.clipped(x ? sign : 0.0, x ? 0.0 : sign, sign * at);
    };
    const Polygon inside = cut(cut(polygon, false, -1.0, across - h), false, 1.0, across + h);
    double low = INFINITY, high = -INFINITY, sum = 0.0;
    for (int i = 0; i < inside.count; ++i)
      low = std::min(low, place(inside.vertex[i])), high = std::max(high, place(inside.vertex[i]));
    for (const PixelFootprint::Piece& piece : footprint_of_slot.pieces()) {
      if (!(piece.y0 < high) || !(piece.y1 > low)) continue;
      const Polygon strip = cut(cut(inside, true, -1.0, along + piece.y0), true, 1.0, along + piece.y1);
      sum += over_fan(strip, [&](Point2 m) { return piece.at(place(m)); });
    }
    return 0.5 * sum / h;
  }
  return over_fan(
      polygon, [&](Point2 m) { return footprint_of_slot.density(m.x - c.x, m.y - c.y); },
      kLongest_cells * footprint_of_slot.cell_px());
}

/// Footprints are integrated over a polygon that others look at, too: `which` of up to three.
void LeafIntegrator::begin_polygon(std::size_t which) const {
  if (!shared_) return;
  for (Shared::Placed& placed : shared_->placed[which]) placed.ready = false;
}

/// As over_polygon(); where there are several groups the rule's places are found once for all outputs.
double LeafIntegrator::over_shared(const Polygon& polygon, std::size_t which, const Slot& slot) const {
  if (!shared_ || footprint(slot.group).cell_px() == 0.0) return over_polygon(polygon, slot);
  const std::size_t rule = shared_->rule_of[slot.group];
  Shared::Placed& placed = shared_->placed[which][rule];
  if (!placed.ready) placed.nodes.place(polygon, shared_->longest[rule]);
  placed.ready = true;
  return placed.nodes.over(footprint(slot.group), slot.centre);
}

/// Integral of an output's footprint over a cell.
double LeafIntegrator::cell_weight(const Cell& cell, const Slot& slot) const {
  const double side = lattice_.side_px(cell.level);
  if (unit_box_) return side * side;
  if (shared_ && shared_->weights && cell.level == 0)
    return shared_->weights->of_cell(slot.group, (cell.x >> kMaxLevel) - slot.column,
                                     (cell.y >> kMaxLevel) - slot.row);
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y);
  const Point2 c = slot.centre;
  return footprint(slot.group).integral(x0 - c.x, y0 - c.y, x0 + side - c.x, y0 + side - c.y);
}

void LeafIntegrator::pixel(int source, PixelModel& model) const {
  outputs_of(source, model);
  model.forget_parts();
  leaves_of(source);
  for (const std::uint32_t leaf : leaves_) {
    const Cell& cell = tree_[leaf];
    if (cell.kind == CellKind::uniform)
      add_uniform(cell, model);
    else if (cell.kind == CellKind::complex)
      add_complex(cell, model);
    else if (cell.kind == CellKind::junction)
      add_junction(cell, model);
    else
      add_curve(cell, model);
  }
}

void LeafIntegrator::add_uniform(const Cell& cell, PixelModel& model) const {
  const std::size_t region = model.add_region(cell.corner[0]), slots = model.slots();
  const double side = lattice_.side_px(cell.level);
  model.area[region] += side * side;
  for (const Slot& slot : slots_) model.weight[region * slots + slot.at] += cell_weight(cell, slot);
}

void LeafIntegrator::add_complex(const Cell& cell, PixelModel& model) const {
  const auto [low, high] = std::minmax_element(cell.corner, cell.corner + 4);
  std::size_t entry = 0;
  if (has_two_labels(cell)) {
    entry = model.add_loose_pair(*low, *high);
  } else {
    PixelModel::Loose alone{{}, false};
    std::copy_n(cell.corner, 4, alone.corner);
    entry = model.add_loose(alone);
  }
  std::size_t region[4];
  for (int i = 0; i < 4; ++i) region[i] = model.add_region(cell.corner[i]);
  const std::size_t slots = model.slots();
  for (const Slot& slot : slots_) {
    const double w = cell_weight(cell, slot);
    model.loose_weight[entry * slots + slot.at] += w;
    for (const std::size_t r : region) model.weight[r * slots + slot.at] += 0.25 * w;
  }
  const double side = lattice_.side_px(cell.level);
  for (const std::size_t r : region) model.area[r] += 0.25 * (side * side);
}

void LeafIntegrator::add_junction(const Cell& cell, PixelModel& model) const {
  const Junction& junction = model_.junction_of(cell);
  std::size_t region[3], border[3];
  Polygon polygon[3];
  double area[3], variance[3];
  for (int s = 0; s < 3; ++s) {
    region[s] = model.add_region(junction.sector[s]);
    border[s] = model.add_border(junction.sector[(s + 2) % 3], junction.sector[s]);
    polygon[s] = model_.sector_region(cell, s);
    area[s] = std::abs(polygon[s].signed_area());
    variance[s] = model_.border_variance(cell, s);
    model.area[region[s]] += area[s];
    begin_polygon(static_cast<std::size_t>(s));
  }
  const std::size_t slots = model.slots();
  for (const Slot& slot : slots_) {
    const double weight = cell_weight(cell, slot);
    if (shared_ && weight == 0.0) continue;
    const double at_point = unit_box_ ? 1.0 : density(junction.at, slot);
    double inside[3], sum = 0.0;
    for (int s = 0; s < 3; ++s)
      sum += inside[s] =
          unit_box_ ? area[s] : std::abs(over_shared(polygon[s], static_cast<std::size_t>(s), slot));
    const double scale = sum > 0.0 ? weight / sum : 0.0;
    for (int s = 0; s < 3; ++s) {
      model.weight[region[s] * slots + slot.at] += scale * inside[s];
      model.border_variance[border[s] * slots + slot.at] += variance[s] * at_point * at_point;
    }
  }
}

void LeafIntegrator::add_curve(const Cell& cell, PixelModel& model) const {
  const Curve& curve = model_.curve_of(cell);
  const std::size_t in = model.add_region(curve.inner), out = model.add_region(curve.outer);
  const std::size_t border = model.add_border(curve.inner, curve.outer), slots = model.slots();
  const CurveShape shape = model_.shape_of(cell);
  const Polygon polygon = model_.inner_region(cell, shape);
  const double side = lattice_.side_px(cell.level), whole = side * side;
  const double beyond = model_.area_beyond(cell, shape);
  // An arc beside a side of its cell may bulge beyond it: less than nothing, or more than the whole cell, is then its share.
  const double area = polygon.signed_area() + beyond;
  const double variance = model_.area_variance(cell, shape);
  const Point2 middle = 0.5 * (polygon.vertex[0] + polygon.vertex[curve.side[1] - curve.side[0] + 1]);
  model.area[in] += area;
  model.area[out] += whole - area;
  // Of the smaller part: what the rule is off by over the larger may be as much as the smaller is.
  const bool outside = area > 0.5 * whole;
  const Polygon part = outside ? model_.outer_region(cell, shape) : polygon;
  const Point2 centroid = unit_box_ ? middle : centroid_of(part);
  const double part_area = part.signed_area();
  begin_polygon(0);
  for (const Slot& slot : slots_) {
    const double weight = cell_weight(cell, slot);
    if (shared_ && weight == 0.0) continue;
    double inner = area, at_middle = 1.0;
    if (!unit_box_) {
      // Where the footprint is straight over the cell one place says it all.
      const bool straight = side <= footprint(slot.group).cell_px();
      at_middle = density(straight ? centroid : middle, slot);
      const double over_part = straight ? part_area * at_middle : over_shared(part, 0, slot);
      inner = (outside ? weight - over_part : over_part) + beyond * at_middle;
    }
    model.weight[in * slots + slot.at] += inner;
    model.weight[out * slots + slot.at] += weight - inner;
    model.border_variance[border * slots + slot.at] += variance * at_middle * at_middle;
    if (curve.loose_area > 0.0)
      model.loose_weight[model.add_loose_pair(curve.inner, curve.outer) * slots + slot.at] +=
          std::sqrt(12.0) * curve.loose_area * at_middle;
  }
}

}  // namespace ifov::sampling
