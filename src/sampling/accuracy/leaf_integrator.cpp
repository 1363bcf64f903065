#include "sampling/accuracy/leaf_integrator.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

std::uint32_t PixelModel::region_of(std::uint32_t label) const {
  const auto found = std::find(labels.begin(), labels.end(), label);
  return static_cast<std::uint32_t>(found - labels.begin());
}

LeafIntegrator::LeafIntegrator(const EdgeTracer& tracer, const PixelFootprint& footprint, PixelRect tile)
    : tracer_(tracer),
      footprint_(footprint),
      tile_(tile),
      unit_box_(footprint.uniform() && footprint.half_width_px() == 0.5) {
  // Added up as for any other pixel, so that it makes no difference which way a pixel went.
  const double side = tracer.lattice().side_px(0);
  for (int i = 0; i < tracer.lattice().cells_per_pixel() * tracer.lattice().cells_per_pixel(); ++i)
    plain_weight_ += side * side;
}

bool LeafIntegrator::plain(int source, int& output, std::uint32_t& label, double& weight) const {
  if (!unit_box_ || tracer_.crossed(static_cast<std::uint32_t>(source))) return false;
  const PixelRect& domain = tracer_.lattice().domain();
  const int x = domain.x0 + source % domain.width(), y = domain.y0 + source / domain.width();
  if (x < tile_.x0 || x >= tile_.x1 || y < tile_.y0 || y >= tile_.y1) return false;
  output = (y - tile_.y0) * tile_.width() + x - tile_.x0;
  label = tracer_.cells()[tracer_.root_cell(source)].corner[0];
  weight = plain_weight_;
  return true;
}

/// The leaves of a pixel in the order of their making, in leaves_.
void LeafIntegrator::leaves_of(int source) const {
  const std::vector<Cell>& cells = tracer_.cells();
  const int k = tracer_.lattice().cells_per_pixel(), columns = tracer_.lattice().columns();
  const std::uint32_t first = tracer_.root_cell(source);
  leaves_.clear();
  std::size_t split = 0;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) {
      leaves_.push_back(first + static_cast<std::uint32_t>(j * columns + i));
      split += cells[leaves_.back()].kind == CellKind::split;
    }
  if (split == 0) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const Cell& cell = cells[leaves_[i]];
    if (cell.kind == CellKind::split)
      for (std::uint32_t child = 0; child < 4; ++child) leaves_.push_back(cell.children + child);
    else
      leaves_[kept++] = leaves_[i];
  }
  leaves_.resize(kept);
  std::sort(leaves_.begin(), leaves_.end());
}

Point2 LeafIntegrator::centre(int output) const {
  return {tile_.x0 + output % tile_.width() + 0.5, tile_.y0 + output / tile_.width() + 0.5};
}

void LeafIntegrator::outputs_of(int source, SmallVector<int, 1>& outputs) const {
  const PixelRect& domain = tracer_.lattice().domain();
  const int x = domain.x0 + source % domain.width(), y = domain.y0 + source / domain.width();
  const int reach = std::max(0, static_cast<int>(std::ceil(footprint_.half_width_px() - 0.5 - 1e-12)));
  outputs.clear();
  for (int j = std::max(tile_.y0, y - reach); j <= std::min(tile_.y1 - 1, y + reach); ++j)
    for (int i = std::max(tile_.x0, x - reach); i <= std::min(tile_.x1 - 1, x + reach); ++i)
      outputs.push_back((j - tile_.y0) * tile_.width() + i - tile_.x0);
}

double LeafIntegrator::whole_weight(int source, int output) const {
  const PixelRect& domain = tracer_.lattice().domain();
  const Point2 c = centre(output);
  const double x = domain.x0 + source % domain.width() - c.x, y = domain.y0 + source / domain.width() - c.y;
  return footprint_.integral(x, y, x + 1.0, y + 1.0);
}

double LeafIntegrator::over_polygon(const Polygon& polygon, Point2 c) const {
  if (footprint_.uniform()) {
    const double h = footprint_.half_width_px();
    const Polygon inside = polygon.clipped(-1.0, 0.0, -(c.x - h))
                               .clipped(1.0, 0.0, c.x + h)
                               .clipped(0.0, -1.0, -(c.y - h))
                               .clipped(0.0, 1.0, c.y + h);
    return std::abs(inside.signed_area()) * 0.25 / (h * h);
  }
  // A fan of triangles, each by the rule of its three edge midpoints, exact to the second degree.
  double sum = 0.0;
  const Point2 o = polygon.vertex[0];
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Point2 p = polygon.vertex[i], q = polygon.vertex[i + 1];
    const double twice_area = cross(p - o, q - o);
    double h = 0.0;
    for (const Point2 m : {0.5 * (o + p), 0.5 * (p + q), 0.5 * (q + o)})
      h += footprint_.density(m.x - c.x, m.y - c.y);
    sum += twice_area * h;
  }
  return std::abs(sum) / 6.0;
}

namespace {

/// What no model follows between the same two labels (a strip too thin for the cells, say) is the same all
/// along, so that such errors add up: one entry. Where three labels meet, each cell errs for itself.
std::size_t loose_pair(PixelModel& model, std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  for (std::size_t i = 0; i < model.loose.size(); ++i) {
    const PixelModel::Loose& entry = model.loose[i];
    if (entry.two_labels && entry.corner[0] == a && entry.corner[3] == b) return i;
  }
  model.loose.push_back({{a, a, b, b}, true, 0, 0});
  return model.loose.size() - 1;
}

std::size_t loose_cell(PixelModel& model, const Cell& cell) {
  const auto [low, high] = std::minmax_element(cell.corner, cell.corner + 4);
  if (has_two_labels(cell)) return loose_pair(model, *low, *high);
  for (std::size_t i = 0; i < model.loose.size(); ++i) {
    const PixelModel::Loose& entry = model.loose[i];
    if (!entry.two_labels && entry.x == cell.x && entry.y == cell.y) return i;
  }
  PixelModel::Loose entry{{}, false, cell.x, cell.y};
  std::copy_n(cell.corner, 4, entry.corner);
  model.loose.push_back(entry);
  return model.loose.size() - 1;
}

}  // namespace

void LeafIntegrator::pixel(int source, PixelModel& model) const {
  outputs_of(source, model.outputs);
  const std::size_t outputs = model.outputs.size();
  model.labels.clear();
  model.area.clear();
  model.borders.clear();
  model.loose.clear();
  leaves_of(source);
  const auto begin = leaves_.begin(), end = leaves_.end();
  const auto region = [&](std::uint32_t label) {
    const std::uint32_t r = model.region_of(label);
    if (r == model.labels.size()) {
      model.labels.push_back(label);
      model.area.push_back(0.0);
    }
    return r;
  };
  const auto pair = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    for (std::size_t i = 0; i < model.borders.size(); ++i)
      if (model.borders[i].inner == a && model.borders[i].outer == b) return i;
    model.borders.push_back({a, b});
    return model.borders.size() - 1;
  };
  for (auto leaf = begin; leaf != end; ++leaf) {
    const Cell& cell = tracer_.cells()[*leaf];
    if (cell.kind == CellKind::uniform) {
      region(cell.corner[0]);
    } else if (cell.kind == CellKind::complex) {
      loose_cell(model, cell);
      for (std::uint32_t l : cell.corner) region(l);
    } else if (cell.kind == CellKind::junction) {
      const Junction& junction = tracer_.junction_of(cell);
      for (int s = 0; s < 3; ++s) {
        region(junction.sector[s]);
        pair(junction.sector[(s + 2) % 3], junction.sector[s]);
      }
    } else {
      const Curve& curve = tracer_.curve_of(cell);
      region(curve.inner);
      region(curve.outer);
      pair(curve.inner, curve.outer);
      if (curve.loose_area > 0.0) loose_pair(model, curve.inner, curve.outer);
    }
  }
  const std::size_t regions = model.labels.size(), pairs = model.borders.size(), loose = model.loose.size();
  model.weight.assign(outputs * regions, 0.0);
  model.border_variance.assign(outputs * pairs, 0.0);
  model.loose_weight.assign(outputs * loose, 0.0);

  const Lattice& lattice = tracer_.lattice();
  for (auto leaf = begin; leaf != end; ++leaf) {
    const Cell& cell = tracer_.cells()[*leaf];
    const double x0 = lattice.x_px(cell.x), y0 = lattice.y_px(cell.y), side = lattice.side_px(cell.level);
    const double cell_area = side * side;
    const auto cell_weight = [&](std::size_t o) {
      if (unit_box_) return cell_area;
      const Point2 c = centre(model.outputs[o]);
      return footprint_.integral(x0 - c.x, y0 - c.y, x0 + side - c.x, y0 + side - c.y);
    };
    if (cell.kind == CellKind::uniform) {
      const std::uint32_t r = model.region_of(cell.corner[0]);
      model.area[r] += cell_area;
      for (std::size_t o = 0; o < outputs; ++o) model.weight[o * regions + r] += cell_weight(o);
      continue;
    }
    if (cell.kind == CellKind::complex) {
      const std::size_t entry = loose_cell(model, cell);
      for (std::size_t o = 0; o < outputs; ++o) {
        const double w = cell_weight(o);
        model.loose_weight[o * loose + entry] += w;
        for (std::uint32_t l : cell.corner) model.weight[o * regions + model.region_of(l)] += 0.25 * w;
      }
      for (std::uint32_t l : cell.corner) model.area[model.region_of(l)] += 0.25 * cell_area;
      continue;
    }
    if (cell.kind == CellKind::junction) {
      const Junction& junction = tracer_.junction_of(cell);
      std::size_t r[3], b[3];
      Polygon polygon[3];
      double area[3], variance[3];
      for (int s = 0; s < 3; ++s) {
        r[s] = model.region_of(junction.sector[s]);
        b[s] = pair(junction.sector[(s + 2) % 3], junction.sector[s]);
        polygon[s] = tracer_.sector_region(cell, s);
        area[s] = std::abs(polygon[s].signed_area());
        variance[s] = tracer_.border_variance(cell, s);
        model.area[r[s]] += area[s];
      }
      for (std::size_t o = 0; o < outputs; ++o) {
        const Point2 c = centre(model.outputs[o]);
        const double density = unit_box_ ? 1.0 : footprint_.density(junction.at.x - c.x, junction.at.y - c.y);
        double inside[3], sum = 0.0;
        for (int s = 0; s < 3; ++s) sum += inside[s] = unit_box_ ? area[s] : over_polygon(polygon[s], c);
        const double scale = sum > 0.0 ? cell_weight(o) / sum : 0.0;
        for (int s = 0; s < 3; ++s) {
          model.weight[o * regions + r[s]] += scale * inside[s];
          model.border_variance[o * pairs + b[s]] += variance[s] * density * density;
        }
      }
      continue;
    }
    const Curve& curve = tracer_.curve_of(cell);
    const std::uint32_t in = model.region_of(curve.inner), out = model.region_of(curve.outer);
    const std::size_t b = pair(curve.inner, curve.outer);
    const Polygon polygon = tracer_.inner_region(cell);
    const double area = std::clamp(std::abs(polygon.signed_area()), 0.0, cell_area);
    const double variance = tracer_.area_variance(cell);
    const Point2 middle = 0.5 * (polygon.vertex[0] + polygon.vertex[curve.side[1] - curve.side[0] + 1]);
    model.area[in] += area;
    model.area[out] += cell_area - area;
    for (std::size_t o = 0; o < outputs; ++o) {
      const double whole = cell_weight(o);
      double inner = area, density = 1.0;
      if (!unit_box_) {
        const Point2 c = centre(model.outputs[o]);
        inner = std::min(over_polygon(polygon, c), whole);
        density = footprint_.density(middle.x - c.x, middle.y - c.y);
      }
      model.weight[o * regions + in] += inner;
      model.weight[o * regions + out] += whole - inner;
      model.border_variance[o * pairs + b] += variance * density * density;
      if (curve.loose_area > 0.0)
        model.loose_weight[o * loose + loose_pair(model, curve.inner, curve.outer)] +=
            std::sqrt(12.0) * curve.loose_area * density;
    }
  }
}

}  // namespace ifov::sampling
