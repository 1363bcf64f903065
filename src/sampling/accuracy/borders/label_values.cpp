#include "sampling/accuracy/borders/label_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::sampling {

namespace {

/// Values of an uneven label agree where none of their columns has a standard deviation beyond this share of its mean.
constexpr double kAgree = 0.05;
/// So many more are then sought about the place, this far away at first and half as far from one to the next, this many times.
constexpr std::uint32_t kAbout = 24, kDistances = 4;
constexpr double kFarthest_px = 1.0 / 6.0;
/// No more are sought on a material for which the Sun does not matter: so many labels of it have shown that they agree about, or
/// have shown nothing else, as they are too small for many values to meet them.
constexpr std::uint32_t kAgreed = 2, kSought = 8;

/// A point of the same pixel not far from one.
FocalPoint beside(FocalPoint point, std::uint64_t key, std::uint32_t k) {
  const double far_px = kFarthest_px / (1u << k % kDistances) * (0.5 + 0.5 * unit_double(hash(key, k, 1))),
               turn = 2.0 * std::numbers::pi * unit_double(hash(key, k, 2));
  const auto within = [](double at, double from) {
    const double low = std::floor(from);
    return std::clamp(at, low, std::nextafter(low + 1.0, low));
  };
  return {within(point.x_px + far_px * std::cos(turn), point.x_px),
          within(point.y_px + far_px * std::sin(turn), point.y_px), point.time_s};
}

}  // namespace

/// Sums of a label's values.
class LabelValues::Spread {
 public:
  explicit Spread(std::size_t columns) : mean_(columns, 0.0), squares_(columns, 0.0) {}

  void add(const float* value) {
    count_ += 1.0;
    for (std::size_t c = 0; c < mean_.size(); ++c) {
      const double difference = static_cast<double>(value[c]) - mean_[c];
      mean_[c] += difference / count_;
      squares_[c] += difference * (static_cast<double>(value[c]) - mean_[c]);
    }
  }
  double count() const { return count_; }
  bool agree() const {
    for (std::size_t c = 0; c < mean_.size(); ++c)
      if (squares_[c] > kAgree * kAgree * mean_[c] * mean_[c] * (count_ - 1.0)) return false;
    return true;
  }
  std::vector<double> variance() const {
    std::vector<double> variance = squares_;
    for (double& v : variance) v /= count_ - 1.0;
    return variance;
  }

 private:
  double count_ = 0.0;
  std::vector<double> mean_, squares_;
};

bool LabelValues::Agreement::done() const { return !differs && (agreed >= kAgreed || sought >= kSought); }

void LabelValues::take(std::span<const std::uint32_t> labels, std::span<const FocalPoint> points) {
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < labels.size(); ++i) wanted.push_back({labels[i], points[i]});
  while (!wanted.empty()) {
    std::vector<Wanted> next;
    take(wanted, next);
    wanted.swap(next);
  }
}

void LabelValues::take(const std::vector<Wanted>& wanted, std::vector<Wanted>& next) {
  std::vector<Spread> spread(wanted.size(), Spread(table_.columns()));
  std::vector<std::uint8_t> uneven(wanted.size());
  requests_.clear();
  owners_.clear();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Label label = table_.label(wanted[i].label);
    uneven[i] = ledger_.field().uneven(label);
    for (std::uint32_t k = 0; k < (uneven[i] ? kOfUneven : 1); ++k) {
      requests_.push_back({wanted[i].point, hash(seed_, label, 0x6e6577), k});
      owners_.push_back(i);
    }
  }
  ask(wanted, true, spread, next);
  requests_.clear();
  owners_.clear();
  // Paths from one place agree where nearly all of the Sun is seen from it, or nearly nothing, and tell little of what the label
  // is farther across it.
  std::vector<std::uint8_t> sought(wanted.size(), 0);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!uneven[i]) continue;
    Agreement& known = agreement_[ledger_.field().material_of(table_.label(wanted[i].label))];
    if (!spread[i].agree()) known.differs = true;
    if (known.done() || !spread[i].agree()) continue;
    sought[i] = 1;
    ++known.sought;
    const std::uint64_t key = hash(seed_, table_.label(wanted[i].label), 0x61626f7574);
    for (std::uint32_t k = 0; k < kAbout; ++k) {
      requests_.push_back({beside(wanted[i].point, key, k), key, k});
      owners_.push_back(i);
    }
  }
  ask(wanted, false, spread, next);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!sought[i]) continue;
    Agreement& known = agreement_[ledger_.field().material_of(table_.label(wanted[i].label))];
    if (!spread[i].agree())
      known.differs = true;
    else if (spread[i].count() >= 2.0 * kOfUneven)
      ++known.agreed;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (uneven[i]) contrast_.widen_spread(wanted[i].label, spread[i].variance());
}

/// Takes the values that were requested into what is known of their owners' labels: all, as they were asked for where the label was
/// met, or those that met it. `next`: labels that nobody had met before, where they were.
void LabelValues::ask(const std::vector<Wanted>& wanted, bool all, std::vector<Spread>& spread,
                      std::vector<Wanted>& next) {
  if (requests_.empty()) return;
  const std::size_t known = table_.size();
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  values_.resize(requests_.size() * stride);
  ledger_.first_values(requests_, met_, values_);
  for (std::size_t k = 0; k < requests_.size(); ++k) {
    if (met_[k] >= known &&
        std::none_of(next.begin(), next.end(), [&](const Wanted& w) { return w.label == met_[k]; }))
      next.push_back({met_[k], requests_[k].point});
    const std::uint32_t label = wanted[owners_[k]].label;
    if (!all && met_[k] != label) continue;
    table_.add(label, &values_[k * stride]);
    spread[owners_[k]].add(&values_[k * stride]);
  }
}

}  // namespace ifov::sampling
