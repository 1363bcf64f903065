#include "sampling/accuracy/borders/steering_columns.h"

#include <algorithm>

#include "sampling/accuracy/borders/contrast.h"

namespace ifov::sampling {

namespace {

/// Contrasts this many times those of the steering columns are looked after.
constexpr double kBeyond = 1.5;
/// Contrasts below this (allowed standard errors by which a whole pixel would move) need no care.
constexpr double kNegligible = 0.1;

}  // namespace

void SteeringColumns::cover(const Contrast& contrast, std::uint32_t a, std::uint32_t b,
                            std::span<const double> inverse_square) {
  if (a == b || all()) return;
  const Contrast::Difference difference = contrast.difference(a, b);
  double known = kNegligible * kNegligible;
  for (const int c : list_)
    known = std::max(
        known, difference.square(static_cast<std::size_t>(c)) * inverse_square[static_cast<std::size_t>(c)]);
  double most = kBeyond * kBeyond * known;
  unsigned beyond = 0;  // a sum of comparisons is vectorised, a search for the largest is not
  for (std::size_t c = 0; c < columns_; ++c)
    beyond |= difference.square(c) * inverse_square[c] > most ? 1u : 0u;
  if (beyond == 0) return;
  int column = list_.front();
  for (std::size_t c = 0; c < columns_; ++c)
    if (const double here = difference.square(c) * inverse_square[c]; here > most)
      most = here, column = static_cast<int>(c);
  list_.push_back(column);
}

void SteeringColumns::let_steer(int column) {
  if (std::find(list_.begin(), list_.end(), column) == list_.end()) list_.push_back(column);
}

}  // namespace ifov::sampling
