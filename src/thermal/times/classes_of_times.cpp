#include "thermal/times/classes_of_times.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

#include "thermal/times/node_of_times.h"

namespace ifov::thermal {
namespace {

constexpr std::size_t kRegister = 8;  // floats
constexpr double kOnRow = 1e-6;       // steps that a row may be off
// Bins that a time needs if they were its own. A ray to each counts by w_k at all times; two are sent to each of five strata of one alone,
// which tell half as much of what lies within them.
constexpr double kBinsAlone = 3.0, kMostBins = 64.0;
constexpr double kEven =
    0.05;  // of what is drawn, by length: what is little worth to the level surface is met, too

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

math::Vec3 sun_of_row(const Outdoors& now) {
  const double level = std::cos(now.sun_elevation_rad);
  return {level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
          std::sin(now.sun_elevation_rad)};
}

}  // namespace

ClassesOfTimes::~ClassesOfTimes() = default;

bool ClassesOfTimes::serves(std::span<const std::shared_ptr<const SurfaceClasses>> by_time) {
  const OutdoorsSeries& first = *by_time.front()->series_;
  return std::all_of(by_time.begin(), by_time.end(), [&](const auto& one) {
    const OutdoorsSeries& series = *one->series_;
    const double steps = (series.begin_s - first.begin_s) / first.step_s;
    return series.step_s == first.step_s && std::abs(steps - std::round(steps)) < kOnRow &&
           one->of_free_sky_w_m2_.empty() && one->places_.size() == by_time.front()->places_.size();
  });
}

ClassesOfTimes::ClassesOfTimes(std::vector<std::shared_ptr<const SurfaceClasses>> by_time)
    : classes_(std::move(by_time)),
      lanes_((classes_.size() + kRegister - 1) / kRegister * kRegister),
      id_(next_id()),
      places_(classes_.front()->places_.size()) {
  const double step_s = classes_.front()->step_s();
  double begin_s = classes_.front()->series_->begin_s;
  for (const auto& one : classes_) begin_s = std::min(begin_s, one->series_->begin_s);
  std::vector<std::size_t> first;
  std::size_t rows = 0;
  for (const auto& one : classes_) {
    // One row before the first, of which half a triangle lies before it.
    first.push_back(1 + static_cast<std::size_t>(std::llround((one->series_->begin_s - begin_s) / step_s)));
    last_row_.push_back(first.back() + one->rows() - 1);
    rows = std::max(rows, last_row_.back() + 1);
  }
  sun_.resize(rows);
  is_lit_.assign(rows, false);
  std::vector<bool> known(rows, false);
  sunlit_.assign(classes_.size(), std::vector<std::int32_t>(rows, -1));
  for (std::size_t t = 0; t < classes_.size(); ++t) {
    const auto& series = classes_[t]->series_->rows;
    for (std::size_t i = 0; i < series.size(); ++i)
      if (!known[first[t] + i]) sun_[first[t] + i] = sun_of_row(series[i]), known[first[t] + i] = true;
    for (std::size_t k = 0; k < classes_[t]->rows_.size(); ++k) {
      const std::size_t row = first[t] + classes_[t]->rows_[k].index;
      sunlit_[t][row] = static_cast<std::int32_t>(k);
      is_lit_[row] = true;
    }
  }
  sun_[0] = sun_[1];
  for (std::size_t row = 0; row + 1 < rows; ++row)
    if (known[row + 1] && (is_lit_[row] || is_lit_[row + 1]))
      spans_.push_back(
          {.left = static_cast<std::uint32_t>(row), .right = static_cast<std::uint32_t>(row + 1)});
  make_bins();
}

void ClassesOfTimes::make_bins() {
  if (spans_.empty()) return;
  // What a span is worth to a level surface, of all that the past is worth to each time.
  std::vector<double> of_all(spans_.size(), 0.0);
  std::vector<std::vector<double>> of_time;
  for (std::size_t t = 0; t < classes_.size(); ++t) {
    const SurfaceClasses::Node& level = classes_[t]->node_at(0);
    const auto gain = [&](std::size_t row, bool right) {
      const std::int32_t k = sunlit_[t][row];
      if (k < 0 || (!right && row >= last_row_[t])) return 0.0;
      const auto n = static_cast<std::size_t>(k);
      return (right && row == last_row_[t] ? 2.0 : 1.0) * 0.5 *
             static_cast<double>(level.kernel[0][n] + level.kernel[1][n]) *
             classes_[t]->rows_[n].absorbed_w_m2;
    };
    std::vector<double> one;
    double sum = 0.0;
    for (const Span& span : spans_) {
      one.push_back(gain(span.left, false) + gain(span.right, true));
      sum += one.back();
    }
    if (!(sum > 0.0)) continue;
    for (std::size_t e = 0; e < one.size(); ++e) of_all[e] += one[e] /= sum;
    of_time.push_back(std::move(one));
  }
  const double even = kEven / static_cast<double>(spans_.size());
  for (double& share : of_all)
    share =
        of_time.empty() ? even / kEven : even + (1.0 - kEven) * share / static_cast<double>(of_time.size());
  double most = 1.0;
  for (const std::vector<double>& one : of_time) {
    double needs = 0.0;
    for (std::size_t e = 0; e < one.size(); ++e) needs += one[e] * one[e] / of_all[e];
    most = std::max(most, needs);
  }
  const double count = std::min(kMostBins, std::ceil(kBinsAlone * most));
  double before = 0.0, in_bin = 0.0;
  Bin bin;
  for (std::size_t e = 0; e < spans_.size(); ++e) {
    in_bin += of_all[e];
    before += of_all[e];
    const bool last = e + 1 == spans_.size();
    // A bin ends where that lies nearest to an even share.
    const double here = std::floor(before * count + 0.5 * (last ? 0.0 : of_all[e + 1] * count));
    if (!last && here < static_cast<double>(bins_.size() + 1)) continue;
    bin.end = static_cast<std::uint32_t>(e + 1);
    double until = 0.0;
    for (std::uint32_t k = bin.first; k < bin.end; ++k) {
      spans_[k].density = of_all[k] / in_bin;
      spans_[k].until = until += spans_[k].density;
      for (const std::uint32_t row : {spans_[k].left, spans_[k].right})
        if (is_lit_[row]) bin.suns.push_back(sun_[row]);
    }
    // A time that was over when a bin began has nothing of it.
    const std::uint32_t begins = spans_[bin.first].left;
    const auto lane =
        std::find_if(last_row_.begin(), last_row_.end(), [&](std::size_t row) { return row > begins; }) -
        last_row_.begin();
    bin.first_lane = static_cast<std::uint32_t>(static_cast<std::size_t>(lane) / kRegister * kRegister);
    for (std::uint32_t k = bin.first; k < bin.end; ++k) spans_[k].first_lane = bin.first_lane;
    bins_.push_back(bin);
    bin = {bin.end, bin.end, 0, {}};
    in_bin = 0.0;
  }
}

ClassesOfTimes::Moment ClassesOfTimes::draw(std::size_t bin, double u) const {
  const auto first = spans_.begin() + bins_[bin].first, last = spans_.begin() + bins_[bin].end - 1;
  const auto found =
      std::upper_bound(first, last, u, [](double x, const Span& span) { return x < span.until; });
  const double before = found == first ? 0.0 : (found - 1)->until;
  return {static_cast<std::uint32_t>(found - spans_.begin()),
          static_cast<float>(std::clamp((u - before) / found->density, 0.0, 1.0))};
}

math::Vec3 ClassesOfTimes::towards_sun(const Moment& moment) const {
  const Span& span = spans_[moment.span];
  const double after = static_cast<double>(moment.within);
  const math::Vec3 between = (1.0 - after) * sun_[span.left] + after * sun_[span.right];
  return (1.0 / std::sqrt(math::dot(between, between))) * between;
}

const NodeOfTimes& ClassesOfTimes::node_at(std::size_t number) const {
  Place& place = places_[number];
  if (!place.filled.load(std::memory_order_acquire))
    std::call_once(place.once, [&] {
      fill(place.node, number);
      place.filled.store(true, std::memory_order_release);
    });
  return place.node;
}

void ClassesOfTimes::fill(NodeOfTimes& node, std::size_t place) const {
  for (std::size_t sky = 0; sky < 2; ++sky) {
    for (std::vector<float>* of : {&node.left[sky], &node.right[sky]}) of->assign(sun_.size() * lanes_, 0.0f);
    for (std::vector<float>* of : {&node.shaded_k[sky], &node.ratio[sky]}) of->assign(lanes_, 0.0f);
    node.moment[sky].assign(3 * bins() * lanes_, 0.0f);
    node.sum[sky].assign(bins() * lanes_, 0.0f);
  }
  node.difference.assign(bins() * lanes_, 0.0f);
  for (std::size_t t = 0; t < classes_.size(); ++t) {
    const SurfaceClasses::Node& own = classes_[t]->node_at(place);
    for (std::size_t sky = 0; sky < 2; ++sky) {
      node.shaded_k[sky][t] = static_cast<float>(own.shaded_k[sky]);
      node.ratio[sky][t] = static_cast<float>(own.ratio[sky]);
      for (std::size_t row = 0; row < sun_.size(); ++row) {
        if (sunlit_[t][row] < 0) continue;
        const auto k = static_cast<std::size_t>(sunlit_[t][row]);
        const bool last = row == last_row_[t];
        const auto gain =
            static_cast<float>(classes_[t]->rows_[k].absorbed_w_m2 * static_cast<double>(own.kernel[sky][k]));
        node.left[sky][row * lanes_ + t] = last ? 0.0f : gain;
        node.right[sky][row * lanes_ + t] = last ? 2.0f * gain : gain;
      }
    }
  }
  for (std::size_t b = 0; b < bins(); ++b)
    for (std::uint32_t e = bins_[b].first; e < bins_[b].end; ++e)
      for (const bool right : {false, true})
        add_to_bin(node, place, b, right ? spans_[e].right : spans_[e].left, right);
}

void ClassesOfTimes::add_to_bin(NodeOfTimes& node, std::size_t place, std::size_t bin, std::size_t row,
                                bool right) const {
  const std::array<float, 3> way{static_cast<float>(0.5 * sun_[row].x), static_cast<float>(0.5 * sun_[row].y),
                                 static_cast<float>(0.5 * sun_[row].z)};
  for (std::size_t sky = 0; sky < 2; ++sky) {
    const float* gain = row_of((right ? node.right : node.left)[sky], row);
    for (std::size_t t = 0; t < lanes_; ++t) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        node.moment[sky][(3 * bin + axis) * lanes_ + t] += way[axis] * gain[t];
      node.sum[sky][bin * lanes_ + t] += 0.5f * gain[t];
    }
  }
  for (std::size_t t = 0; t < classes_.size(); ++t) {
    const bool last = row == last_row_[t];
    if (sunlit_[t][row] < 0 || (last && !right)) continue;
    const auto k = static_cast<std::size_t>(sunlit_[t][row]);
    const SurfaceClasses::Node& own = classes_[t]->node_at(place);
    for (std::size_t sky = 0; sky < 2; ++sky)
      node.difference[bin * lanes_ + t] +=
          static_cast<float>((last ? 0.5 : 0.25) * classes_[t]->rows_[k].absorbed_w_m2 *
                             (1.0 + 2.0 * own.shift[sky]) * static_cast<double>(own.difference[sky][k]));
  }
}

}  // namespace ifov::thermal
