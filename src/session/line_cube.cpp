#include "session/line_cube.h"

#include <utility>

namespace ifov::session {

LineCube::LineCube(const std::filesystem::path& path, io::EnviHeader header)
    : header_(std::move(header)), data_(path), text_(path.string() + ".hdr") {
  header_.header_offset = 0;
  if (header_.data_type != io::EnviType::uint16 && header_.data_type != io::EnviType::uint32)
    header_.data_type = io::EnviType::float32;
  header_.interleave = io::EnviInterleave::bil;
  header_.big_endian = false;
  try {
    data_.reserve(header_.data_bytes());
  } catch (...) {
    discard();
    throw;
  }
}

LineCube::~LineCube() {
  if (!published_) discard();
}

void LineCube::discard() {
  data_.discard();
  text_.discard();
}

std::size_t LineCube::line_values() const {
  return static_cast<std::size_t>(header_.samples) * static_cast<std::size_t>(header_.bands);
}

void LineCube::write(int first, std::span<const float> lines) {
  data_.write_at(static_cast<std::uint64_t>(first) * line_values() * sizeof(float), lines.data(),
                 lines.size() * sizeof(float));
}

void LineCube::write(int line, int first_band, std::span<const std::byte> values) {
  const std::uint64_t before =
      static_cast<std::uint64_t>(line) * line_values() +
      static_cast<std::uint64_t>(first_band) * static_cast<std::uint64_t>(header_.samples);
  data_.write_at(before * io::bytes_per_value(header_.data_type), values.data(), values.size());
}

void LineCube::publish() {
  io::write_part(text_, io::to_text(header_));
  data_.sync();
  text_.publish();
  data_.publish();
  published_ = true;
}

}  // namespace ifov::session
