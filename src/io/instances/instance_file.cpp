#include "io/instances/instance_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/parallel.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

/// A quaternion in floats may be this far from length 1.
constexpr double kQuaternionLength = 1e-3;
/// Objects are numbered in 32 bits.
constexpr std::uint64_t kMostInstances = 0xfffffffeu;

template <class T>
T swapped(T value) {
  std::byte bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
double read(const std::byte* from, bool swap) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return static_cast<double>(swap ? swapped(value) : value);
}

}  // namespace

InstanceFile::InstanceFile(const std::filesystem::path& path) : file_(path) {
  read_header(path.string());
  check_records(path.string());
}

void InstanceFile::read_header(const std::string& name) {
  const auto fail = [&](const std::string& why) { return InputError(format("{}: {}", name, why)); };
  const std::span<const std::byte> bytes = file_.bytes();
  InstanceHeader h;
  if (bytes.size() < sizeof h)
    throw fail(
        format("an instance list begins with a header of {} bytes; the file has {}", sizeof h, bytes.size()));
  std::memcpy(&h, bytes.data(), sizeof h);
  if (std::memcmp(h.magic, kInstanceMagic, sizeof h.magic) != 0)
    throw fail("this is no binary instance list, which begins with 'IFOVINST'");
  swapped_ = h.byte_order == swapped(kInstanceByteOrder);
  if (!swapped_ && h.byte_order != kInstanceByteOrder)
    throw fail(format("the byte-order mark is {:#010x}; expected {:#010x} in one order or the other",
                      h.byte_order, kInstanceByteOrder));
  if (swapped_) {
    h.version = swapped(h.version), h.count = swapped(h.count), h.record_bytes = swapped(h.record_bytes);
    for (double& x : h.origin_m) x = swapped(x);
  }
  if (h.version != kInstanceVersion)
    throw fail(
        format("the list is of version {}; this program reads version {}", h.version, kInstanceVersion));
  if (h.position > 1 || h.rotation > 3 || h.scale > 2 || h.reserved != 0 || h.reserved_too != 0)
    throw fail(format(
        "the layout (position {}, rotation {}, scale {}, reserved {}) is not known; positions are 0 or 1, "
        "rotations 0 to 3, scales 0 to 2, reserved 0",
        h.position, h.rotation, h.scale, h.reserved));
  layout_ = {InstanceLayout::Position{h.position}, InstanceLayout::Rotation{h.rotation},
             InstanceLayout::Scale{h.scale}};
  record_bytes_ = layout_.record_bytes();
  if (h.record_bytes != record_bytes_)
    throw fail(
        format("records of this layout have {} bytes; the header says {}", record_bytes_, h.record_bytes));
  if (h.count > kMostInstances)
    throw fail(format("the header says {} instances; at most {} can be placed", h.count, kMostInstances));
  const std::uint64_t expected = sizeof h + h.count * record_bytes_;
  if (bytes.size() != expected)
    throw fail(format("the header says {} instances of {} bytes, a file of {} bytes; it has {}", h.count,
                      record_bytes_, expected, bytes.size()));
  origin_m_ = {h.origin_m[0], h.origin_m[1], h.origin_m[2]};
  if (!std::isfinite(origin_m_.x + origin_m_.y + origin_m_.z)) throw fail("the origin is not finite");
  count_ = static_cast<std::size_t>(h.count);
}

void InstanceFile::check_records(const std::string& name) const {
  constexpr std::size_t kBlock = 1 << 16;
  const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
  // The first fault of each block, so that the one reported does not depend on the threads.
  std::vector<std::string> faults(blocks);
  parallel_for(static_cast<std::int64_t>(blocks), 0, [&](std::int64_t block) {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock,
                      last = std::min(count_, first + kBlock);
    for (std::size_t i = first; i < last && faults[static_cast<std::size_t>(block)].empty(); ++i) {
      const Instance one = instance(i);
      const auto [w, x, y, z] = one.quaternion;
      std::string& fault = faults[static_cast<std::size_t>(block)];
      if (!std::isfinite(one.position_m.x + one.position_m.y + one.position_m.z))
        fault = format("its position ({}, {}, {}) is not finite", one.position_m.x, one.position_m.y,
                       one.position_m.z);
      else if (!(std::abs(w * w + x * x + y * y + z * z - 1.0) < 1e-9))
        fault = layout_.rotation == InstanceLayout::Rotation::quaternion ? "its quaternion is not of length 1"
                                                                         : "its rotation is not finite";
      else if (!(std::min({one.scale.x, one.scale.y, one.scale.z}) > 0.0) ||
               !std::isfinite(one.scale.x + one.scale.y + one.scale.z))
        fault = format("its scale ({}, {}, {}) is not above zero", one.scale.x, one.scale.y, one.scale.z);
      if (!fault.empty()) fault = format("{}: instance {}: {}", name, i, fault);
    }
  });
  for (const std::string& fault : faults)
    if (!fault.empty()) throw InputError(fault);
}

Instance InstanceFile::instance(std::size_t index) const {
  const std::byte* at = file_.bytes().data() + sizeof(InstanceHeader) + index * record_bytes_;
  Instance one;
  const bool wide = layout_.position == InstanceLayout::Position::float64;
  const auto coordinate = [&](int k) {
    return wide ? read<double>(at + 8 * k, swapped_) : read<float>(at + 4 * k, swapped_);
  };
  one.position_m = origin_m_ + math::Vec3{coordinate(0), coordinate(1), coordinate(2)};
  at += layout_.position_bytes();
  const auto number = [&](std::size_t k) { return read<float>(at + 4 * k, swapped_); };
  if (layout_.rotation == InstanceLayout::Rotation::yaw) {
    one.quaternion = quaternion_of(number(0) * math::kDegree, 0.0, 0.0);
  } else if (layout_.rotation == InstanceLayout::Rotation::yaw_pitch_roll) {
    one.quaternion =
        quaternion_of(number(0) * math::kDegree, number(1) * math::kDegree, number(2) * math::kDegree);
  } else if (layout_.rotation == InstanceLayout::Rotation::quaternion) {
    one.quaternion = {number(0), number(1), number(2), number(3)};
    double length = 0.0;
    for (const double q : one.quaternion) length += q * q;
    length = std::sqrt(length);
    if (std::abs(length - 1.0) < kQuaternionLength)
      for (double& q : one.quaternion) q /= length;
  }
  at += 4 * layout_.rotation_floats();
  if (layout_.scale == InstanceLayout::Scale::uniform) {
    const double s = number(0);
    one.scale = {s, s, s};
  } else if (layout_.scale == InstanceLayout::Scale::by_axis) {
    one.scale = {number(0), number(1), number(2)};
  }
  return one;
}

math::Transform InstanceFile::at(std::size_t index) const { return transform_of(instance(index)); }

}  // namespace ifov::io
