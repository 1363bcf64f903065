#include "io/instances/instance_writer.h"

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;
/// A turn or a scale that the layout has no field for may differ from none by this.
constexpr double kNegligible = 1e-7;

InstanceHeader header_of(const InstanceLayout& layout, math::Point3 origin_m, std::uint64_t count) {
  InstanceHeader header{};
  std::memcpy(header.magic, kInstanceMagic, sizeof header.magic);
  header.byte_order = kInstanceByteOrder;
  header.version = kInstanceVersion;
  header.count = count;
  header.record_bytes = static_cast<std::uint32_t>(layout.record_bytes());
  header.position = static_cast<std::uint8_t>(layout.position);
  header.rotation = static_cast<std::uint8_t>(layout.rotation);
  header.scale = static_cast<std::uint8_t>(layout.scale);
  header.origin_m[0] = origin_m.x, header.origin_m[1] = origin_m.y, header.origin_m[2] = origin_m.z;
  return header;
}

}  // namespace

InstanceWriter::InstanceWriter(std::filesystem::path path, InstanceLayout layout, math::Point3 origin_m)
    : path_(std::move(path)),
      layout_(layout),
      origin_m_(origin_m),
      file_(path_, path_.string() + format(".{}.part", getpid())) {
  buffer_.reserve(kBufferBytes + 128);
  const InstanceHeader header = header_of(layout_, origin_m_, 0);
  file_.append(std::as_bytes(std::span(&header, 1)));
}

void InstanceWriter::add(const Instance& instance) {
  const auto fail = [&](const char* why) {
    return InputError(format("{}: instance {} {}", path_.string(), count_, why));
  };
  const math::Vec3 at = instance.position_m - origin_m_;
  const math::Vec3 s = instance.scale;
  if (!std::isfinite(at.x + at.y + at.z)) throw fail("has a position that is not finite");
  if (!(s.x > 0.0 && s.y > 0.0 && s.z > 0.0) || !std::isfinite(s.x + s.y + s.z))
    throw fail("has a scale that is not above zero");

  const double position[3] = {at.x, at.y, at.z};
  if (layout_.position == InstanceLayout::Position::float64)
    buffer_.insert(buffer_.end(), reinterpret_cast<const char*>(position),
                   reinterpret_cast<const char*>(position + 3));
  else
    add_floats(position, 3);

  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const std::array<double, 3> angles = yaw_pitch_roll_of(instance.quaternion);
  const double degrees[3] = {angles[0] * kDegrees, angles[1] * kDegrees, angles[2] * kDegrees};
  const bool tilted = std::abs(angles[1]) > kNegligible || std::abs(angles[2]) > kNegligible;
  switch (layout_.rotation) {
    case InstanceLayout::Rotation::none:
      if (tilted || std::abs(angles[0]) > kNegligible)
        throw fail("is turned, and its layout has no rotation");
      break;
    case InstanceLayout::Rotation::yaw:
      if (tilted) throw fail("is tilted, and its layout has a rotation about z only");
      add_floats(degrees, 1);
      break;
    case InstanceLayout::Rotation::yaw_pitch_roll: add_floats(degrees, 3); break;
    case InstanceLayout::Rotation::quaternion: add_floats(instance.quaternion.data(), 4); break;
  }

  const double scale[3] = {s.x, s.y, s.z};
  const bool uneven = std::abs(s.y - s.x) > kNegligible * s.x || std::abs(s.z - s.x) > kNegligible * s.x;
  if (layout_.scale == InstanceLayout::Scale::none && (uneven || std::abs(s.x - 1.0) > kNegligible))
    throw fail("is scaled, and its layout has no scale");
  if (layout_.scale == InstanceLayout::Scale::uniform && uneven)
    throw fail("has three scales, and its layout has one");
  add_floats(scale, layout_.scale_floats());
  ++count_;
  if (buffer_.size() >= kBufferBytes) flush();
}

void InstanceWriter::add_floats(const double* values, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const auto value = static_cast<float>(values[k]);
    buffer_.insert(buffer_.end(), reinterpret_cast<const char*>(&value),
                   reinterpret_cast<const char*>(&value + 1));
  }
}

void InstanceWriter::flush() {
  file_.append(std::as_bytes(std::span(buffer_)));
  buffer_.clear();
}

void InstanceWriter::finish() {
  flush();
  const InstanceHeader header = header_of(layout_, origin_m_, count_);
  file_.write_head(std::as_bytes(std::span(&header, 1)));
  file_.publish();
}

}  // namespace ifov::io
