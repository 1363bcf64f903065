#include "platform/wander.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "platform/power_spectrum.h"
#include "sampling/random.h"

namespace ifov::platform {
namespace {

constexpr int kWaves = 256, kSamplesAPeriod = 20, kBlock = 64;
constexpr std::uint64_t kPurpose = 0x6a697474'65720000ull;

struct Wave {
  double frequency_hz = 0.0, phase_rad = 0.0;
};

std::vector<Wave> waves_of(const PowerSpectrum& spectrum, std::uint64_t seed, std::uint64_t stream,
                           std::uint64_t component) {
  std::vector<Wave> waves;
  for (std::uint64_t k = 0; k < kWaves; ++k) {
    const std::uint64_t key = sampling::hash(seed, kPurpose, stream, component, k);
    const double share = (static_cast<double>(k) + sampling::unit_double(key)) / kWaves;
    waves.push_back({spectrum.frequency_of(share),
                     2.0 * std::numbers::pi * sampling::unit_double(sampling::extend(key, 1))});
  }
  return waves;
}

}  // namespace

Wander::Wander(std::span<const PowerSpectrum> spectra, std::uint64_t seed, std::uint64_t stream,
               double from_s, double to_s)
    : components_(spectra.size()), step_s_(std::numeric_limits<double>::infinity()) {
  double highest_hz = 0.0;
  for (const PowerSpectrum& spectrum : spectra)
    if (spectrum.rms() > 0.0) highest_hz = std::max(highest_hz, spectrum.highest_hz());
  if (!(highest_hz > 0.0)) return;
  step_s_ = 1.0 / (kSamplesAPeriod * highest_hz);
  // Whole blocks of samples at multiples of the step, so that a value does not depend on the span; a block more at both ends, where
  // the spline's ends are of no account any more.
  constexpr double kMost = 1e6;
  const double first_block = std::floor(from_s / (kBlock * step_s_)) - 1.0,
               last_block = std::ceil(to_s / (kBlock * step_s_)) + 1.0;
  if (!(kBlock * (last_block - first_block) <= kMost))
    throw InputError(format(
        "motion of up to {:g} Hz over {:g} s takes {:.3g} samples; expected at most {:g}: a lower frequency, or fewer lines",
        highest_hz, to_s - from_s, kBlock * (last_block - first_block), kMost));
  const auto blocks = static_cast<std::int64_t>(last_block - first_block);
  const auto samples = static_cast<std::size_t>(blocks * kBlock);
  std::vector<double> times(samples), values(samples * components_, 0.0);
  for (std::size_t i = 0; i < samples; ++i)
    times[i] = (first_block * kBlock + static_cast<double>(i)) * step_s_;
  for (std::size_t c = 0; c < components_; ++c) {
    if (!(spectra[c].rms() > 0.0)) continue;
    const double amplitude = spectra[c].rms() * std::sqrt(2.0 / kWaves);
    for (const Wave& wave : waves_of(spectra[c], seed, stream, c)) {
      const std::complex<double> turn = std::polar(1.0, 2.0 * std::numbers::pi * wave.frequency_hz * step_s_);
      std::complex<double> now;
      for (std::size_t i = 0; i < samples; ++i) {
        if (i % kBlock == 0) {
          const double turns = wave.frequency_hz * times[i];
          now = std::polar(amplitude, 2.0 * std::numbers::pi * (turns - std::floor(turns)) + wave.phase_rad);
        }
        values[i * components_ + c] += now.real();
        now *= turn;
      }
    }
  }
  spline_.emplace(std::move(times), std::move(values));
}

void Wander::at(double time_s, std::span<double> values) const {
  if (spline_)
    spline_->at(time_s, values);
  else
    std::fill(values.begin(), values.end(), 0.0);
}

}  // namespace ifov::platform
