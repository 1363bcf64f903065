#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "io/envi/envi_header.h"
#include "io/products/part_file.h"

namespace ifov::session {

/// An ENVI cube of floats or whole numbers without a sign that is made line by line in any order; whole or not at all.
class LineCube {
 public:
  /// PATH and PATH.hdr. Of the header, what the cube itself decides on is set here; values are floats unless it has a type without a
  /// sign.
  LineCube(const std::filesystem::path& path, io::EnviHeader header);
  /// Removes what was not published.
  ~LineCube();
  LineCube(const LineCube&) = delete;
  LineCube& operator=(const LineCube&) = delete;

  const io::EnviHeader& header() const { return header_; }
  /// Values of a line.
  std::size_t line_values() const;

  /// Whole lines from `first` on, [line][band][sample]. From any thread.
  void write(int first, std::span<const float> lines);
  /// Bytes of a line from a band on, [band][sample]. From any thread, a line from one at a time.
  void write(int line, int first_band, std::span<const std::byte> values);
  /// What was written of a line of a cube of one band.
  void read(int line, std::span<std::byte> values) const;
  /// Waits until all is on the disk, and gives it its name.
  void publish();

 private:
  void discard();
  io::EnviHeader header_;
  io::PartFile data_, text_;
  bool published_ = false;
};

}  // namespace ifov::session
