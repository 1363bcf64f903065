#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/product_parts/run_record.h"
#include "io/products/cube_file.h"
#include "io/quantities/quantity_set.h"

namespace ifov::io {

/// The ENVI cubes of a run, each under its `.part` name until publish().
class CubeSet {
 public:
  /// Files are <stem>_radiance.img and so on. Reserves the disk space of all cubes, and asks for
  /// `further_bytes` more; leaves nothing behind where that fails but what an earlier start has left.
  CubeSet(const std::filesystem::path& stem, const QuantitySet& selection, const render::ImageInfo& info,
          const Acquisition& acquisition, std::uint64_t further_bytes,
          PartFile::Left left = PartFile::Left::replace, EnviInterleave interleave = EnviInterleave::bil);

  /// May be called by several threads at once. std::logic_error on arrays that do not match the tile or the
  /// image.
  void write(const sampling::TileResult& tile);

  /// Image lines [0, lines_written()) of the radiance and its half-widths were written whole. From any thread.
  int lines_written() const;

  /// Fills a tile's means and half-widths, where it has any, from the cubes being made or, where `is_right` does not take
  /// those, from those that an earlier run has published. False where it takes neither. From any thread.
  bool read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const;

  void flush();

  /// Flushes and syncs; adds the channels' figures and the files with their checksums to the record.
  void complete(RunRecord& record);
  void write_headers(const RunIdentity& identity, const std::string& statement);
  void publish();

  /// Empty where the selection leaves the cube away.
  RasterView view(const Quantity& quantity) const;
  WideView wide_view(const Quantity& quantity) const;
  std::vector<std::filesystem::path> part_files() const;
  /// Where the cubes would be that the selection leaves away, and their headers.
  std::vector<std::filesystem::path> unselected_files() const;

 private:
  struct Cube {
    Cube(const Quantity& quantity, const std::filesystem::path& path, const render::ImageInfo& info,
         PartFile::Left left, EnviInterleave interleave);
    const Quantity& quantity;
    CubeFile raster;
    std::unique_ptr<PartFile> header;
  };

  /// Null where the selection leaves it away.
  Cube* cube(const Quantity& quantity) const;

  std::filesystem::path stem_;
  QuantitySet selection_;
  render::ImageInfo info_;
  Acquisition acquisition_;
  EnviInterleave interleave_;
  std::vector<std::unique_ptr<Cube>> cubes_;
};

}  // namespace ifov::io
