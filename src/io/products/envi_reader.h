#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/envi/envi_header.h"
#include "io/files/input_file.h"
#include "io/product_parts/raster_view.h"

namespace ifov::io {

/// An ENVI cube on disk, read line by line and converted to float.
class EnviReader {
 public:
  /// Accepts the path of the data or of the header; finds `name.img.hdr` and `name.hdr`. ifov::InputError on
  /// headers that cannot be right (with line numbers), ifov::SystemError on files that are missing or
  /// too short.
  explicit EnviReader(const std::filesystem::path& path);

  const EnviHeader& header() const { return header_; }
  const std::filesystem::path& data_path() const { return data_path_; }

  /// One line of one band, `samples` values.
  void read(int line, int band, std::span<float> values) const;
  /// Valid as long as the reader is.
  RasterView view() const;

 private:
  /// A header and the data that it is of.
  struct Pair {
    std::filesystem::path header, data;
  };
  explicit EnviReader(const Pair& pair);
  static Pair pair_of(const std::filesystem::path& path);

  void fetch(std::uint64_t offset, unsigned char* to, std::size_t bytes) const;

  EnviHeader header_;
  std::filesystem::path data_path_;
  InputFile data_;
};

}  // namespace ifov::io
