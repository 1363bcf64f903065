#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <string>

namespace ifov::io {

/// The numbers of one accessor, checked against its buffer once.
class GltfAccessor {
 public:
  /// `type` is a TINYGLTF_TYPE. Throws InputError that names the accessor where it does not exist, is of
  /// another type, sparse, or larger than its buffer.
  GltfAccessor(const tinygltf::Model& model, int index, int type, const char* what, const std::string& file);

  std::size_t count() const { return count_; }
  /// Component of an element; integers of a normalized accessor are in [0, 1] or [-1, 1].
  double value(std::size_t element, std::size_t component) const;

 private:
  const unsigned char* first_ = nullptr;
  std::size_t count_ = 0, stride_ = 0, component_size_ = 0;
  int component_type_ = 0;
  bool normalized_ = false;
};

}  // namespace ifov::io
