#include "materials/parameter_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/bsdf/bsdf.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {
namespace {

constexpr int kAcross = 32;  // directions along each side of the unit square
constexpr std::size_t kMostWavelengths = 12;
constexpr double kNoLight = 1e-4;  // of a side that sends on less nothing is asked

/// A model with its parameters at some wavelengths.
class Sampled {
 public:
  Sampled(const Bsdf& bsdf, const std::vector<double>& um) : bsdf_(bsdf), values_(um.size()) {
    for (const radiometry::Spectrum& spectrum : bsdf.spectra()) {
      std::vector<float>& row = rows_.emplace_back();
      for (const double at : um) row.push_back(static_cast<float>(spectrum.at(at)));
    }
    for (const std::vector<float>& row : rows_) pointers_.push_back(row.data());
  }
  const std::vector<float>& at(const BsdfEvent& event) {
    bsdf_.evaluate(event, pointers_, values_.size(), values_.data());
    return values_;
  }

 private:
  const Bsdf& bsdf_;
  std::vector<std::vector<float>> rows_;
  std::vector<const float*> pointers_;
  std::vector<float> values_;
};

std::vector<double> some_wavelengths(std::initializer_list<const Bsdf*> models) {
  std::vector<const radiometry::Spectrum*> spectra;
  for (const Bsdf* model : models)
    for (const radiometry::Spectrum& spectrum : model->spectra()) spectra.push_back(&spectrum);
  const std::vector<double> all = radiometry::common_wavelengths(spectra).um;
  if (all.empty()) return {1.0};
  std::vector<double> some;
  const std::size_t count = std::min(all.size(), kMostWavelengths);
  for (std::size_t k = 0; k < count; ++k)
    some.push_back(all[k * (all.size() - 1) / std::max<std::size_t>(1, count - 1)]);
  return some;
}

/// One of an interval between levels, by the position of its ends among the values that occur.
struct Gap {
  std::size_t low = 0, high = 0, middle = 0;
  LevelError error;
  double badness() const {
    return std::max(error.reflectance / kLevelTolerance.reflectance,
                    error.direction / kLevelTolerance.direction);
  }
};

}  // namespace

LevelError level_error(const Bsdf& low, const Bsdf& high, double share, const Bsdf& exact) {
  if (exact.is_separable()) return {};
  const std::vector<double> um = some_wavelengths({&low, &high, &exact});
  Sampled below(low, um), above(high, um), between(exact, um);
  const int across = exact.is_delta() ? 1 : kAcross;
  LevelError worst;
  for (const double zenith_deg : {20.0, 50.0, 75.0})
    for (const Side side : {Side::reflected, Side::transmitted}) {
      if (side == Side::transmitted && !exact.may_transmit()) continue;
      const double zenith = zenith_deg * std::numbers::pi / 180.0;
      BsdfEvent event;
      event.outgoing = {std::sin(zenith), 0.0, std::cos(zenith)};
      event.normal = {0.0, 0.0, 1.0};
      event.tangent = {1.0, 0.0, 0.0};
      event.side = side;
      std::vector<double> whole(um.size(), 0.0), excess(um.size(), 0.0), elsewhere(um.size(), 0.0);
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
          const BsdfSample sample = exact.sample(event, (i + 0.5) / across, (j + 0.5) / across);
          if (!(sample.weight > 0.0)) continue;
          event.incoming = sample.incoming;
          const std::vector<float>&f0 = below.at(event), &f1 = above.at(event), &f = between.at(event);
          for (std::size_t n = 0; n < um.size(); ++n) {
            const double mixed =
                (1.0 - share) * static_cast<double>(f0[n]) + share * static_cast<double>(f1[n]);
            const double difference = sample.weight * (mixed - static_cast<double>(f[n]));
            whole[n] += sample.weight * static_cast<double>(f[n]);
            excess[n] += difference;
            elsewhere[n] += std::abs(difference);
          }
        }
      for (std::size_t n = 0; n < um.size(); ++n) {
        if (!(whole[n] > kNoLight * across * across)) continue;
        worst.reflectance = std::max(worst.reflectance, std::abs(excess[n]) / whole[n]);
        worst.direction = std::max(worst.direction, elsewhere[n] / whole[n]);
      }
    }
  return worst;
}

ParameterLevels place_levels(std::span<const double> values, std::size_t most,
                             const std::function<std::vector<std::shared_ptr<const Bsdf>>(double)>& make) {
  std::vector<std::vector<std::shared_ptr<const Bsdf>>> made(values.size());
  const auto at = [&](std::size_t index) -> const std::vector<std::shared_ptr<const Bsdf>>& {
    if (made[index].empty()) made[index] = make(values[index]);
    return made[index];
  };
  std::vector<Gap> gaps;
  const auto add = [&](std::size_t low, std::size_t high) {
    Gap gap{low, high, low, {}};
    if (high - low > 1) {
      const double middle = 0.5 * (values[low] + values[high]);
      const auto above = std::lower_bound(values.begin() + static_cast<std::ptrdiff_t>(low),
                                          values.begin() + static_cast<std::ptrdiff_t>(high), middle);
      auto index = static_cast<std::size_t>(above - values.begin());
      if (index > low && middle - values[index - 1] < values[index] - middle) --index;
      gap.middle = std::clamp(index, low + 1, high - 1);
      const double share = (values[gap.middle] - values[low]) / (values[high] - values[low]);
      for (std::size_t k = 0; k < at(low).size(); ++k) {
        const LevelError error = level_error(*at(low)[k], *at(high)[k], share, *at(gap.middle)[k]);
        gap.error.reflectance = std::max(gap.error.reflectance, error.reflectance);
        gap.error.direction = std::max(gap.error.direction, error.direction);
      }
    }
    gaps.push_back(gap);
  };
  ParameterLevels levels;
  if (values.size() == 1) {
    levels.values = {values.front()};
    return levels;
  }
  add(0, values.size() - 1);
  while (gaps.size() + 1 < most) {
    const auto worst = std::max_element(gaps.begin(), gaps.end(),
                                        [](const Gap& a, const Gap& b) { return a.badness() < b.badness(); });
    if (worst->badness() <= 1.0) break;
    const Gap gap = *worst;
    gaps.erase(worst);
    add(gap.low, gap.middle);
    add(gap.middle, gap.high);
  }
  levels.values.push_back(values.front());
  for (const Gap& gap : gaps) {
    levels.values.push_back(values[gap.high]);
    levels.worst.reflectance = std::max(levels.worst.reflectance, gap.error.reflectance);
    levels.worst.direction = std::max(levels.worst.direction, gap.error.direction);
  }
  std::sort(levels.values.begin(), levels.values.end());
  return levels;
}

}  // namespace ifov::materials
