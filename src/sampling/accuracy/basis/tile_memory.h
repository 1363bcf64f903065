#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/field.h"
#include "sampling/hash.h"

namespace ifov::sampling {

/// Appends numbers to bytes; the twin of MemoryReader, so that one function describes both ways.
class MemoryWriter {
 public:
  static constexpr bool kReads = false;
  explicit MemoryWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(const T& number) {
    raw(&number, sizeof number);
  }
  template <class T>
  void array(const T* from, std::size_t count) {
    raw(from, count * sizeof(T));
  }
  template <class T>
  void list(const std::vector<T>& numbers) {
    (*this)(static_cast<std::uint64_t>(numbers.size()));
    array(numbers.data(), numbers.size());
  }

 private:
  void raw(const void* from, std::size_t size) {
    if (size == 0) return;
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);
    std::memcpy(bytes_.data() + end, from, size);
  }
  std::vector<std::byte>& bytes_;
};

/// Throws SystemError where the bytes end too soon.
class MemoryReader {
 public:
  static constexpr bool kReads = true;
  explicit MemoryReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& number) {
    array(&number, 1);
  }
  template <class T>
  void array(T* to, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > bytes_.size() / sizeof(T)) throw SystemError("the memory of a kept tile is damaged");
    if (count > 0) std::memcpy(to, bytes_.data(), count * sizeof(T));
    bytes_ = bytes_.subspan(count * sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& numbers) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / sizeof(T)) throw SystemError("the memory of a kept tile is damaged");
    numbers.resize(count);
    array(numbers.data(), count);
  }
  std::span<const std::byte> take(std::size_t size) {
    if (size > bytes_.size()) throw SystemError("the memory of a kept tile is damaged");
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  bool empty() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

/// What the accuracy sampler has found out about a tile, so that a later run at a tighter accuracy pays only
/// for what is new: the label of each point asked, the values of the lattice and of labels met first, and, of
/// each source pixel, the sums of its values. docs/theory/accuracy_sampler.md, section 10.
class TileMemory {
 public:
  explicit TileMemory(std::size_t columns) : columns_(columns) {}
  /// As to_bytes() of the earlier run left it, to be added to. Throws SystemError where the bytes are
  /// damaged or of another number of columns.
  TileMemory(std::size_t columns, std::span<const std::byte> bytes);

  static std::uint64_t key_of(FocalPoint point) { return hash(bits(point.x_px), bits(point.y_px)); }
  static std::uint64_t key_of(const PathRequest& request) {
    return hash(bits(request.point.x_px), bits(request.point.y_px), request.sequence, request.index);
  }

  /// Label of a point asked before.
  bool knows(std::uint64_t point_key, Label& label) const {
    const std::uint32_t at = points_.find(point_key);
    if (at == FlatMap::kAbsent) return false;
    label = names_[point_names_[at]];
    return true;
  }
  void note(std::uint64_t point_key, Label label);

  /// Label and value (`columns` floats) of a path traced before.
  bool knows(std::uint64_t path_key, Label& label, float* value) const {
    const std::uint32_t at = paths_.find(path_key);
    if (at == FlatMap::kAbsent) return false;
    label = names_[path_names_[at]];
    std::memcpy(value, &values_[at * columns_], columns_ * sizeof(float));
    return true;
  }
  void note(std::uint64_t path_key, Label label, const float* value);

  /// What was kept of the source pixel by the run before; empty where nothing was.
  std::span<const std::byte> pixel(int source) const;
  /// Keeps this of the source pixel, for the next run.
  void keep_pixel(int source, std::span<const std::byte> bytes);

  /// Looks at each output pixel's intervals by the end of the run before; empty in a first run.
  const std::vector<std::uint8_t>& tests_before() const { return tests_before_; }
  void keep_tests(std::vector<std::uint8_t> tests) { tests_ = std::move(tests); }

  std::size_t columns() const { return columns_; }
  std::vector<std::byte> to_bytes() const;

 private:
  static std::uint64_t bits(double x) {
    std::uint64_t b;
    std::memcpy(&b, &x, sizeof b);
    return b;
  }
  std::uint32_t name(Label label);

  std::size_t columns_;
  std::vector<Label> names_;  // each label once; the others are numbers in this list
  FlatMap name_index_;
  FlatMap points_, paths_;  // to positions in the lists
  std::vector<std::uint64_t> point_keys_, path_keys_;
  std::vector<std::uint32_t> point_names_, path_names_;
  std::vector<float> values_;  // [path][column]
  std::vector<std::uint8_t> tests_before_, tests_;
  std::vector<std::byte> before_, kept_;                            // of pixels
  std::vector<std::pair<std::size_t, std::size_t>> pixels_before_;  // [source]: offset and size
};

}  // namespace ifov::sampling
