#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/parallel.h"

namespace ifov::geometry {

/// Whether good(begin, end) of all pieces of a list of `count`, which are looked at in parallel.
template <class Good>
bool all_pieces(std::size_t count, const Good& good) {
  constexpr std::size_t kPiece = 1 << 20;
  if (count <= kPiece) return good(std::size_t{0}, count);
  std::atomic<bool> all{true};
  parallel_for(static_cast<std::int64_t>((count + kPiece - 1) / kPiece), 0, [&](std::int64_t k) {
    const std::size_t begin = static_cast<std::size_t>(k) * kPiece;
    if (!good(begin, std::min(count, begin + kPiece))) all = false;
  });
  return all;
}

}  // namespace ifov::geometry
