#include "sampling/accuracy/radiance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ifov::sampling {

namespace {

/// A jittered grid has at most this many cells per pixel side, even for slivers.
constexpr int kFinestGrid = 128;

/// A value on the wrong side of a curve is no sign of anything missed if it is at most this much farther from it than
/// the width to which the curve is known.
constexpr double kBorderSlack_px = 0.02;

/// So many vertices tell how values of a label differ thereabouts.
constexpr double kTold = 4.0;

constexpr std::uint64_t kStratumKey = 0x7374726174, kPathsKey = 0x7061746873;

}  // namespace

Radiance::Radiance(const EdgeTracer& tracer, const Prober& prober, RayLedger& ledger, const LabelTable& table,
                   const LabelSpread& spread, const LatticeValues& lattice_values,
                   const AccuracyFaults& faults, std::uint64_t seed, bool keep_values)
    : tracer_(tracer),
      prober_(prober),
      ledger_(ledger),
      table_(table),
      spread_(spread),
      lattice_(lattice_values),
      faults_(faults),
      seed_(seed),
      stride_(static_cast<std::size_t>(ledger.field().stride())),
      keep_values_(keep_values) {}

void Radiance::add_pixels(int first, int last, const LeafIntegrator& integrator) {
  std::vector<int> others;
  for (int source = first; source < last; ++source) {
    PlainPixel plain{source, 0, 0, 0.0};
    if (!tracer_.abandoned(static_cast<std::uint32_t>(source)) &&
        integrator.plain(source, plain.output, plain.label, plain.weight) && spread_.constant(plain.label))
      plain_pixels_.push_back(plain);
    else
      others.push_back(source);
  }
  pixels_.reserve(pixels_.size() + others.size());
  for (const int source : others) {
    pixels_.emplace_back().source = source;
    fill(pixels_.back(), integrator);
  }
}

bool Radiance::refresh(const LeafIntegrator& integrator) {
  for (const PlainPixel& pixel : plain_pixels_)
    if (tracer_.changed(static_cast<std::uint32_t>(pixel.source))) return false;
  for (Pixel& pixel : pixels_)
    if (tracer_.changed(static_cast<std::uint32_t>(pixel.source))) fill(pixel, integrator);
  return true;
}

void Radiance::fill(Pixel& pixel, const LeafIntegrator& integrator) const {
  pixel.cluttered = tracer_.abandoned(static_cast<std::uint32_t>(pixel.source));
  integrator.pixel(pixel.source, pixel.model);
  pixel.strata.clear();
  if (pixel.cluttered) {
    pixel.strata.assign(1, {});
    find_deviation(pixel, pixel.strata.front());
  } else {
    pixel.strata.resize(pixel.model.labels.size());
    for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
      pixel.strata[s].label = pixel.model.labels[s];
      find_deviation(pixel, pixel.strata[s]);
    }
  }
}

void Radiance::find_deviation(const Pixel& pixel, Stratum& stratum) const {
  const bool any_label = stratum.label == EdgeTracer::kNoLabel;
  if (!any_label && spread_.constant(stratum.label)) return;
  const std::size_t columns = static_cast<std::size_t>(ledger_.field().columns());
  stratum.deviation.assign(columns, 0.0f);
  const double count = widen_deviation(pixel, stratum.label, stratum.deviation);
  // A few that agree thereabouts may do so by chance where the label's values elsewhere do not.
  for (std::size_t c = 0; c < columns && !any_label; ++c) {
    const double near = static_cast<double>(stratum.deviation[c]),
                 total = spread_.total(stratum.label, static_cast<int>(c));
    stratum.deviation[c] =
        static_cast<float>(std::sqrt((near * near * count + total * kTold) / (count + kTold)));
  }
  // What few have told, or what differs by its nature, may differ as much as all that is about.
  if (faults_.other_labels_spread) return;
  if (!any_label && (count < kTold || ledger_.field().uneven(table_.label(stratum.label))))
    widen_deviation(pixel, EdgeTracer::kNoLabel, stratum.deviation);
}

/// From the lattice's values of a label, or of all, in the pixel and those around it. Their number.
double Radiance::widen_deviation(const Pixel& pixel, std::uint32_t label,
                                 std::vector<float>& deviation) const {
  const bool any_label = label == EdgeTracer::kNoLabel;
  const Lattice& lattice = tracer_.lattice();
  const int k = lattice.cells_per_pixel(), row = lattice.columns() + 1, width = lattice.domain().width();
  const int x = pixel.source % width * k, y = pixel.source / width * k;
  const std::size_t columns = deviation.size();
  std::vector<double> mean(columns, 0.0), squares(columns, 0.0);
  double count = 0.0;
  for (int j = std::max(0, y - k); j <= std::min(lattice.rows(), y + 2 * k); ++j)
    for (int i = std::max(0, x - k); i <= std::min(lattice.columns(), x + 2 * k); ++i) {
      const std::size_t v = static_cast<std::size_t>(j) * row + i;
      if (!any_label && lattice_.labels[v] != label) continue;
      count += 1.0;
      for (std::size_t c = 0; c < columns; ++c) {
        const double difference = lattice_.value(v)[c] - mean[c];
        mean[c] += difference / count;
        squares[c] += difference * (lattice_.value(v)[c] - mean[c]);
      }
    }
  const int height = lattice.domain().height(), column = pixel.source % width, line = pixel.source / width;
  for (int j = std::max(0, line - 1); pixel.cluttered && any_label && j <= std::min(height - 1, line + 1);
       ++j)
    for (int i = std::max(0, column - 1); i <= std::min(width - 1, column + 1); ++i)
      for (const Prober::Met& met : prober_.met(j * width + i)) {
        const double before = count;
        count += met.count;
        for (std::size_t c = 0; c < columns; ++c) {
          const double difference = table_.mean(met.label)[c] - mean[c];
          mean[c] += difference * met.count / count;
          squares[c] += difference * difference * met.count * before / count;
        }
      }
  for (std::size_t c = 0; c < columns; ++c)
    deviation[c] = std::max(deviation[c], static_cast<float>(std::sqrt(squares[c] / std::max(1.0, count))));
  return count;
}

void Radiance::plan(std::size_t p, std::size_t s, double count) {
  Stratum& stratum = pixels_[p].strata[s];
  stratum.rounds.emplace_back(stride_);
  ++stratum.round;
  planned_rounds_.push_back({p, s, count});
}

void Radiance::request_round(std::size_t p, std::size_t s, double count) {
  Pixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  const PixelRect& domain = tracer_.lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double area = std::max(pixel.model.area[s], 1e-9);
  int side = static_cast<int>(std::ceil(std::sqrt(count / area)));
  side = std::clamp(side + side % 2, 2, kFinestGrid);
  const std::uint64_t key = hash(seed_, kStratumKey, px, py, table_.label(stratum.label), stratum.round - 1);
  std::uint64_t sequences[kRoundReplicates];
  for (std::uint32_t r = 0; r < kRoundReplicates; ++r)
    sequences[r] = hash(key, kPathsKey, faults_.one_sequence ? 0 : r);
  const std::size_t first = requests_.size();
  for (int j = 0; j < side; j += 2)
    for (int i = 0; i < side; i += 2) {
      const auto block = static_cast<std::uint32_t>((j / 2) * (side / 2) + i / 2);
      // Which value of a block belongs to which sequence is drawn for four blocks, in which every sequence has every
      // quarter once: no gradient tells the sequences apart.
      const std::uint32_t turn = static_cast<std::uint32_t>(
          (hash(key, kPathsKey, i / 4, j / 4) ^ (i / 2 % 2 + j / 2 % 2 * 2)) % kRoundReplicates);
      for (std::uint32_t quarter = 0; quarter < kRoundReplicates; ++quarter) {
        const int a = i + static_cast<int>(quarter % 2), b = j + static_cast<int>(quarter / 2);
        const std::uint64_t cell = hash(key, a, b);
        const Point2 at{px + (a + unit_double(cell)) / side, py + (b + unit_double(mix(cell))) / side};
        const std::uint32_t model = tracer_.model_label({at.x, at.y});
        if (model != stratum.label && model != EdgeTracer::kNoLabel) continue;
        const std::uint32_t replicate = quarter ^ turn;
        requests_.push_back({{at.x, at.y}, sequences[replicate], block});
        planned_.push_back({p, s, block, static_cast<std::uint8_t>(replicate), false});
      }
    }
  if (!keep_values_)
    plan_paths(stratum, hash(seed_, kStratumKey, px, py, table_.label(stratum.label), kPathsKey), first);
  if (stratum.round == 2) plan_twins(first);
}

/// Where all values weigh alike, the paths of all rounds of a stratum are one sequence: what one round has left out, the
/// next looks at. Paths of a block are far apart in it: made unlike, they would show as variance what they take away.
void Radiance::plan_paths(Stratum& stratum, std::uint64_t key, std::size_t first) {
  std::uint32_t next[kRoundReplicates] = {};
  for (std::size_t i = first; i < requests_.size(); ++i) ++next[planned_[i].replicate];
  for (std::uint32_t& n : next) stratum.paths += std::exchange(n, stratum.paths);
  for (std::size_t i = first; i < requests_.size(); ++i) {
    requests_[i].sequence = key;
    requests_[i].index = next[planned_[i].replicate]++;
  }
}

/// Second paths at some of the points planned from `first` on, each after its point's own.
void Radiance::plan_twins(std::size_t first) {
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

bool Radiance::belongs(Stratum& stratum, FocalPoint point, std::uint32_t label, const float* value) const {
  if (!tracer_.disagrees(point, label, kBorderSlack_px)) return false;
  stratum.strays += 1.0;
  stratum.stray_sum.resize(stride_, 0.0);
  stratum.stray_squares.resize(stride_, 0.0);
  const double* mean = table_.mean(stratum.label);
  for (int c = 0; c < ledger_.field().columns(); ++c) {
    const double d = value[c] - mean[c];
    stratum.stray_sum[c] += d;
    stratum.stray_squares[c] += d * d;
  }
  return tracer_.model_label(point) == stratum.label;
}

void Radiance::trace() {
  constexpr std::size_t kAtOnce = 1 << 15;
  trace_nets();
  trace_clutter();
  for (const auto& [p, s, count] : planned_rounds_) {
    request_round(p, s, count);
    if (requests_.size() >= kAtOnce) trace_requests();
  }
  planned_rounds_.clear();
  trace_requests();
}

void Radiance::trace_requests() {
  constexpr std::size_t kBatch = 1024;
  std::vector<std::uint32_t> labels;
  std::vector<float> values;
  for (std::size_t first = 0; first < requests_.size();) {
    std::size_t last = std::min(first + kBatch, requests_.size());
    while (last < requests_.size() && planned_[last].same_block(planned_[last - 1])) ++last;
    const std::span<const PathRequest> batch =
        std::span<const PathRequest>(requests_).subspan(first, last - first);
    values.resize(batch.size() * stride_);
    ledger_.values(batch, labels, values);
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
void Radiance::add_block(std::size_t first, std::size_t last, std::span<const std::uint32_t> labels,
                         const float* values) {
  Stratum& stratum = pixels_[planned_[first].pixel].strata[planned_[first].stratum];
  const float* rows[4];
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
    if (labels[i] != stratum.label && !belongs(stratum, requests_[first + i].point, labels[i], value))
      continue;
    rows[count++] = value;
    if (!keep_values_) continue;
    stratum.samples.push_back(static_cast<std::uint32_t>(x_.size()));
    x_.push_back({requests_[first + i].point.x_px, requests_[first + i].point.y_px});
    replicates_.push_back(planned_[first + i].replicate);
    values_.insert(values_.end(), value, value + stride_);
  }
  if (count > 0) stratum.rounds.back().add_block({rows, count});
}

}  // namespace ifov::sampling
