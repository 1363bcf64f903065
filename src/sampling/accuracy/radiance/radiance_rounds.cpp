#include "sampling/accuracy/radiance/radiance_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/radiance/stray_values.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

/// A jittered grid has at most so many cells a pixel, even for slivers.
constexpr double kFinestGrid = 128.0 * 128.0;

/// Points of a stratum's second round that get a second path each.
constexpr int kTwins = 16;

constexpr std::uint64_t kStratumKey = 0x7374726174, kPathsKey = 0x7061746873;

}  // namespace

RadianceRounds::RadianceRounds(std::vector<SourcePixel>& pixels, const BorderModel& model,
                               const StrayValues& strays, const LabelTable& table, RayLedger& ledger,
                               const ControlVariates& controls, KeptValues* kept, std::uint64_t seed)
    : pixels_(pixels),
      model_(model),
      strays_(strays),
      table_(table),
      ledger_(ledger),
      controls_(controls),
      kept_(kept),
      seed_(seed),
      stride_(static_cast<std::size_t>(ledger.field().stride())) {}

void RadianceRounds::plan(std::size_t p, std::size_t s, double count) {
  Stratum& stratum = pixels_[p].strata[s];
  stratum.rounds.emplace_back(stride_);
  ++stratum.round;
  planned_rounds_.push_back({p, s, count});
}

/// The requests of a round.
void RadianceRounds::request_round(const PlannedRound& round) {
  const auto [p, s, count] = round;
  SourcePixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  const PixelRect& domain = model_.tree().lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double area = std::max(pixel.model.area[s], 1e-9);
  const auto [columns, rows] = GridSides::even(std::min(count / area, kFinestGrid), stratum.round % 2 != 0);
  const std::uint64_t key = hash(seed_, kStratumKey, px, py, table_.label(stratum.label), stratum.round - 1);
  std::uint64_t sequences[kReplicates];
  for (std::uint32_t r = 0; r < kReplicates; ++r) sequences[r] = hash(key, kPathsKey, r);
  const std::size_t first = requests_.size();
  for (int j = 0; j < rows; j += 2)
    for (int i = 0; i < columns; i += 2) {
      const auto block = static_cast<std::uint32_t>((j / 2) * (columns / 2) + i / 2);
      // Which value of a block belongs to which sequence is drawn for four blocks, in which every sequence has every
      // quarter once: no gradient tells the sequences apart.
      const std::uint32_t turn = static_cast<std::uint32_t>(
          (hash(key, kPathsKey, i / 4, j / 4) ^ (i / 2 % 2 + j / 2 % 2 * 2)) % kReplicates);
      for (std::uint32_t quarter = 0; quarter < kReplicates; ++quarter) {
        const int a = i + static_cast<int>(quarter % 2), b = j + static_cast<int>(quarter / 2);
        const std::uint64_t cell = hash(key, a, b);
        const Point2 at{px + (a + unit_double(cell)) / columns, py + (b + unit_double(mix(cell))) / rows};
        const std::uint32_t model = model_.label_at({at.x, at.y});
        if (model != stratum.label && model != kNoLabel) continue;
        const std::uint32_t replicate = quarter ^ turn;
        requests_.push_back({{at.x, at.y}, sequences[replicate], block});
        planned_.push_back({p, s, block, static_cast<std::uint8_t>(replicate), false});
      }
    }
  if (kept_ == nullptr)
    plan_paths(stratum, hash(seed_, kStratumKey, px, py, table_.label(stratum.label), kPathsKey), first);
  if (stratum.round == 2) plan_twins(first);
}

/// Where all values weigh alike, the paths of all rounds of a stratum are one sequence: what one round has left out, the
/// next looks at. Paths of a block are far apart in it: made unlike, they would show as variance what they take away.
void RadianceRounds::plan_paths(Stratum& stratum, std::uint64_t key, std::size_t first) {
  std::uint32_t next[kReplicates] = {};
  for (std::size_t i = first; i < requests_.size(); ++i) ++next[planned_[i].replicate];
  for (std::uint32_t& n : next) stratum.paths += std::exchange(n, stratum.paths);
  for (std::size_t i = first; i < requests_.size(); ++i) {
    requests_[i].sequence = key;
    requests_[i].index = next[planned_[i].replicate]++;
  }
}

/// Second paths at some of the points planned from `first` on, each after its point's own.
void RadianceRounds::plan_twins(std::size_t first) {
  const std::vector<PathRequest> requests(requests_.begin() + static_cast<std::ptrdiff_t>(first),
                                          requests_.end());
  const std::vector<Planned> planned(planned_.begin() + static_cast<std::ptrdiff_t>(first), planned_.end());
  const std::size_t step = std::max<std::size_t>(1, requests.size() / kTwins);
  requests_.resize(first);
  planned_.resize(first);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    requests_.push_back(requests[k]);
    planned_.push_back(planned[k]);
    if (k % step != 0) continue;
    requests_.push_back(requests[k]);
    requests_.back().sequence = mix(requests[k].sequence);
    planned_.push_back(planned[k]);
    planned_.back().twin = true;
  }
}

void RadianceRounds::trace() {
  constexpr std::size_t kAtOnce = 1 << 15;
  for (const PlannedRound& round : planned_rounds_) {
    request_round(round);
    if (requests_.size() >= kAtOnce) trace_requests();
  }
  planned_rounds_.clear();
  trace_requests();
}

void RadianceRounds::trace_requests() {
  constexpr std::size_t kBatch = 1024;
  std::vector<std::uint32_t> labels, expected;
  std::vector<float> values;
  for (std::size_t first = 0; first < requests_.size();) {
    std::size_t last = std::min(first + kBatch, requests_.size());
    while (last < requests_.size() && planned_[last].same_block(planned_[last - 1])) ++last;
    const std::span<const PathRequest> batch =
        std::span<const PathRequest>(requests_).subspan(first, last - first);
    values.resize(batch.size() * stride_);
    expected.clear();
    for (std::size_t i = first; i < last; ++i)
      expected.push_back(pixels_[planned_[i].pixel].strata[planned_[i].stratum].label);
    ledger_.values_expecting(batch, expected, labels, values);
    for (std::size_t i = first, end = first; i < last; i = end) {
      while (end < last && planned_[end].same_block(planned_[i])) ++end;
      add_block(i, end, {labels.data() + (i - first), end - i}, &values[(i - first) * stride_]);
    }
    first = last;
  }
  planned_.clear();
  requests_.clear();
}

/// The values of planned_[first] to planned_[last - 1], which stand in one block.
void RadianceRounds::add_block(std::size_t first, std::size_t last, std::span<const std::uint32_t> labels,
                               const float* values) {
  const SourcePixel& pixel = pixels_[planned_[first].pixel];
  Stratum& stratum = pixels_[planned_[first].pixel].strata[planned_[first].stratum];
  const float* rows[4];
  FocalPoint points[4];
  std::uint8_t replicates[4];
  std::size_t count = 0;
  for (std::size_t i = 0; i < last - first; ++i) {
    const float* value = values + i * stride_;
    if (planned_[first + i].twin) {
      if (labels[i] != stratum.label || labels[i - 1] != stratum.label) continue;
      stratum.twin_squares.resize(stride_, 0.0);
      for (std::size_t c = 0; c < stride_; ++c) {
        const double difference = static_cast<double>(value[c]) - (value - stride_)[c];
        stratum.twin_squares[c] += 0.5 * difference * difference;
      }
      stratum.twins += 1.0;
      continue;
    }
    if (labels[i] != stratum.label && !strays_.belongs(stratum, requests_[first + i].point, labels[i], value))
      continue;
    points[count] = requests_[first + i].point;
    replicates[count] = planned_[first + i].replicate;
    rows[count++] = value;
  }
  if (count > 0 && stratum.foretold()) {
    rests_.resize(4 * stride_);
    controls_.foretell(pixel, stratum, {points, count}, {rests_.data(), count * stride_});
    for (std::size_t i = 0; i < count; ++i) {
      float* rest = &rests_[i * stride_];
      for (std::size_t c = 0; c < stride_; ++c) rest[c] = rows[i][c] - rest[c];
      rows[i] = rest;
    }
  }
  for (std::size_t i = 0; i < count && kept_ != nullptr; ++i) {
    stratum.samples.push_back(static_cast<std::uint32_t>(kept_->x.size()));
    kept_->x.push_back({points[i].x_px, points[i].y_px});
    kept_->replicates.push_back(replicates[i]);
    kept_->values.insert(kept_->values.end(), rows[i], rows[i] + stride_);
  }
  if (count > 0) stratum.rounds.back().add_block({rows, count});
}

}  // namespace ifov::sampling
