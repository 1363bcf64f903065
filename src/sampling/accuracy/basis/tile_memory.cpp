#include "sampling/accuracy/basis/tile_memory.h"

#include <utility>

namespace ifov::sampling {

TileMemory::TileMemory(std::size_t columns, std::span<const std::byte> bytes) : columns_(columns) {
  MemoryReader read(bytes);
  std::uint64_t known_columns = 0;
  read(known_columns);
  if (known_columns != columns) throw SystemError("a kept tile has another number of columns");
  read.list(names_);
  read.list(point_keys_);
  read.list(point_names_);
  read.list(path_keys_);
  read.list(path_names_);
  read.list(values_);
  read.list(tests_before_);
  read.list(before_);
  bool whole = point_names_.size() == point_keys_.size() && path_names_.size() == path_keys_.size() &&
               values_.size() == path_keys_.size() * columns_;
  for (const auto* list : {&point_names_, &path_names_})
    for (const std::uint32_t n : *list) whole = whole && n < names_.size();
  if (!whole) throw SystemError("the memory of a kept tile is damaged");
  for (std::uint32_t i = 0; i < names_.size(); ++i) name_index_.find_or_insert(names_[i], i);
  for (std::uint32_t i = 0; i < point_keys_.size(); ++i) points_.find_or_insert(point_keys_[i], i);
  for (std::uint32_t i = 0; i < path_keys_.size(); ++i) paths_.find_or_insert(path_keys_[i], i);
  for (MemoryReader pixels(before_); !pixels.empty();) {
    std::uint64_t source = 0, size = 0;
    pixels(source);
    pixels(size);
    const std::span<const std::byte> memory = pixels.take(size);
    pixels_before_.resize(std::max<std::size_t>(pixels_before_.size(), source + 1));
    pixels_before_[source] = {static_cast<std::size_t>(memory.data() - before_.data()), size};
  }
}

std::uint32_t TileMemory::name(Label label) {
  const std::uint32_t n = name_index_.find_or_insert(label, static_cast<std::uint32_t>(names_.size()));
  if (n == names_.size()) names_.push_back(label);
  return n;
}

void TileMemory::note(std::uint64_t point_key, Label label) {
  const auto fresh = static_cast<std::uint32_t>(point_keys_.size());
  if (points_.find_or_insert(point_key, fresh) != fresh) return;
  point_keys_.push_back(point_key);
  point_names_.push_back(name(label));
}

void TileMemory::note(std::uint64_t path_key, Label label, const float* value) {
  const auto fresh = static_cast<std::uint32_t>(path_keys_.size());
  if (paths_.find_or_insert(path_key, fresh) != fresh) return;
  path_keys_.push_back(path_key);
  path_names_.push_back(name(label));
  values_.insert(values_.end(), value, value + columns_);
}

std::span<const std::byte> TileMemory::pixel(int source) const {
  const auto at = static_cast<std::size_t>(source);
  if (at >= pixels_before_.size()) return {};
  return std::span<const std::byte>(before_).subspan(pixels_before_[at].first, pixels_before_[at].second);
}

void TileMemory::keep_pixel(int source, std::span<const std::byte> bytes) {
  MemoryWriter write(kept_);
  write(static_cast<std::uint64_t>(source));
  write(static_cast<std::uint64_t>(bytes.size()));
  write.array(bytes.data(), bytes.size());
}

std::vector<std::byte> TileMemory::to_bytes() const {
  std::vector<std::byte> bytes;
  MemoryWriter write(bytes);
  write(static_cast<std::uint64_t>(columns_));
  write.list(names_);
  write.list(point_keys_);
  write.list(point_names_);
  write.list(path_keys_);
  write.list(path_names_);
  write.list(values_);
  write.list(tests_);
  write.list(kept_);
  return bytes;
}

}  // namespace ifov::sampling
