#include "sampling/accuracy/radiance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/sequence.h"

namespace ifov::sampling {

namespace {

/// Weight, in degrees of freedom, of the borrowed variance beside a stratum's own.
constexpr double kBorrowed = 2.0;
/// A jittered grid has at most this many cells per pixel side, even for slivers.
constexpr int kFinestGrid = 128;
/// Points of a sequence looked at for each value of a stratum, before the net is left incomplete.
constexpr double kAttemptsPerValue = 4.0;

/// In place of a quarter: the value has the point of another one, whose number stands in place of the block.
constexpr std::uint8_t kTwin = 255;

constexpr std::uint64_t kStratumKey = 0x7374726174, kNetKey = 0x6e657473, kStratumNetKey = 0x736e657473;

}  // namespace

Radiance::Radiance(const EdgeTracer& tracer, RayLedger& ledger, const LabelTable& table,
                   const LabelSpread& spread, const LatticeValues& lattice_values,
                   const AccuracyFaults& faults, std::uint64_t seed)
    : tracer_(tracer),
      ledger_(ledger),
      table_(table),
      spread_(spread),
      lattice_(lattice_values),
      faults_(faults),
      seed_(seed),
      stride_(lattice_values.stride) {}

void Radiance::add_pixel(int source, const LeafIntegrator& integrator) {
  PlainPixel plain{source, 0, 0, 0.0};
  if (!tracer_.abandoned(static_cast<std::uint32_t>(source)) &&
      integrator.plain(source, plain.output, plain.label, plain.weight) && spread_.constant(plain.label)) {
    plain_pixels_.push_back(plain);
    return;
  }
  pixels_.emplace_back().source = source;
  fill(pixels_.back(), integrator);
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
    pixel.strata.assign(kReplicates, Stratum{EdgeTracer::kNoLabel, 0, {}, {}, {}, {}, {}, {}, 0.0});
  } else {
    for (std::uint32_t label : pixel.model.labels) pixel.strata.push_back({label, 0, {}, {}, {}, {}, {}, {}, 0.0});
  }
}

void Radiance::plan(std::size_t p, std::size_t s, double count) {
  Pixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  stratum.round_starts.push_back(static_cast<std::uint32_t>(stratum.block_starts.size()));
  const PixelRect& domain = tracer_.lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double area = std::max(pixel.model.area[s], 1e-9);
  int side = static_cast<int>(std::ceil(std::sqrt(count / area)));
  side = std::clamp(side + side % 2, 2, kFinestGrid);
  const std::uint64_t key = hash(seed_, kStratumKey, px, py, table_.label(stratum.label), stratum.round++);
  const std::size_t first = requests_.size();
  for (int j = 0; j < side; j += 2)
    for (int i = 0; i < side; i += 2)
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int a = i + quarter % 2, b = j + quarter / 2;
        const std::uint64_t cell = hash(key, a, b);
        const Point2 at{px + (a + unit_double(cell)) / side, py + (b + unit_double(mix(cell))) / side};
        const std::uint32_t model = tracer_.model_label({at.x, at.y});
        if (model != stratum.label && model != EdgeTracer::kNoLabel) continue;
        requests_.push_back({{at.x, at.y}, mix(cell + 1), 0});
        planned_.push_back({p, s, static_cast<std::uint32_t>((j / 2) * (side / 2) + i / 2),
                            static_cast<std::uint8_t>(quarter)});
      }
  if (stratum.round != 2) return;
  const std::size_t drawn = requests_.size() - first, step = std::max<std::size_t>(1, drawn / kTwins);
  for (std::size_t k = 0; k < drawn; k += step) {
    PathRequest twin = requests_[first + k];
    twin.sequence = mix(twin.sequence);
    requests_.push_back(twin);
    planned_.push_back({p, s, static_cast<std::uint32_t>(first + k), kTwin});
  }
}

void Radiance::plan_nets(std::size_t p, std::uint32_t count) {
  Pixel& pixel = pixels_[p];
  const PixelRect& domain = tracer_.lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  for (std::size_t r = 0; r < pixel.strata.size(); ++r) {
    const std::uint64_t key = hash(seed_, kNetKey, px, py, r);
    for (std::uint32_t i = pixel.net_size; i < count; ++i) {
      const Point2 u = sequence_point(key, i, 0);
      requests_.push_back({{px + u.x, py + u.y}, mix(key), i});
      planned_.push_back({p, r, i, 0});
    }
  }
  pixel.net_size = count;
}

void Radiance::plan_stratum_nets(std::size_t p, std::size_t s, std::uint32_t count) {
  Pixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  Nets& nets = stratum.nets;
  if (nets.size == 0) {
    // The first values chose the size of the nets; an estimate that left them in would favour their luck.
    stratum.samples.clear();
    stratum.block_starts.clear();
    stratum.full_block.clear();
    stratum.round_starts.clear();
    nets.drawn.assign(kStratumReplicates, 0);
    nets.paths.assign(kStratumReplicates, 0);
    nets.accepted.assign(kStratumReplicates, 0);
    nets.sum.assign(kStratumReplicates * stride_, 0.0);
  }
  const PixelRect& domain = tracer_.lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double attempts = kAttemptsPerValue * (count / std::max(pixel.model.area[s], 1e-6) + 1.0);
  for (std::size_t r = 0; r < kStratumReplicates; ++r) {
    const std::uint64_t key = hash(seed_, kStratumNetKey, px, py, table_.label(stratum.label), r);
    while (nets.paths[r] < count && nets.drawn[r] < attempts) {
      const Point2 u = sequence_point(key, nets.drawn[r]++, 0);
      const Point2 at{px + u.x, py + u.y};
      const std::uint32_t model = tracer_.model_label({at.x, at.y});
      if (model != stratum.label && model != EdgeTracer::kNoLabel) continue;
      // Paths count on their own: pairs of dimensions are scrambled apart, so a net of paths stays whole
      // whatever points the stratum's shape refuses.
      net_requests_.push_back({{at.x, at.y}, key, nets.paths[r]++});
      net_planned_.push_back({p, s, r});
    }
  }
  nets.size = count;
}

void Radiance::trace_nets() {
  constexpr std::size_t kBatch = 4096;
  std::vector<std::uint32_t> labels;
  std::vector<float> values(std::min(kBatch, net_requests_.size()) * stride_);
  for (std::size_t first = 0; first < net_requests_.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, net_requests_.size() - first);
    labels.clear();
    ledger_.values(std::span<const PathRequest>(net_requests_).subspan(first, count), labels,
                   std::span<float>(values).first(count * stride_));
    for (std::size_t i = 0; i < count; ++i) {
      const PlannedInNet& planned = net_planned_[first + i];
      Stratum& stratum = pixels_[planned.pixel].strata[planned.stratum];
      if (labels[i] != stratum.label) continue;
      ++stratum.nets.accepted[planned.replicate];
      double* sum = &stratum.nets.sum[planned.replicate * stride_];
      const float* value = &values[i * stride_];
      for (std::size_t c = 0; c < stride_; ++c) sum[c] += value[c];
    }
  }
  net_requests_.clear();
  net_planned_.clear();
}

void Radiance::net_moments(const Nets& nets, std::span<const int> columns, StratumMoments& out) const {
  const std::size_t n = columns.size();
  std::vector<double> squares(n, 0.0);
  double replicates = 0.0, count = 0.0;
  for (std::size_t r = 0; r < kStratumReplicates; ++r) {
    if (nets.accepted[r] == 0) continue;
    replicates += 1.0;
    count += nets.accepted[r];
    for (std::size_t c = 0; c < n; ++c) {
      const double d = nets.sum[r * stride_ + columns[c]] / nets.accepted[r] - out.mean[c];
      out.mean[c] += d / replicates;
      squares[c] += d * (nets.sum[r * stride_ + columns[c]] / nets.accepted[r] - out.mean[c]);
    }
  }
  out.sampled = replicates > 0.0;
  out.freedom = std::max(1.0, replicates - 1.0);
  // As the variance of one of `count` independent values, which is what allocation compares.
  for (std::size_t c = 0; c < n; ++c)
    out.variance[c] = squares[c] / (std::max(1.0, replicates - 1.0) * std::max(1.0, replicates)) * count;
}

std::size_t Radiance::Stratum::count() const {
  if (nets.size == 0) return samples.size();
  return std::accumulate(nets.accepted.begin(), nets.accepted.end(), std::size_t{0});
}

void Radiance::trace() {
  trace_nets();
  if (requests_.empty()) return;
  std::vector<std::uint32_t> labels;
  const std::size_t first = labels_.size();
  values_.resize((first + requests_.size()) * stride_);
  ledger_.values(requests_, labels, std::span<float>(values_).subspan(first * stride_));
  labels_.insert(labels_.end(), labels.begin(), labels.end());
  for (const PathRequest& r : requests_) x_.push_back({r.point.x_px, r.point.y_px});

  std::size_t open = ~std::size_t{0};
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    const Planned& planned = planned_[i];
    Pixel& pixel = pixels_[planned.pixel];
    Stratum& stratum = pixel.strata[planned.stratum];
    if (planned.quarter == kTwin) {
      if (labels[i] != stratum.label || labels[planned.block] != stratum.label) continue;
      stratum.twin_squares.resize(stride_, 0.0);
      const float *a = &values_[(first + i) * stride_], *b = &values_[(first + planned.block) * stride_];
      for (std::size_t c = 0; c < stride_; ++c) {
        const double difference = static_cast<double>(a[c]) - b[c];
        stratum.twin_squares[c] += 0.5 * difference * difference;
      }
      stratum.twins += 1.0;
      continue;
    }
    const bool same_block = open != ~std::size_t{0} && planned_[open].pixel == planned.pixel &&
                            planned_[open].stratum == planned.stratum &&
                            planned_[open].block == planned.block;
    // The model put this point into the stratum and the ray says otherwise: what lies on the wrong side of a
    // border is part of the border's variance, and has no say about the radiance inside.
    if (!pixel.cluttered && labels[i] != stratum.label) continue;
    if (!same_block) {
      stratum.block_starts.push_back(static_cast<std::uint32_t>(stratum.samples.size()));
      stratum.full_block.push_back(0);
      open = i;
    }
    stratum.samples.push_back(static_cast<std::uint32_t>(first + i));
    stratum.full_block.back() = stratum.samples.size() - stratum.block_starts.back() == 4;
  }
  planned_.clear();
  requests_.clear();
}

Radiance::Block Radiance::block_at(const Stratum& stratum, std::size_t b) const {
  const std::size_t begin = stratum.block_starts[b];
  const std::size_t end =
      b + 1 < stratum.block_starts.size() ? stratum.block_starts[b + 1] : stratum.samples.size();
  Block block;
  block.count = std::min<std::size_t>(end - begin, 4);
  block.full = stratum.full_block[b] != 0;
  for (std::size_t i = 0; i < block.count; ++i)
    block.value[i] = &values_[stratum.samples[begin + i] * stride_];
  return block;
}

/// One degree of freedom about the variance of a value: of four quarters what a plane does not explain, of
/// fewer values half the square of a difference.
double Radiance::block_square(const Block& block, int k) {
  const float* const* v = block.value;
  if (!block.full) {
    const double difference = static_cast<double>(v[0][k]) - v[1][k];
    return 0.5 * difference * difference;
  }
  const double twist = (static_cast<double>(v[0][k]) - v[1][k]) - (static_cast<double>(v[2][k]) - v[3][k]);
  return 0.25 * twist * twist;
}

bool Radiance::paths_differ(const Stratum& stratum, std::span<const int> columns,
                            const StratumMoments& moments) const {
  constexpr double kMost = 0.5;
  if (stratum.twins == 0.0) return false;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (stratum.twin_squares[columns[c]] / stratum.twins > kMost * moments.variance[c] && moments.variance[c] > 0.0)
      return true;
  return false;
}

double Radiance::with_trend(const Pixel& pixel, std::size_t s, std::span<const int> drivers,
                            double count) const {
  const Stratum& stratum = pixel.strata[s];
  const std::size_t rounds = stratum.round_starts.size();
  const std::size_t first[3] = {stratum.round_starts[rounds - 2], stratum.round_starts[rounds - 1],
                                stratum.block_starts.size()};
  if (first[0] == first[1] || first[1] == first[2]) return count;
  const double growth = static_cast<double>(first[2] - first[1]) / static_cast<double>(first[1] - first[0]);
  double slowest = 1.0;
  for (int column : drivers) {
    double variance[2] = {0.0, 0.0};
    for (int r = 0; r < 2; ++r) {
      double blocks = 0.0;
      for (std::size_t b = first[r]; b < first[r + 1]; ++b) {
        const Block block = block_at(stratum, b);
        if (block.count < 2) continue;
        variance[r] += block_square(block, column);
        blocks += 1.0;
      }
      variance[r] /= std::max(1.0, blocks);
    }
    if (variance[1] == 0.0) continue;
    const double fall =
        growth > 1.5 && variance[0] > 0.0 ? std::log(variance[0] / variance[1]) / std::log(growth) : 0.0;
    slowest = std::min(slowest, std::clamp(fall, 0.0, 1.0));
  }
  const double have = static_cast<double>(stratum.samples.size());
  return count <= have ? count : have * std::pow(count / have, 1.0 / (1.0 + slowest));
}

void Radiance::moments(const Pixel& pixel, std::size_t s, std::span<const int> columns,
                       StratumMoments& out) const {
  const Stratum& stratum = pixel.strata[s];
  const std::uint32_t label = stratum.label;
  const std::size_t n = columns.size();
  out.mean.assign(n, 0.0);
  out.variance.assign(n, 0.0);
  if (stratum.nets.size > 0) {
    net_moments(stratum.nets, columns, out);
    if (out.sampled) return;
  }
  out.sampled = !stratum.samples.empty();

  if (out.sampled) {
    const double share = 1.0 / static_cast<double>(stratum.samples.size());
    for (std::uint32_t i : stratum.samples)
      for (std::size_t c = 0; c < n; ++c) out.mean[c] += share * values_[i * stride_ + columns[c]];
    double blocks = 0.0;
    std::vector<double> fourth(n, 0.0);
    for (std::size_t b = 0; b < stratum.block_starts.size(); ++b) {
      const Block block = block_at(stratum, b);
      if (block.count < 2) continue;
      for (std::size_t c = 0; c < n; ++c) {
        const double square = block_square(block, columns[c]);
        out.variance[c] += square;
        fourth[c] += square * square;
      }
      blocks += 1.0;
    }
    // Where a few blocks hold most of the variance (a shadow's edge within the label), few degrees of freedom
    // are behind it: a square with one degree has a third of its own square's expectation as its squared
    // expectation.
    out.freedom = blocks;
    for (std::size_t c = 0; c < n; ++c) {
      if (fourth[c] > 0.0)
        out.freedom = std::min(out.freedom, 3.0 * out.variance[c] * out.variance[c] / fourth[c]);
      out.variance[c] =
          (out.variance[c] + kBorrowed * spread_.local(label, columns[c])) / (blocks + kBorrowed);
    }
    out.freedom += kBorrowed;
    if (faults_.zero_variance_single_samples && blocks == 0.0)
      std::fill(out.variance.begin(), out.variance.end(), 0.0);
    return;
  }

  if (spread_.constant(label)) {
    for (std::size_t c = 0; c < n; ++c) out.mean[c] = table_.mean(label)[columns[c]];
    out.freedom = 2.0;
    return;
  }

  const Lattice& lattice = tracer_.lattice();
  const int k = lattice.cells_per_pixel(), row = lattice.columns() + 1;
  const int x = pixel.source % lattice.domain().width() * k, y = pixel.source / lattice.domain().width() * k;
  double weight = 0.0, count = 0.0;
  std::vector<double> squares(n, 0.0);
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::size_t v = static_cast<std::size_t>(y + j) * row + x + i;
      if (lattice_.labels[v] != label) continue;
      const double w = (i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0);
      weight += w;
      count += 1.0;
      for (std::size_t c = 0; c < n; ++c) {
        const double value = lattice_.values[v * stride_ + columns[c]], old = out.mean[c];
        out.mean[c] += w / weight * (value - old);
        squares[c] += w * (value - old) * (value - out.mean[c]);
      }
    }
  for (std::size_t c = 0; c < n; ++c) {
    if (count == 0.0) out.mean[c] = table_.mean(label)[columns[c]];
    const double own =
        count > 1.0 ? squares[c] / weight * count / (count - 1.0) : spread_.total(label, columns[c]);
    out.variance[c] = std::max(own, spread_.local(label, columns[c]));
  }
  out.freedom = std::max(2.0, count - 1.0);
  if (faults_.zero_variance_single_samples && count < 2.0)
    std::fill(out.variance.begin(), out.variance.end(), 0.0);
}

double Radiance::weigh(const Pixel& pixel, std::size_t s, const PixelFootprint& footprint, Point2 centre,
                       std::span<const int> columns, std::vector<double>& mean) const {
  const Stratum& stratum = pixel.strata[s];
  double sum = 0.0, squares = 0.0;
  std::vector<double> weights;
  for (std::uint32_t i : stratum.samples) {
    const double w = footprint.density(x_[i].x - centre.x, x_[i].y - centre.y);
    weights.push_back(w);
    sum += w;
    squares += w * w;
  }
  if (sum == 0.0) return 1.0;
  std::fill(mean.begin(), mean.end(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      mean[c] += weights[i] / sum * values_[stratum.samples[i] * stride_ + columns[c]];
  return squares / (sum * sum);
}

void Radiance::nets(const Pixel& pixel, const PixelFootprint* footprint, Point2 centre,
                    std::span<const int> columns, std::vector<double>& mean,
                    std::vector<double>& variance) const {
  const std::size_t n = columns.size();
  mean.assign(n, 0.0);
  variance.assign(n, 0.0);
  std::vector<double> replicate(n);
  double replicates = 0.0;
  for (const Stratum& stratum : pixel.strata) {
    std::fill(replicate.begin(), replicate.end(), 0.0);
    double sum = 0.0;
    for (std::uint32_t i : stratum.samples) {
      const double w =
          footprint == nullptr ? 1.0 : footprint->density(x_[i].x - centre.x, x_[i].y - centre.y);
      if (w == 0.0) continue;
      sum += w;
      for (std::size_t c = 0; c < n; ++c)
        replicate[c] += w / sum * (values_[i * stride_ + columns[c]] - replicate[c]);
    }
    if (sum == 0.0) continue;
    replicates += 1.0;
    for (std::size_t c = 0; c < n; ++c) {
      const double d = replicate[c] - mean[c];
      mean[c] += d / replicates;
      variance[c] += d * (replicate[c] - mean[c]);
    }
  }
  for (std::size_t c = 0; c < n; ++c) variance[c] /= std::max(1.0, (replicates - 1.0) * replicates);
}

}  // namespace ifov::sampling
