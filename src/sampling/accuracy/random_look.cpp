#include "sampling/accuracy/random_look.h"

#include <algorithm>
#include <span>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/source_grid.h"
#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::sampling {

namespace {

/// Source pixels that weigh less than this in every output are not looked at beside the lattice.
constexpr double kLeastTested = 0.05;

/// Values of a strip, a tile of few long rows, that must agree before its labels are taken for constant: of what fewer tell, one path in
/// fifty that meets something else would be missed by whole rows of a rolling shutter. And as many of a pixel, at most.
constexpr std::size_t kFewestTested = 1024, kMostOfPixel = 64;
constexpr int kFewRows = 4, kLongRow = 8;

constexpr std::uint64_t kRandomPointKey = 0x6c6f6f6b, kRandomPointPath = 0x6c6f6f6b70;

}  // namespace

bool RandomLook::covers(int source) const {
  return side_ > 0 && grid_.relative_weight(source) >= kLeastTested;
}

std::vector<FocalPoint> RandomLook::points(int source, int round) const {
  const PixelRect& d = lattice_.domain();
  const int x = d.x0 + source % d.width(), y = d.y0 + source / d.width();
  std::vector<FocalPoint> points;
  for (int j = 0; j < side_; ++j)
    for (int i = 0; i < side_; ++i) {
      const std::uint64_t key = hash(seed_, kRandomPointKey, x, y, (round * side_ + j) * side_ + i);
      points.push_back({x + (i + unit_double(key)) / side_, y + (j + unit_double(mix(key))) / side_});
    }
  return points;
}

bool RandomLook::constant_at_vertices(int source, const LatticeValues& at) const {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const std::uint32_t* labels = &at.labels[lattice_.first_vertex(source)];
  for (int j = 0; j <= k; ++j, labels += row)
    for (int i = 0; i <= k; ++i)
      if (!at.constant[labels[i]]) return false;
  return true;
}

std::vector<int> RandomLook::test_constant_labels(RayLedger& ledger, const LabelTable& table,
                                                  LatticeValues& at) const {
  std::vector<int> left;
  LatticeValues::RandomPoints& random = at.random;
  std::vector<PathRequest> requests;
  std::vector<int> constant;
  for (int p = 0; p < lattice_.domain().count(); ++p)
    if (covers(p)) (constant_at_vertices(p, at) ? constant : left).push_back(p);
  const std::size_t of_round = constant.size() * static_cast<std::size_t>(side_ * side_),
                    most = kMostOfPixel * constant.size();
  const PixelRect& tile = grid_.tile();
  const bool strip = tile.height() <= kFewRows && tile.width() >= kLongRow;
  for (int round = 0; !constant.empty() && (round == 0 || requests.size() + of_round <= most) &&
                      (round == 0 || (strip && requests.size() < kFewestTested));
       ++round)
    for (const int p : constant)
      for (const FocalPoint point : points(p, round)) {
        random.points.push_back(point);
        requests.push_back({point, hash(seed_, kRandomPointPath, requests.size()), 0});
      }
  if (requests.empty()) return left;
  const std::size_t stride = static_cast<std::size_t>(ledger.field().stride());
  for (std::size_t first = 0; first < requests.size(); first += RayLedger::kBatch) {
    const auto batch = std::span<const PathRequest>(requests).subspan(
        first, std::min(RayLedger::kBatch, requests.size() - first));
    std::vector<float> values(batch.size() * stride);
    std::vector<std::uint32_t> labels;
    ledger.first_values(batch, labels, values);
    random.labels.insert(random.labels.end(), labels.begin(), labels.end());
    for (std::size_t i = 0; i < batch.size(); ++i)
      random.values.insert(random.values.end(), &values[i * stride], &values[i * stride + at.columns]);
  }
  at.constant.resize(table.size(), 0);
  std::vector<const float*> first(table.size(), nullptr);
  for (std::size_t v = 0; v < at.labels.size(); ++v)
    if (first[at.labels[v]] == nullptr) first[at.labels[v]] = at.value(v);
  for (std::size_t i = 0; i < random.labels.size(); ++i) {
    const float* known = first[random.labels[i]];
    const float* value = random.value(i, at.columns);
    if (known != nullptr && !std::equal(value, value + at.columns, known)) at.constant[random.labels[i]] = 0;
  }
  return left;
}

}  // namespace ifov::sampling
