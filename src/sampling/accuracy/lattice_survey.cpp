#include "sampling/accuracy/lattice_survey.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

/// So many values of a label that may be shaded tell, where all agree, that all do.
constexpr std::uint32_t kFewAgree = 4;

}  // namespace

void ask_vertices(const Lattice& lattice, RayLedger& ledger, std::uint64_t seed, LatticeValues& at) {
  struct Column {
    double x_px;
    std::uint64_t key;
  };
  std::vector<Column> columns;
  for (int i = 0; i <= lattice.columns(); ++i) {
    const std::int32_t x = i * Lattice::side(0);
    columns.push_back({lattice.x_px(x), hash(seed, lattice.image_x(x))});
  }
  const std::size_t row = columns.size(), stride = static_cast<std::size_t>(ledger.field().stride());
  const std::size_t vertices = row * (static_cast<std::size_t>(lattice.rows()) + 1);
  // Some rows at a time, so that requests and answers are still in the cache when they are worked on.
  const int rows_at_once = static_cast<int>(std::max<std::size_t>(1, RayLedger::kBatch / row));
  at.columns = static_cast<std::size_t>(ledger.field().columns());
  at.labels.reserve(vertices);
  at.values.resize(vertices * at.columns);
  float* kept = at.values.data();
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> labels;
  std::vector<float> values;
  for (int first = 0; first <= lattice.rows(); first += rows_at_once) {
    const int last = std::min(first + rows_at_once, lattice.rows() + 1);
    requests.resize(static_cast<std::size_t>(last - first) * row);
    PathRequest* request = requests.data();
    for (int j = first; j < last; ++j) {
      const std::int32_t y = j * Lattice::side(0);
      const double y_px = lattice.y_px(y);
      const std::int64_t image_y = lattice.image_y(y);
      for (const Column& column : columns)
        *request++ = {{column.x_px, y_px}, extend(column.key, image_y, 0x766572), 0};
    }
    values.resize(requests.size() * stride);
    ledger.first_values(requests, labels, values);
    at.labels.insert(at.labels.end(), labels.begin(), labels.end());
    for (std::size_t v = 0; v < labels.size(); ++v) kept = std::copy_n(&values[v * stride], at.columns, kept);
  }
}

void merge_twins(RayLedger& ledger, LabelTable& table, LatticeValues& at) {
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> first(table.size(), kNone);
  at.constant.assign(table.size(), 1);
  for (std::uint32_t label = 0; label < table.size(); ++label)
    if (ledger.field().uneven(table.label(label))) at.constant[label] = 0;
  const auto same = [&](std::size_t v, std::size_t w) {
    return std::equal(at.value(v), at.value(v) + at.columns, at.value(w));
  };
  std::vector<std::uint32_t> met(table.size(), 0);
  for (std::size_t v = 0; v < at.labels.size(); ++v) {
    const std::uint32_t label = at.labels[v];
    ++met[label];
    if (first[label] == kNone)
      first[label] = v;
    else if (at.constant[label] && !same(v, first[label]))
      at.constant[label] = 0;
  }
  for (std::uint32_t label = 0; label < table.size(); ++label)
    if (met[label] < kFewAgree && ledger.field().may_be_shaded(table.label(label))) at.constant[label] = 0;
  std::multimap<std::pair<std::uint32_t, float>, std::uint32_t> kept;  // by material and first column
  bool any = false;
  for (std::uint32_t label = 0; label < table.size(); ++label) {
    if (!at.constant[label] || first[label] == kNone) continue;
    const std::pair<std::uint32_t, float> key{ledger.field().material_of(table.label(label)),
                                              at.value(first[label])[0]};
    const auto [begin, end] = kept.equal_range(key);
    const auto twin =
        std::find_if(begin, end, [&](const auto& e) { return same(first[e.second], first[label]); });
    if (twin == end) {
      kept.emplace(key, label);
    } else {
      table.merge(label, twin->second);
      any = true;
    }
  }
  if (!any) return;
  at.own = at.labels;
  for (std::uint32_t& label : at.labels) label = table.merged(label);
}

void take_means(const Lattice& lattice, LabelTable& table, LatticeValues& at) {
  struct Seen {
    std::size_t first = 0;
    std::uint32_t times = 0;
  };
  std::vector<Seen> seen(table.size());
  for (std::size_t v = 0; v < at.labels.size(); ++v) {
    const std::uint32_t label = at.labels[v];
    if (!at.constant[label])
      table.add(label, at.value(v));
    else if (seen[label].times++ == 0)
      seen[label].first = v;
  }
  for (std::uint32_t label = 0; label < seen.size(); ++label)
    table.add_same(label, at.value(seen[label].first), seen[label].times);
  for (std::size_t i = 0; i < at.random.labels.size(); ++i)
    if (!at.constant[at.random.labels[i]]) table.add(at.random.labels[i], at.random.value(i, at.columns));

  at.only.resize(static_cast<std::size_t>(lattice.domain().count()));
  const int k = lattice.cells_per_pixel();
  for (int p = 0; p < lattice.domain().count(); ++p) {
    const std::uint32_t* labels = &at.labels[lattice.first_vertex(p)];
    const std::uint32_t label = labels[0];
    std::uint32_t unlike = 0;
    for (int j = 0; j <= k; ++j, labels += lattice.columns() + 1)
      for (int i = 0; i <= k; ++i) unlike |= labels[i] ^ label;
    at.only[p] = unlike == 0 ? label : LatticeValues::kMixed;
  }
}

}  // namespace ifov::sampling
