#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/products/bil_cube.h"
#include "io/products/product_headers.h"
#include "io/products/run_record.h"

namespace ifov::io {

/// The ENVI cubes of a run, each under its `.part` name until publish().
class CubeSet {
 public:
  enum Index {
    kRadiance,
    kStandardError,
    kHalfWidth,
    kAirHalfWidth,
    kSamples,
    kQuality,
    kReasons,
    kQualityClass,
    kAbundance,
    kAbundanceHalfWidth,
    kCount
  };
  struct Selection {
    bool standard_error = true, half_width = true, abundance = true;
  };

  /// Files are <stem>_radiance.img and so on. Reserves the disk space of all cubes, and asks for
  /// `further_bytes` more; leaves nothing behind where that fails.
  CubeSet(const std::filesystem::path& stem, Selection selection, const render::ImageInfo& info,
          std::uint64_t further_bytes);

  /// May be called by several threads at once. std::logic_error on arrays that do not match the tile or the
  /// image.
  void write(const sampling::TileResult& tile);

  void flush();

  /// Flushes and syncs; adds the channels' figures and the files with their checksums to the record.
  void complete(RunRecord& record);
  void write_headers(const RunIdentity& identity, const std::string& statement);
  void publish();

  /// Empty where the selection leaves the cube away.
  RasterView view(Index index) const;
  std::vector<std::filesystem::path> part_files() const;
  /// Where the cubes would be that the selection leaves away, and their headers.
  std::vector<std::filesystem::path> unselected_files() const;

 private:
  struct Cube {
    Cube(CubeKind cube_kind, const std::filesystem::path& path, const render::ImageInfo& info);
    CubeKind kind;
    BilCube raster;
    std::unique_ptr<PartFile> header;
  };

  bool selected(Index index) const;
  std::vector<Cube*> cubes() const;
  void require_consistent(const sampling::TileResult& tile) const;
  void write_values(Index index, const sampling::TileResult& tile, const std::vector<float>& values);
  void write_reasons(const sampling::TileResult& tile);
  void write_fractions(const sampling::TileResult& tile);

  std::filesystem::path stem_;
  Selection selection_;
  render::ImageInfo info_;
  std::array<std::unique_ptr<Cube>, kCount> cubes_;
};

}  // namespace ifov::io
