#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/product_parts/run_identity.h"
#include "io/products/product_formats.h"
#include "io/quantities/quantity_set.h"
#include "render/tile_sink.h"

namespace ifov::io {

struct RunOutcome;
struct RunRecord;

/// Which products a run leaves, and where.
struct ProductOptions {
  std::filesystem::path folder;  ///< made where it is missing
  std::string name = "image";    ///< files are <folder>/<name>_radiance.img and so on
  QuantitySet cubes = usual_quantities(false);
  bool go_on = false;              ///< with the `.part` cubes that an earlier start of the same run has left
  std::string interleave = "bil";  ///< of the cubes, as headers say it
  ProductFormats formats = usual_product_formats();
  /// Three for colour, one for a colour map; empty: chosen from wavelengths.
  std::vector<int> quicklook_channels;
};

/// Streams finished tiles into ENVI cubes and completes them with the other products. Everything is written
/// under a name that ends in `.part` and renamed when all of it is whole; `<name>_run.json` is renamed last,
/// so that its presence says "complete". Errors: ifov::SystemError for folders that cannot be written
/// and full disks. Disk space for the cubes is reserved in begin(), before the first ray; tiles that were
/// written stay in the `.part` files.
class ProductWriter final : public render::TileSink {
 public:
  ProductWriter(ProductOptions options, RunIdentity identity);
  /// Without finish(): writes what is buffered and leaves the `.part` files.
  ~ProductWriter() override;

  void begin(const render::ImageInfo& info) override;
  /// May be called by several threads at once.
  void write(const sampling::TileResult& tile) override;

  /// As CubeSet::lines_written(), read_values(); after begin().
  int lines_written() const;
  bool read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const;

  /// After the last tile: syncs, makes the remaining products, renames all. std::logic_error where pixels are
  /// missing.
  RunRecord finish(const RunOutcome& outcome);

  /// Files that an unfinished run leaves behind, for messages.
  std::vector<std::filesystem::path> part_files() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ifov::io
