#include "io/mesh/gltf_accessor.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.h"

namespace ifov::io {
namespace {

template <class T>
double number_at(const unsigned char* at, bool normalized) {
  T value;
  std::memcpy(&value, at, sizeof value);
  const auto number = static_cast<double>(value);
  return normalized ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : number;
}

}  // namespace

GltfAccessor::GltfAccessor(const tinygltf::Model& model, int index, int type, const char* what,
                           const std::string& file) {
  const auto fail = [&](const std::string& message) {
    throw InputError(format("{}: accessor {} ({}): {}", file, index, what, message), {file, 0, 0});
  };
  const auto within = [](int i, std::size_t n) { return i >= 0 && static_cast<std::size_t>(i) < n; };
  if (!within(index, model.accessors.size()))
    fail(format("the file has {} accessors", model.accessors.size()));
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.sparse.isSparse) fail("sparse accessors are not read");
  if (accessor.type != type) fail("its type does not suit its use");
  if (!within(accessor.bufferView, model.bufferViews.size())) fail("it has no buffer view");
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (!within(view.buffer, model.buffers.size())) fail("its buffer view has no buffer");
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    fail(format("its buffer view reaches beyond the {} bytes of buffer {}", data.size(), view.buffer));
  component_type_ = accessor.componentType;
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type_));
  if (size <= 0 || size > 8) fail("its component type is not known");
  component_size_ = static_cast<std::size_t>(size);
  const std::size_t element =
      component_size_ *
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  stride_ = view.byteStride == 0 ? element : view.byteStride;
  if (stride_ < element)
    fail(format("its stride of {} bytes is less than an element of {}", stride_, element));
  count_ = accessor.count;
  if (count_ > 0) {
    const std::size_t offset = accessor.byteOffset;
    if (offset > view.byteLength || element > view.byteLength - offset ||
        (count_ - 1) > (view.byteLength - offset - element) / stride_)
      fail(format("its {} elements reach beyond the {} bytes of its buffer view", count_, view.byteLength));
    first_ = data.data() + view.byteOffset + offset;
  }
  normalized_ = accessor.normalized;
}

double GltfAccessor::value(std::size_t element, std::size_t component) const {
  const unsigned char* at = first_ + element * stride_ + component * component_size_;
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return number_at<std::int8_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return number_at<std::uint8_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return number_at<std::int16_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return number_at<std::uint16_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_INT: return number_at<std::int32_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return number_at<std::uint32_t>(at, normalized_);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE: return number_at<double>(at, false);
    default: return number_at<float>(at, false);
  }
}

}  // namespace ifov::io
