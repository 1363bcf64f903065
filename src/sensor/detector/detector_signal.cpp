#include "sensor/detector/detector_signal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sampling/hash.h"
#include "sensor/detector/blooming.h"
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
  correction,
};

std::vector<double> column_pattern(const Detector& detector, Purpose purpose, int channel, int columns,
                                   double spread) {
  if (!(spread > 0.0)) return {};
  std::vector<double> values(static_cast<std::size_t>(columns));
  keyed_normals(sampling::hash(purpose, static_cast<std::uint64_t>(detector.specimen), channel), 0, values);
  for (double& value : values) value *= spread;
  return values;
}

/// Mean electrons of `of` by the elements from `first` on, on which the shares `light` of it fall (empty: all).
template <class Pattern>
void mean_electrons(const Detector& detector, const Pattern& pattern, std::size_t first,
                    std::span<const double> light, std::span<const float> of, std::span<double> electrons) {
  for (std::size_t k = 0; k < of.size(); ++k)
    electrons[k] = detector.background + (light.empty() ? 1.0 : light[first + k]) *
                                             detector.electrons_per_radiance *
                                             std::max(static_cast<double>(of[k]), 0.0);
  if (detector.has_pattern())
    pattern.electrons(first, electrons);
  else
    for (double& one : electrons) one += detector.dark;
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
    if (varies) element_normals(Purpose::prnu, first, std::span(normal).first(values.size()));
    const bool faulty = detector.dead_share > 0.0 || detector.hot_share > 0.0;
    const std::uint64_t fault = element_key(Purpose::fault);
    for (std::size_t k = 0; k < values.size(); ++k) {
      double gain = 1.0 + row_gain_, dark = detector.dark;
      if (varies) gain += detector.prnu * normal[k];
      if (!of_.column_gain_.empty()) gain += of_.column_gain_[first + k];
      if (faulty) {
        const double lot = keyed_uniform(fault, column(first + k));
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
    if (spread > 0.0) element_normals(Purpose::dsnu, first, std::span(normal).first(signal.size()));
    for (std::size_t k = 0; k < signal.size(); ++k) {
      signal[k] += row_offset_;
      if (spread > 0.0) signal[k] += spread * normal[k];
      if (!of_.column_offset_.empty()) signal[k] += of_.column_offset_[first + k];
    }
  }

  /// Of the elements that see the pixels from `first` on, which is the same one in all of a sweep.
  void element_normals(Purpose purpose, std::size_t first, std::span<double> values) const {
    if (of_.read_out_.kind != ReadOut::Kind::sweeps)
      return keyed_normals(element_key(purpose), first, values);
    keyed_normals(element_key(purpose), first >> 32 << 32, values.first(1));
    std::fill(values.begin() + 1, values.end(), values.front());
  }

 private:
  std::uint64_t key(Purpose purpose) const {
    return sampling::hash(purpose, static_cast<std::uint64_t>(of_.detector_.specimen), of_.channel_, line_);
  }
  std::uint64_t element_key(Purpose purpose) const {
    return sampling::hash(purpose, static_cast<std::uint64_t>(of_.detector_.specimen), of_.channel_,
                          of_.read_out_.element_line(line_));
  }
  std::size_t column(std::size_t x) const { return of_.read_out_.kind == ReadOut::Kind::sweeps ? 0 : x; }

  const DetectorSignal& of_;
  int line_;
  double row_gain_ = 0.0, row_offset_ = 0.0;
};

DetectorSignal::DetectorSignal(const Detector& detector, std::uint64_t seed, int channel, int columns,
                               const ReadOut& read_out, const Illumination& illumination)
    : detector_(detector),
      seed_(seed),
      channel_(channel),
      read_out_(read_out),
      illumination_(illumination),
      column_gain_(column_pattern(detector, Purpose::column_gain, channel, columns, detector.column_gain)),
      column_offset_(
          column_pattern(detector, Purpose::column_offset, channel, columns, detector.column_offset)) {}

double DetectorSignal::well() const {
  return detector_.full_well > 0.0 ? detector_.full_well : std::numeric_limits<double>::infinity();
}

/// Of mean electrons, the signal, where wells do not run over.
void DetectorSignal::collect_and_read(std::uint64_t key, std::uint64_t first,
                                      std::span<double> signal) const {
  constexpr double kOftenRead = 1.0;    // electrons from which on nobody sees that photons come one by one
  constexpr double kFarFromWell = 8.0;  // standard deviations
  const double read = detector_.read_noise, holds = well();
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
    if (read >= kOftenRead && mean >= kManyEvents && mean + kFarFromWell * spread < holds &&
        !(detector_.nonlinearity > 0.0)) {
      signal[k] = noisy_count(mean, read * read, normal[k]);
      continue;
    }
    double electrons = std::min(poisson(mean, uniform[k], normal[k]), holds);
    if (detector_.nonlinearity > 0.0) electrons *= 1.0 - detector_.nonlinearity * electrons / holds;
    if (read > 0.0 && !has_read_normals) {
      keyed_normals(sampling::extend(key, Purpose::read_noise), first, read_normal);
      has_read_normals = true;
    }
    signal[k] = electrons + (read > 0.0 ? read * read_normal[k] : 0.0);
  }
}

void DetectorSignal::draw(int line, std::span<const float> radiance, std::span<const float> drift,
                          std::span<double> signal) const {
  if (detector_.blooming > 0.0) {
    collect(line, radiance, signal);
    if (read_out_.kind == ReadOut::Kind::lines)
      run_over(signal, 0, 1, signal.size(), detector_.full_well, detector_.blooming);
    return read(line, radiance, drift, signal);
  }
  const std::uint64_t key = sampling::hash(Purpose::electrons, seed_, channel_, line);
  const bool has_pattern = detector_.has_pattern();
  const Pattern pattern(*this, line);
  const std::vector<double> light = illumination_.of_line(line);
  for (std::size_t first = 0; first < signal.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, signal.size() - first);
    const std::span<double> part = signal.subspan(first, count);
    const std::span<const float> of = radiance.subspan(first, count);
    mean_electrons(detector_, pattern, first, light, of, part);
    collect_and_read(key, first, part);
    if (has_pattern) pattern.add_offsets(first, part);
    if (!drift.empty())
      for (std::size_t k = 0; k < count; ++k) part[k] += static_cast<double>(drift[first + k]);
    for (std::size_t k = 0; k < count; ++k)
      if (std::isnan(of[k])) part[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

void DetectorSignal::collect(int line, std::span<const float> radiance, std::span<double> electrons) const {
  const std::uint64_t key = sampling::hash(Purpose::electrons, seed_, channel_, line);
  const Pattern pattern(*this, line);
  const std::vector<double> light = illumination_.of_line(line);
  Values uniforms, normals;
  for (std::size_t first = 0; first < electrons.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, electrons.size() - first);
    const std::span<double> part = electrons.subspan(first, count);
    mean_electrons(detector_, pattern, first, light, radiance.subspan(first, count), part);
    const std::span uniform = std::span(uniforms).first(count), normal = std::span(normals).first(count);
    keyed_uniforms(key, first, uniform);
    std::copy(uniform.begin(), uniform.end(), normal.begin());
    math::normal_quantiles(normal);
    for (std::size_t k = 0; k < count; ++k) part[k] = poisson(part[k], uniform[k], normal[k]);
  }
}

void DetectorSignal::read(int line, std::span<const float> radiance, std::span<const float> drift,
                          std::span<double> signal) const {
  const std::uint64_t key =
      sampling::extend(sampling::hash(Purpose::electrons, seed_, channel_, line), Purpose::read_noise);
  const Pattern pattern(*this, line);
  Values normals;
  for (std::size_t first = 0; first < signal.size(); first += kAtOnce) {
    const std::span<double> part = signal.subspan(first, std::min(kAtOnce, signal.size() - first));
    const std::span normal = std::span(normals).first(part.size());
    if (detector_.read_noise > 0.0) keyed_normals(key, first, normal);
    for (std::size_t k = 0; k < part.size(); ++k) {
      double electrons = std::min(part[k], well());
      if (detector_.nonlinearity > 0.0) electrons *= 1.0 - detector_.nonlinearity * electrons / well();
      part[k] = electrons + (detector_.read_noise > 0.0 ? detector_.read_noise * normal[k] : 0.0);
    }
    if (detector_.has_pattern()) pattern.add_offsets(first, part);
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (!drift.empty()) part[k] += static_cast<double>(drift[first + k]);
      if (std::isnan(radiance[first + k])) part[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void DetectorSignal::correct(int line, std::span<double> signal) const {
  if (!detector_.is_corrected()) return;
  constexpr double kAnswers =
      0.1;  // of the response of an element without faults, or it is none to be corrected
  const Pattern pattern(*this, line);
  const std::vector<double> shares = illumination_.of_line(line);
  std::array<float, kAtOnce> light;
  Values low, high, normals;
  const double low_ideal = detector_.mean_electrons(detector_.nuc_low),
               high_ideal = detector_.mean_electrons(detector_.nuc_high);
  // What each element tells of a light on average, and what is left of noise in the mean of so many exposures.
  const auto measured = [&](std::size_t first, double radiance, std::uint64_t which, std::span<double> told) {
    light.fill(static_cast<float>(radiance));
    mean_electrons(detector_, pattern, first, shares, std::span(light).first(told.size()), told);
    const std::span normal = std::span(normals).first(told.size());
    pattern.element_normals(Purpose::correction, first + (which << 32), normal);
    for (std::size_t k = 0; k < told.size(); ++k) {
      const double variance =
          told[k] + detector_.read_noise * detector_.read_noise + detector_.gain * detector_.gain / 12.0;
      double held = std::min(told[k], well());
      if (detector_.nonlinearity > 0.0) held *= 1.0 - detector_.nonlinearity * held / well();
      told[k] = held + std::sqrt(std::max(variance, 0.0) / detector_.nuc_frames) * normal[k];
    }
    if (detector_.has_pattern()) pattern.add_offsets(first, told);
  };
  for (std::size_t first = 0; first < signal.size(); first += kAtOnce) {
    const std::span<double> part = signal.subspan(first, std::min(kAtOnce, signal.size() - first));
    measured(first, detector_.nuc_low, 1, std::span(low).first(part.size()));
    measured(first, detector_.nuc_high, 2, std::span(high).first(part.size()));
    for (std::size_t k = 0; k < part.size(); ++k) {
      const double answer = (high[k] - low[k]) / (high_ideal - low_ideal);
      if (answer > kAnswers * (shares.empty() ? 1.0 : shares[first + k]))
        part[k] = low_ideal + (part[k] - low[k]) / answer;
    }
  }
}

}  // namespace ifov::sensor
