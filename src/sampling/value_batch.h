#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "core/run_control.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// Purpose, in hash(seed, pixel column, pixel row, kPixelPaths), of the path numbers of a pixel's samples.
inline constexpr std::uint64_t kPixelPaths = 0x7061746873ull;

/// Rays that `field` has traced since it stood at `before`.
inline RayCounts rays_since(const RayCounts& before, const Field& field) {
  const RayCounts now = field.counts();
  return {now.primary - before.primary, now.shadow - before.shadow, now.continuation - before.continuation};
}

/// Storage of for_each_value, for who asks many times.
struct ValueBatch {
  std::vector<PathRequest> requests;
  std::vector<Label> labels;
  std::vector<float> values;
};

/// Asks `field` for `count` paths in batches (about half a megabyte of values, so that they stay in the cache),
/// request(k) first and then take(k, label, values) in order of k. Throws Cancelled between batches.
template <class Request, class Take>
void for_each_value(Field& field, const CancelToken* cancel, std::size_t count, ValueBatch& storage,
                    Request request, Take take) {
  constexpr std::size_t kBatchFloats = 1u << 17;
  const std::size_t stride = static_cast<std::size_t>(field.stride());
  const std::size_t batch = std::min(count, std::max<std::size_t>(256, kBatchFloats / stride));
  if (storage.requests.size() < batch) {
    storage.requests.resize(batch);
    storage.labels.resize(batch);
    storage.values.resize(batch * stride);
  }
  for (std::size_t first = 0; first < count; first += batch) {
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
    const std::size_t n = std::min(batch, count - first);
    for (std::size_t k = 0; k < n; ++k) storage.requests[k] = request(first + k);
    field.values({storage.requests.data(), n}, {storage.labels.data(), n},
                 {storage.values.data(), n * stride});
    for (std::size_t k = 0; k < n; ++k)
      take(first + k, storage.labels[k], storage.values.data() + k * stride);
  }
}

template <class Request, class Take>
void for_each_value(Field& field, const CancelToken* cancel, std::size_t count, Request request, Take take) {
  ValueBatch storage;
  for_each_value(field, cancel, count, storage, request, take);
}

}  // namespace ifov::sampling
