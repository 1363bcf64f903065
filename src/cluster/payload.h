#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace ifov::cluster {

/// The bytes of a message, put in and taken out in the same order. All ranks are of one program on machines of
/// one kind.
class Payload {
 public:
  Payload() = default;
  explicit Payload(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    put(values.size());
    for (const Value& value : values) put(value);
  }

  template <class Value>
  Value take() {
    Value value{};
    if constexpr (std::is_trivially_copyable_v<Value>) {
      std::memcpy(&value, claim(sizeof value), sizeof value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      const auto size = take<std::size_t>();
      value.assign(claim(size), size);
    } else {
      const auto count = take<std::size_t>();
      for (std::size_t k = 0; k < count; ++k) value.push_back(take<typename Value::value_type>());
    }
    return value;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  const char* claim(std::size_t size) {
    if (size > bytes_.size() - at_) throw std::logic_error("a message of another rank is too short");
    at_ += size;
    return bytes_.data() + (at_ - size);
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace ifov::cluster
