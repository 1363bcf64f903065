#include "studies/common/material_counts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace ifov::studies {

namespace {

using Shares = std::span<const sampling::Abundance>;

const sampling::Abundance* find(Shares shares, std::uint32_t material) {
  for (const sampling::Abundance& s : shares)
    if (s.material == material) return &s;
  return nullptr;
}

}  // namespace

MaterialCounts count_materials(const ImageStore& image) {
  MaterialCounts counts;
  const std::size_t pixels = image.samples().size();
  for (std::size_t p = 0; p < pixels; ++p)
    for (const sampling::Abundance& s : image.abundances(p)) {
      counts.raw += s.fraction > 0.0f;
      counts.counted += double(s.fraction) >= kCountedShare;
    }
  counts.raw /= static_cast<double>(pixels);
  counts.counted /= static_cast<double>(pixels);
  return counts;
}

AbundanceErrors compare_abundances(const ImageStore& image, const ImageStore& reference,
                                   double reference_uncertainty) {
  AbundanceErrors errors;
  double squares = 0.0;
  std::size_t judged = 0, held = 0;
  const std::size_t pixels = image.samples().size();
  for (std::size_t p = 0; p < pixels; ++p) {
    const Shares own = image.abundances(p), truth = reference.abundances(p);
    const bool mixed = truth.size() > 1;
    const auto judge = [&](double fraction, double half_width, double expected) {
      const double error = fraction - expected;
      squares += error * error;
      errors.largest = std::max(errors.largest, std::abs(error));
      if (!mixed || !std::isfinite(half_width)) return;
      ++judged;
      held += std::abs(error) <= half_width + reference_uncertainty;
    };
    for (const sampling::Abundance& t : truth) {
      const sampling::Abundance* s = find(own, t.material);
      if (s == nullptr && double(t.fraction) >= kCountedShare) errors.missed += 1.0;
      // A material that is not named at all has no interval: it is a miss, and counts as one.
      judge(s ? double(s->fraction) : 0.0, s ? double(s->half_width) : 0.0, double(t.fraction));
    }
    for (const sampling::Abundance& s : own)
      if (find(truth, s.material) == nullptr) judge(double(s.fraction), double(s.half_width), 0.0);
  }
  errors.rms = std::sqrt(squares / static_cast<double>(pixels));
  errors.missed /= static_cast<double>(pixels);
  errors.coverage = judged > 0 ? double(held) / double(judged) : std::numeric_limits<double>::quiet_NaN();
  return errors;
}

}  // namespace ifov::studies
