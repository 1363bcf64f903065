#pragma once

#include <cstddef>
#include <cstdint>

namespace ifov::io {

/// How the record of one copy is written in a binary instance list, field behind field without gaps.
struct InstanceLayout {
  enum class Position : std::uint8_t { float64, float32 } position = Position::float64;
  enum class Rotation : std::uint8_t { none, yaw, yaw_pitch_roll, quaternion } rotation = Rotation::yaw;
  enum class Scale : std::uint8_t { none, uniform, by_axis } scale = Scale::uniform;
  friend bool operator==(const InstanceLayout&, const InstanceLayout&) = default;

  constexpr std::size_t position_bytes() const { return position == Position::float64 ? 24 : 12; }
  constexpr std::size_t rotation_floats() const {
    return rotation == Rotation::none         ? 0
           : rotation == Rotation::yaw        ? 1
           : rotation == Rotation::quaternion ? 4
                                              : 3;
  }
  constexpr std::size_t scale_floats() const {
    return scale == Scale::none ? 0 : scale == Scale::uniform ? 1 : 3;
  }
  constexpr std::size_t record_bytes() const {
    return position_bytes() + 4 * (rotation_floats() + scale_floats());
  }
};

/// What a binary instance list begins with; documented in docs/formats/instances.md.
struct InstanceHeader {
  char magic[8];
  std::uint32_t byte_order;
  std::uint32_t version;
  std::uint64_t count;
  std::uint32_t record_bytes;
  std::uint8_t position, rotation, scale, reserved;
  double origin_m[3];
  std::uint64_t reserved_too;
};
static_assert(sizeof(InstanceHeader) == 64);

inline constexpr char kInstanceMagic[9] = "IFOVINST";
inline constexpr std::uint32_t kInstanceByteOrder = 0x01020304;
inline constexpr std::uint32_t kInstanceVersion = 1;

}  // namespace ifov::io
