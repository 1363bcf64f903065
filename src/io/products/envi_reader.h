#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/envi/envi_header.h"
#include "io/files/input_file.h"
#include "io/product_parts/raster_view.h"
#include "io/product_parts/turned_lines.h"

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

  /// One line of one band from sample `first` on, as many values as there are and as there is room for; from any thread. Throws
  /// std::out_of_range beyond the image, SystemError where the file has been cut short since.
  void read(int line, int band, std::span<float> values, int first = 0) const;
  /// All bands of one pixel; errors likewise.
  std::vector<double> pixel(int sample, int line) const;
  /// Valid as long as the reader is.
  RasterView view() const;

 private:
  /// A header and the data that it is of.
  struct Pair {
    std::filesystem::path header, data;
  };
  explicit EnviReader(const Pair& pair);
  static Pair pair_of(const std::filesystem::path& path);

  /// Where a value lies, in bytes; std::out_of_range beyond the image.
  std::uint64_t place(int sample, int line, int band) const;

  EnviHeader header_;
  std::filesystem::path data_path_;
  std::shared_ptr<const InputFile> data_;
  std::unique_ptr<const TurnedLines> turned_;  // of cubes by pixel
};

}  // namespace ifov::io
