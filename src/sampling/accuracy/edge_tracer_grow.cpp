#include <cmath>
#include <limits>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed standard error that one unresolved cell may claim at first.
constexpr double kLooseCell = 0.3;
/// The same in narrow features, whose cells err alike.
constexpr double kLooseNarrowCell = 0.05;
/// Brackets are refined to this share of the distance to the vertex inside a narrow feature.
constexpr double kThinShare = 0.5;
/// First width of a bracket, in units of what the tolerance allows to a crossing of one side of its cell.
constexpr double kFirstWidth = 1.6;
/// Standard deviation of a fraction that may be anything: 1 / sqrt(12).
constexpr double kUniformSpread = 0.28867513459481287;

constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};
/// From a side's middle to a fine position in the cell beyond.
constexpr int kBeyondX[4] = {0, 0, 0, -1}, kBeyondY[4] = {-1, 0, 0, 0};

}  // namespace

EdgeTracer::EdgeTracer(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
                       const AccuracyOptions& options, const AccuracyFaults& faults, std::uint64_t seed)
    : lattice_(lattice),
      ledger_(ledger),
      table_(table),
      contrast_(contrast),
      options_(options),
      faults_(faults),
      seed_(seed),
      allowed_variance_(static_cast<std::size_t>(lattice.domain().count()), 1.0),
      budget_(allowed_variance_.size(), options.tracing_budget),
      abandoned_(allowed_variance_.size(), 0),
      suspect_(allowed_variance_.size(), 0),
      stirred_(allowed_variance_.size(), 1),
      sharpened_for_(allowed_variance_.size(), 0.0) {}

void EdgeTracer::plant(std::span<const std::uint32_t> vertex_labels) {
  root_vertices_.assign(vertex_labels.begin(), vertex_labels.end());
  for (int j = 0; j < lattice_.rows(); ++j)
    for (int i = 0; i < lattice_.columns(); ++i) push_cell(i * Lattice::side(0), j * Lattice::side(0), 0);
}

void EdgeTracer::ask(std::vector<std::uint32_t>& labels, Purpose purpose) {
  first_seen_point_.resize(table_.size());
  ledger_.labels(points_, labels, purpose);
  for (std::size_t i = 0; i < labels.size() && first_seen_point_.size() < table_.size(); ++i)
    if (labels[i] == first_seen_point_.size()) first_seen_point_.push_back(points_[i]);
  points_.clear();
  value_new_labels();
}

void EdgeTracer::value_new_labels() {
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t l = 0; l < table_.size(); ++l)
    if (table_.count(l) == 0 && table_.merged(l) == l) {
      requests.push_back({first_seen_point_[l], hash(seed_, table_.label(l), 0x6e6577), 0});
      wanted.push_back(l);
    }
  if (requests.empty()) return;
  std::vector<std::uint32_t> labels;
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  std::vector<float> values(requests.size() * stride);
  ledger_.values(requests, labels, values);
  for (std::size_t i = 0; i < wanted.size(); ++i) table_.add(wanted[i], &values[i * stride]);
  first_seen_point_.resize(table_.size(), requests.back().point);
}

std::uint32_t EdgeTracer::push_cell(std::int32_t x, std::int32_t y, int level) {
  Cell cell;
  cell.x = x;
  cell.y = y;
  cell.level = static_cast<std::uint8_t>(level);
  cell.pixel = static_cast<std::uint32_t>(lattice_.pixel_of_cell(x, y));
  cells_.push_back(cell);
  const std::uint32_t index = static_cast<std::uint32_t>(cells_.size() - 1);
  new_cells_.push_back(index);
  return index;
}

std::uint32_t EdgeTracer::find_leaf(std::int32_t x, std::int32_t y) const {
  std::uint32_t cell =
      static_cast<std::uint32_t>((y / Lattice::side(0)) * lattice_.columns() + x / Lattice::side(0));
  while (cells_[cell].kind == CellKind::split) {
    const Cell& c = cells_[cell];
    const std::int32_t half = Lattice::side(c.level + 1);
    cell = c.children + (x >= c.x + half) + 2 * (y >= c.y + half);
  }
  return cell;
}

std::uint32_t EdgeTracer::vertex(std::int32_t x, std::int32_t y) {
  constexpr std::int32_t kRoot = Lattice::side(0);
  if (x % kRoot == 0 && y % kRoot == 0) return known_vertex(x, y);
  const std::uint32_t fresh = static_cast<std::uint32_t>(fine_vertices_.size());
  const std::uint32_t index = vertex_index_.find_or_insert(Lattice::vertex_key(x, y), fresh);
  if (index == fresh) {
    fine_vertices_.push_back(kNoLabel);
    pending_points_.push_back(lattice_.point(x, y));
  }
  return fine_vertices_[index];
}

std::uint32_t EdgeTracer::known_vertex(std::int32_t x, std::int32_t y) const {
  constexpr std::int32_t kRoot = Lattice::side(0);
  if (x % kRoot == 0 && y % kRoot == 0)
    return root_vertices_[static_cast<std::size_t>(y / kRoot) * (lattice_.columns() + 1) + x / kRoot];
  return fine_vertices_[vertex_index_.find(Lattice::vertex_key(x, y))];
}

void EdgeTracer::trace_vertices() {
  if (pending_points_.empty()) return;
  const std::size_t first = fine_vertices_.size() - pending_points_.size();
  points_.swap(pending_points_);
  std::vector<std::uint32_t> labels;
  ask(labels);
  pending_points_.clear();
  std::copy(labels.begin(), labels.end(), fine_vertices_.begin() + first);
}

void EdgeTracer::split(std::uint32_t index) {
  const Cell parent = cells_[index];
  if (parent.kind == CellKind::split || parent.level == kMaxLevel) return;
  const std::int32_t half = Lattice::side(parent.level + 1);
  const std::uint32_t children = static_cast<std::uint32_t>(cells_.size());
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) push_cell(parent.x + i * half, parent.y + j * half, parent.level + 1);
  cells_[index].kind = CellKind::split;
  stirred_[cells_[index].pixel] = 1;
  cells_[index].children = children;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) vertex(parent.x + i * half, parent.y + j * half);
  split_cells_.push_back(index);
}

std::uint32_t EdgeTracer::leaf_at(FocalPoint point) const {
  const PixelRect& domain = lattice_.domain();
  const auto fine = [&](double at, int origin, std::int32_t limit) {
    return std::clamp(static_cast<std::int32_t>((at - origin) / lattice_.unit_px()), 0, limit - 1);
  };
  return find_leaf(fine(point.x_px, domain.x0, lattice_.width()), fine(point.y_px, domain.y0, lattice_.height()));
}

bool EdgeTracer::disagrees(FocalPoint point, std::uint32_t label, double slack_px) const {
  const Cell& cell = cells_[leaf_at(point)];
  const std::uint32_t model = model_label(point);
  if (model == kNoLabel) return foreign(cell, label);
  return model != label && !within_tolerance(cell, point, model, label, slack_px);
}

bool EdgeTracer::contradict(FocalPoint point, std::uint32_t label) {
  const std::uint32_t leaf = leaf_at(point);
  const Cell& cell = cells_[leaf];
  if (cell.level == kMaxLevel || abandoned_[cell.pixel] || !disagrees(point, label, 0.0)) return false;
  suspect_[cell.pixel] = 1;
  split(leaf);
  return true;
}

/// Whether a label that no corner of a complex cell has would matter in it.
bool EdgeTracer::foreign(const Cell& cell, std::uint32_t label) const {
  if (cell.kind != CellKind::complex) return false;
  double contrast = 0.0;
  for (std::uint32_t corner : cell.corner) {
    if (corner == label) return false;
    contrast = std::max(contrast, contrast_(cell.pixel, corner, label));
  }
  const double side_px = lattice_.side_px(cell.level);
  return kUniformSpread * side_px * side_px * contrast > kLooseCell * std::sqrt(allowed_variance_[cell.pixel]);
}

std::uint32_t EdgeTracer::model_label(FocalPoint point) const {
  const Cell& cell = cells_[leaf_at(point)];
  if (cell.kind == CellKind::uniform) return cell.corner[0];
  if (cell.kind == CellKind::complex || cell.kind == CellKind::fresh) return kNoLabel;
  const Curve& curve = curves_[cell.chord];
  return inner_region(cell).contains({point.x_px, point.y_px}) ? curve.inner : curve.outer;
}

void EdgeTracer::notice_hanging_nodes() {
  for (std::uint32_t index : split_cells_) {
    const Cell& cell = cells_[index];
    const std::int32_t side = Lattice::side(cell.level);
    for (int e = 0; e < 4; ++e) {
      const int f = (e + 1) % 4;
      const std::int32_t ax = cell.x + kCornerX[e] * side, ay = cell.y + kCornerY[e] * side;
      const std::int32_t bx = cell.x + kCornerX[f] * side, by = cell.y + kCornerY[f] * side;
      const std::int32_t mx = (ax + bx) / 2, my = (ay + by) / 2;
      const std::uint32_t a = known_vertex(ax, ay), b = known_vertex(bx, by), m = known_vertex(mx, my);
      if (a != b || m == a) continue;
      const std::int32_t ox = mx + kBeyondX[e], oy = my + kBeyondY[e];
      if (ox < 0 || oy < 0 || ox >= lattice_.width() || oy >= lattice_.height()) continue;
      suspect_[cell.pixel] = 1;
      hanging_.push_back({ox, oy, cell.level});
    }
  }
  split_cells_.clear();
}

void EdgeTracer::split_beside_hanging_nodes() {
  std::vector<HangingNode> left;
  for (const HangingNode& node : hanging_) {
    const std::uint32_t leaf = find_leaf(node.x, node.y);
    if (cells_[leaf].level > node.level || abandoned_[cells_[leaf].pixel]) continue;
    split(leaf);
    left.push_back(node);
  }
  hanging_.swap(left);
}

void EdgeTracer::grow() {
  std::vector<std::uint32_t> level, awaiting;
  while (!new_cells_.empty()) {
    give_up_clutter();
    trace_vertices();
    notice_hanging_nodes();
    split_beside_hanging_nodes();
    if (!pending_points_.empty() || !split_cells_.empty()) continue;

    level.clear();
    level.swap(new_cells_);
    awaiting.clear();
    const std::size_t first_bracket = brackets_.size();
    for (std::uint32_t cell : level)
      if (cells_[cell].kind == CellKind::fresh) classify(cell, awaiting);
    std::vector<std::uint32_t> fresh_brackets;
    for (std::size_t b = first_bracket; b < brackets_.size(); ++b)
      fresh_brackets.push_back(static_cast<std::uint32_t>(b));
    locate(fresh_brackets);
    for (std::uint32_t index : awaiting) {
      const Curve& curve = curves_[cells_[index].chord];
      if (brackets_[curve.bracket[0]].third_label || brackets_[curve.bracket[1]].third_label) {
        suspect_[cells_[index].pixel] = 1;
        settle_complex(index);
      } else {
        cells_[index].kind = CellKind::tentative;
        stirred_[cells_[index].pixel] = 1;
        tentative_.push_back(index);
      }
    }
  }
}

void EdgeTracer::classify(std::uint32_t index, std::vector<std::uint32_t>& awaiting) {
  Cell& cell = cells_[index];
  const std::int32_t side = Lattice::side(cell.level);
  for (int i = 0; i < 4; ++i)
    cell.corner[i] = known_vertex(cell.x + kCornerX[i] * side, cell.y + kCornerY[i] * side);
  int crossed[4], crossings = 0;
  bool two_labels = true;
  std::uint32_t other = cell.corner[0];
  for (int e = 0; e < 4; ++e) {
    if (cell.corner[e] != cell.corner[(e + 1) % 4]) crossed[crossings++] = e;
    if (cell.corner[e] != cell.corner[0]) {
      if (other != cell.corner[0] && other != cell.corner[e]) two_labels = false;
      other = cell.corner[e];
    }
  }
  if (crossings == 0) {
    cell.kind = CellKind::uniform;
    return;
  }
  edge_cells_.push_back(index);
  stirred_[cell.pixel] = 1;
  if (abandoned_[cell.pixel]) {
    cell.kind = CellKind::complex;
    return;
  }
  const double area = lattice_.side_px(cell.level) * lattice_.side_px(cell.level);
  const double error = kUniformSpread * area * contrast_.among(cell.pixel, cell.corner);
  const bool negligible = error < 0.1 * kLooseCell * std::sqrt(allowed_variance_[cell.pixel]);
  if (!two_labels || crossings != 2 || (negligible && !narrow_corner(cell))) {
    // Two things that look alike, met side by side: another may lie between them and show at no corner.
    if ((two_labels && crossings == 4) || (negligible && cell.level == 0)) suspect_[cell.pixel] = 1;
    settle_complex(index);
    return;
  }
  Curve curve;
  curve.cell = index;
  for (int t = 0; t < 2; ++t) curve.side[t] = static_cast<std::uint8_t>(crossed[t]);
  curve.inner = cell.corner[(crossed[0] + 1) % 4];
  curve.outer = cell.corner[crossed[0]];
  for (int t = 0; t < 2; ++t) {
    curve.bracket[t] = bracket_on(cell, crossed[t]);
    std::uint32_t* cells = brackets_[curve.bracket[t]].cells;
    const bool first_is_dead = cells[0] == 0 || cells_[cells[0] - 1].kind == CellKind::split;
    cells[first_is_dead ? 0 : 1] = index + 1;
  }
  cells_[index].chord = static_cast<std::uint32_t>(curves_.size());
  curves_.push_back(curve);
  awaiting.push_back(index);
}

void EdgeTracer::settle_complex(std::uint32_t index) {
  Cell& cell = cells_[index];
  const double side_px = lattice_.side_px(cell.level);
  const double error = kUniformSpread * side_px * side_px * contrast_.among(cell.pixel, cell.corner);
  const double allowed = std::sqrt(allowed_variance_[cell.pixel]);
  const bool must_follow = side_px > options_.thinnest_px && error > kLooseNarrowCell * allowed &&
                           has_two_labels(cell) && narrow_corner(cell);
  cell.kind = CellKind::complex;
  stirred_[cell.pixel] = 1;
  if (cell.level < kMaxLevel && !abandoned_[cell.pixel] && (must_follow || error > kLooseCell * allowed))
    split(index);
}

/// Whether some corner of the cell lies in a feature no wider than two cells: the next vertices of the same
/// spacing, on both sides along a lattice line, are known and unlike it.
bool EdgeTracer::narrow_corner(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    const auto unlike = [&](std::int32_t nx, std::int32_t ny) {
      if (nx < 0 || ny < 0 || nx > lattice_.width() || ny > lattice_.height()) return false;
      constexpr std::int32_t kRoot = Lattice::side(0);
      const bool root = nx % kRoot == 0 && ny % kRoot == 0;
      if (!root && vertex_index_.find(Lattice::vertex_key(nx, ny)) == FlatMap::kAbsent) return false;
      return known_vertex(nx, ny) != cell.corner[i];
    };
    if ((unlike(x - side, y) && unlike(x + side, y)) || (unlike(x, y - side) && unlike(x, y + side)))
      return true;
  }
  return false;
}

std::uint32_t EdgeTracer::bracket_on(const Cell& cell, int side_index) {
  const std::int32_t side = Lattice::side(cell.level);
  const bool vertical = side_index % 2 == 1;
  const std::int32_t x = cell.x + (side_index == 1 ? side : 0), y = cell.y + (side_index == 2 ? side : 0);
  const std::uint32_t fresh = static_cast<std::uint32_t>(brackets_.size());
  const std::uint32_t index =
      bracket_index_.find_or_insert(Lattice::edge_key(x, y, vertical, cell.level), fresh);
  if (index != fresh) return index;

  Bracket b;
  b.x = x;
  b.y = y;
  b.vertical = vertical;
  b.level = cell.level;
  b.length_px = lattice_.side_px(cell.level);
  b.first = known_vertex(x, y);
  b.last = vertical ? known_vertex(x, y + side) : known_vertex(x + side, y);
  const std::uint64_t key = hash(seed_, lattice_.image_x(x), lattice_.image_y(y), vertical, cell.level);
  const double contrast = contrast_(cell.pixel, b.first, b.last);
  const double tolerable =
      kFirstWidth * std::sqrt(allowed_variance_[cell.pixel]) / (contrast * b.length_px + 1e-300);
  b.lay_grid(std::max(options_.initial_bracket_px, std::min(tolerable, b.length_px / 4.0)), key,
             !faults_.undithered_brackets);

  // A crossing located on a longer edge that this one is part of need not be searched again.
  for (int level = cell.level - 1; level >= 0; --level) {
    const std::int32_t longer = Lattice::side(level), mask = ~(longer - 1);
    if ((vertical ? x : y) & ~mask) continue;
    const std::int32_t px = vertical ? x : x & mask, py = vertical ? y & mask : y;
    const std::uint32_t parent = bracket_index_.find(Lattice::edge_key(px, py, vertical, level));
    if (parent == FlatMap::kAbsent) continue;
    const Bracket& whole = brackets_[parent];
    const double offset = ((vertical ? y - py : x - px)) * lattice_.unit_px();
    if (!whole.third_label && !whole.on_grid() && whole.first == b.first && whole.last == b.last &&
        whole.high > offset && whole.low < offset + b.length_px)
      b.inherit(whole, offset);
    break;
  }
  brackets_.push_back(b);
  return fresh;
}

void EdgeTracer::locate(std::vector<std::uint32_t>& active) {
  // A crossing near a vertex means a narrow feature only if the line is crossed again on the vertex's other
  // side.
  const auto thin = [&](const Bracket& b) {
    if (!b.wants_thin_refinement(options_.thinnest_px / 8.0, kThinShare)) return false;
    const std::int32_t step =
        b.centre() < 0.5 * b.length_px ? -Lattice::side(b.level) : Lattice::side(b.level);
    const std::int32_t x = b.vertical ? b.x : b.x + step, y = b.vertical ? b.y + step : b.y;
    return x >= 0 && y >= 0 &&
           bracket_index_.find(Lattice::edge_key(x, y, b.vertical, b.level)) != FlatMap::kAbsent;
  };
  std::vector<std::uint32_t> labels;
  for (;;) {
    std::size_t kept = 0;
    for (std::uint32_t b : active)
      if (!brackets_[b].third_label && (brackets_[b].on_grid() || thin(brackets_[b]))) active[kept++] = b;
    active.resize(kept);
    if (active.empty()) return;
    for (std::uint32_t b : active) points_.push_back(brackets_[b].at(lattice_, brackets_[b].next()));
    ask(labels);
    for (std::size_t i = 0; i < active.size(); ++i) brackets_[active[i]].take(labels[i]);
  }
}

}  // namespace ifov::sampling
