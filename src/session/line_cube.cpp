#include "session/line_cube.h"

#include <utility>

#include "io/products/cube_lines.h"

namespace ifov::session {

LineCube::LineCube(const std::filesystem::path& path, io::EnviHeader header)
    : header_(std::move(header)), data_(path), text_(path.string() + ".hdr") {
  header_.header_offset = 0;
  if (header_.data_type != io::EnviType::uint16 && header_.data_type != io::EnviType::uint32)
    header_.data_type = io::EnviType::float32;
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
  io::write_cube_lines(data_, io::layout_of(header_), sizeof(float), first, std::as_bytes(lines));
}

void LineCube::write(int line, int first_band, std::span<const std::byte> values) {
  io::write_cube_bands(data_, io::layout_of(header_), io::bytes_per_value(header_.data_type), line,
                       first_band, values);
}

void LineCube::read(int line, std::span<std::byte> values) const {
  data_.read_at(static_cast<std::uint64_t>(line) * values.size(), values.data(), values.size());
}

void LineCube::publish() {
  io::write_part(text_, io::to_text(header_));
  data_.sync();
  text_.publish();
  data_.publish();
  published_ = true;
}

}  // namespace ifov::session
