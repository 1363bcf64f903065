#include "sensor/detector/detector_signal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sampling/hash.h"
#include "sensor/detector/keyed_normals.h"
#include "sensor/detector/poisson.h"

namespace ifov::sensor {
namespace {

constexpr std::size_t kAtOnce = 256;
using Values = std::array<double, kAtOnce>;

/// What random numbers are for.
enum class Purpose : std::uint64_t {
  electrons = 0x656c656374726f6eull,  // beside other random numbers of the same seed
  read_noise,
  prnu,
  dsnu,
  fault,
  row,
  column_gain,
  column_offset,
};

std::vector<double> column_pattern(const Detector& detector, Purpose purpose, int channel, int columns,
                                   double spread) {
  if (!(spread > 0.0)) return {};
  std::vector<double> values(static_cast<std::size_t>(columns));
  keyed_normals(sampling::hash(purpose, static_cast<std::uint64_t>(detector.specimen), channel), 0, values);
  for (double& value : values) value *= spread;
  return values;
}

}  // namespace

/// What is fixed: of the elements of one line.
class DetectorSignal::Pattern {
 public:
  Pattern(const DetectorSignal& of, int line) : of_(of), line_(line) {
    if (of.detector_.row_gain <= 0.0 && of.detector_.row_offset <= 0.0) return;
    std::array<double, 2> row;
    keyed_normals(key(Purpose::row), 0, row);
    row_gain_ = of.detector_.row_gain * row[0];
    row_offset_ = of.detector_.row_offset * row[1];
  }

  /// Light and dark electrons together of the elements from `first` on, where `values` are their light's.
  void electrons(std::size_t first, std::span<double> values) const {
    const Detector& detector = of_.detector_;
    Values normal;
    const bool varies = detector.prnu > 0.0;
    if (varies) keyed_normals(key(Purpose::prnu), first, std::span(normal).first(values.size()));
    const bool faulty = detector.dead_share > 0.0 || detector.hot_share > 0.0;
    const std::uint64_t fault = key(Purpose::fault);
    for (std::size_t k = 0; k < values.size(); ++k) {
      double gain = 1.0 + row_gain_, dark = detector.dark;
      if (varies) gain += detector.prnu * normal[k];
      if (!of_.column_gain_.empty()) gain += of_.column_gain_[first + k];
      if (faulty) {
        const double lot = keyed_uniform(fault, first + k);
        if (lot < detector.dead_share)
          gain = 0.0;
        else if (lot < detector.dead_share + detector.hot_share)
          dark = detector.hot_dark;
      }
      values[k] = std::max(gain, 0.0) * values[k] + dark;
    }
  }

  void add_offsets(std::size_t first, std::span<double> signal) const {
    Values normal;
    const double spread = of_.detector_.dsnu;
    if (spread > 0.0) keyed_normals(key(Purpose::dsnu), first, std::span(normal).first(signal.size()));
    for (std::size_t k = 0; k < signal.size(); ++k) {
      signal[k] += row_offset_;
      if (spread > 0.0) signal[k] += spread * normal[k];
      if (!of_.column_offset_.empty()) signal[k] += of_.column_offset_[first + k];
    }
  }

 private:
  std::uint64_t key(Purpose purpose) const {
    return sampling::hash(purpose, static_cast<std::uint64_t>(of_.detector_.specimen), of_.channel_, line_);
  }

  const DetectorSignal& of_;
  int line_;
  double row_gain_ = 0.0, row_offset_ = 0.0;
};

DetectorSignal::DetectorSignal(const Detector& detector, std::uint64_t seed, int channel, int columns)
    : detector_(detector),
      seed_(seed),
      channel_(channel),
      column_gain_(column_pattern(detector, Purpose::column_gain, channel, columns, detector.column_gain)),
      column_offset_(
          column_pattern(detector, Purpose::column_offset, channel, columns, detector.column_offset)) {}

/// Of mean electrons, the signal.
void DetectorSignal::collect(std::uint64_t key, std::uint64_t first, std::span<double> signal) const {
  constexpr double kOftenRead = 1.0;    // electrons from which on nobody sees that photons come one by one
  constexpr double kFarFromWell = 8.0;  // standard deviations
  const double read = detector_.read_noise;
  const double well =
      detector_.full_well > 0.0 ? detector_.full_well : std::numeric_limits<double>::infinity();
  Values held, normals, reads;
  const std::span uniform = std::span(held).first(signal.size());
  keyed_uniforms(key, first, uniform);
  const std::span normal = std::span(normals).first(signal.size());
  std::copy(uniform.begin(), uniform.end(), normal.begin());
  math::normal_quantiles(normal);
  const std::span read_normal = std::span(reads).first(signal.size());
  bool has_read_normals = false;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double mean = signal[k];
    const double spread = std::sqrt(mean + read * read);
    if (read >= kOftenRead && mean >= kManyEvents && mean + kFarFromWell * spread < well &&
        !(detector_.nonlinearity > 0.0)) {
      signal[k] = noisy_count(mean, read * read, normal[k]);
      continue;
    }
    double electrons = std::min(poisson(mean, uniform[k], normal[k]), well);
    if (detector_.nonlinearity > 0.0) electrons *= 1.0 - detector_.nonlinearity * electrons / well;
    if (read > 0.0 && !has_read_normals) {
      keyed_normals(sampling::extend(key, Purpose::read_noise), first, read_normal);
      has_read_normals = true;
    }
    signal[k] = electrons + (read > 0.0 ? read * read_normal[k] : 0.0);
  }
}

void DetectorSignal::draw(int line, std::span<const float> radiance, std::span<const float> drift,
                          std::span<double> signal) const {
  const std::uint64_t key = sampling::hash(Purpose::electrons, seed_, channel_, line);
  const bool has_pattern = detector_.has_pattern();
  const Pattern pattern(*this, line);
  for (std::size_t first = 0; first < signal.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, signal.size() - first);
    const std::span<double> part = signal.subspan(first, count);
    const std::span<const float> of = radiance.subspan(first, count);
    for (std::size_t k = 0; k < count; ++k)
      part[k] =
          detector_.background + detector_.electrons_per_radiance * std::max(static_cast<double>(of[k]), 0.0);
    if (has_pattern)
      pattern.electrons(first, part);
    else
      for (double& electrons : part) electrons += detector_.dark;
    collect(key, first, part);
    if (has_pattern) pattern.add_offsets(first, part);
    if (!drift.empty())
      for (std::size_t k = 0; k < count; ++k) part[k] += drift[first + k];
    for (std::size_t k = 0; k < count; ++k)
      if (std::isnan(of[k])) part[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace ifov::sensor
