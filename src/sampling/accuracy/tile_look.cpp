// Random points of every pixel: the lattice may be in step with what it looks at.
#include <algorithm>
#include <tuple>
#include <utility>

#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

namespace {

/// Source pixels that weigh less than this in every output are not looked at beside the lattice.
constexpr double kLeastLookedAt = 0.05;

constexpr std::uint64_t kLookKey = 0x6c6f6f6b, kLookPath = 0x6c6f6f6b70, kBetweenKey = 0x6265747765656e;

}  // namespace

bool TileWork::was_looked_at(int source) const {
  return !faults_.no_random_look && options_.looks_per_side > 0 && relative_weight(source) >= kLeastLookedAt;
}

std::vector<FocalPoint> TileWork::random_points(int source) const {
  const PixelRect& d = lattice_.domain();
  const int x = d.x0 + source % d.width(), y = d.y0 + source / d.width(), side = options_.looks_per_side;
  std::vector<FocalPoint> points;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const std::uint64_t key = hash(problem_.seed, kLookKey, x, y, j * side + i);
      points.push_back({x + (i + unit_double(key)) / side, y + (j + unit_double(mix(key))) / side});
    }
  return points;
}

bool TileWork::constant_at_vertices(int source) const {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const std::uint32_t* labels = &lattice_values_.labels[first_vertex(source)];
  for (int j = 0; j <= k; ++j, labels += row)
    for (int i = 0; i <= k; ++i)
      if (!lattice_values_.constant[labels[i]]) return false;
  return true;
}

/// Labels whose values agree at all vertices draw no values in their pixels: whether they are alike elsewhere is looked
/// at here. In other pixels random points are asked for their labels, when borders are traced.
void TileWork::look_at_constants() {
  LatticeValues& at = lattice_values_;
  LatticeValues::Look& look = at.look;
  std::vector<PathRequest> requests;
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    if (!was_looked_at(p)) continue;
    if (!constant_at_vertices(p)) {
      not_looked_at_.push_back(p);
      continue;
    }
    for (const FocalPoint point : random_points(p)) {
      look.points.push_back(point);
      requests.push_back({point, hash(problem_.seed, kLookPath, requests.size()), 0});
    }
  }
  if (requests.empty()) return;
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  for (std::size_t first = 0; first < requests.size(); first += RayLedger::kBatch) {
    const auto batch = std::span<const PathRequest>(requests).subspan(
        first, std::min(RayLedger::kBatch, requests.size() - first));
    std::vector<float> values(batch.size() * stride);
    std::vector<std::uint32_t> labels;
    ledger_.first_values(batch, labels, values);
    look.labels.insert(look.labels.end(), labels.begin(), labels.end());
    for (std::size_t i = 0; i < batch.size(); ++i)
      look.values.insert(look.values.end(), &values[i * stride], &values[i * stride + at.columns]);
  }
  at.constant.resize(table_.size(), 0);
  std::vector<const float*> first(table_.size(), nullptr);
  for (std::size_t v = 0; v < at.labels.size(); ++v)
    if (first[at.labels[v]] == nullptr) first[at.labels[v]] = at.value(v);
  for (std::size_t i = 0; i < look.labels.size(); ++i) {
    const float* known = first[look.labels[i]];
    const float* value = look.value(i, at.columns);
    if (known != nullptr && !std::equal(value, value + at.columns, known)) at.constant[look.labels[i]] = 0;
  }
}

/// The sides of the lattice whose ends have unlike labels that look alike.
std::vector<TileWork::Meeting> TileWork::meetings(const std::vector<std::uint8_t>& worth) const {
  const std::vector<std::uint32_t>& own =
      lattice_values_.own.empty() ? lattice_values_.labels : lattice_values_.own;
  const int columns = lattice_.columns(), rows = lattice_.rows();
  const std::size_t row = static_cast<std::size_t>(columns) + 1;
  std::vector<Meeting> found;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      for (const bool vertical : {false, true}) {
        if (vertical ? j == rows : i == columns) continue;
        const std::size_t a = static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i),
                          b = a + (vertical ? row : 1);
        if (own[a] == own[b]) continue;
        const std::int32_t x = i * Lattice::side(0), y = j * Lattice::side(0);
        const FocalPoint from = lattice_.point(x, y);
        const FocalPoint to =
            lattice_.point(x + (vertical ? 0 : Lattice::side(0)), y + (vertical ? Lattice::side(0) : 0));
        const int pixel = lattice_.pixel_at({0.5 * (from.x_px + to.x_px), 0.5 * (from.y_px + to.y_px)});
        if (!worth[pixel] || tracer_.abandoned(static_cast<std::uint32_t>(pixel))) continue;
        if (tracer_.matters(static_cast<std::uint32_t>(pixel), lattice_values_.labels[a],
                            lattice_values_.labels[b]))
          continue;
        found.push_back({pixel,
                         std::min(own[a], own[b]),
                         std::max(own[a], own[b]),
                         hash(problem_.seed, kBetweenKey, lattice_.image_x(x), lattice_.image_y(y), vertical),
                         {from, to, table_.label(own[a]), table_.label(own[b]), lattice_values_.labels[a]}});
      }
  return found;
}

/// Where two labels meet that are alike, no border is traced, but a gap may lie between them. One side is looked into for
/// each two labels that meet in a pixel, chosen by chance; where that finds something, all sides there and around.
void TileWork::look_between(const std::vector<std::uint8_t>& worth) {
  std::vector<Meeting> left = meetings(worth);
  std::sort(left.begin(), left.end(), [](const Meeting& a, const Meeting& b) {
    return std::tie(a.pixel, a.low, a.high, a.key) < std::tie(b.pixel, b.low, b.high, b.key);
  });
  std::vector<std::uint8_t> due(left.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    due[i] = i == 0 || std::tie(left[i].pixel, left[i].low, left[i].high) !=
                           std::tie(left[i - 1].pixel, left[i - 1].low, left[i - 1].high);
  const PixelRect& d = lattice_.domain();
  std::vector<std::uint8_t> around(worth.size(), 0);
  for (;;) {
    std::vector<Prober::Between> sides;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (due[i])
        sides.push_back(left[i].side);
      else
        left[kept++] = left[i];
    }
    left.resize(kept);
    if (sides.empty()) return;
    for (const FocalPoint point : prober_.look_between(std::move(sides))) {
      const int pixel = lattice_.pixel_at(point), x = pixel % d.width(), y = pixel / d.width();
      for (int j = std::max(0, y - 1); j <= std::min(d.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(d.width() - 1, x + 1); ++i)
          around[j * d.width() + i] = 1;
    }
    due.resize(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) due[i] = around[left[i].pixel];
  }
}

/// Where looks went on finding what the model did not have, there is more than they have found.
void TileWork::leave_unsettled() {
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    if (!prober_.unsettled(p)) continue;
    if (options_.clutter_switch) tracer_.abandon(static_cast<std::uint32_t>(p));
  }
}

}  // namespace ifov::sampling
