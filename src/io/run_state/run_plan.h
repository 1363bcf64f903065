#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/product_parts/run_identity.h"
#include "io/products/product_formats.h"
#include "io/quantities/quantity_set.h"
#include "io/scene_cache/file_stamp.h"
#include "render/image_info.h"
#include "render/tile_grid.h"

namespace ifov::sampling {
struct TileResult;
}

namespace ifov::io {

struct ProductOptions;

/// What a run's tiles and products depend on, kept with the tiles: enough to notice what has changed, and to
/// make the products without the scene.
struct RunPlan {
  RunIdentity identity;          ///< program version, document, seed, sampler, accuracy asked
  std::string build;             ///< which build of that version
  std::string instruction_set;   ///< of the machine
  std::vector<FileStamp> files;  ///< of the scene, paths relative to the document's folder
  render::ImageInfo image;
  int tile_px = 0;
  bool judged = false;      ///< an accuracy is asked for
  bool image_wide = false;  ///< of the image, not of its pixels
  bool knows_errors = false;
  std::vector<std::string> notes;
  std::string name = "image";  ///< of the products
  QuantitySet cubes = usual_quantities(false);
  std::string interleave = "bil";  ///< of the cubes, as headers say it
  ProductFormats formats;          ///< beside those that come with every run
  std::vector<int> quicklook_channels;
  render::TileShare share;
  double error = 0.0;         ///< asked for, in the unit of the accuracy
  std::string error_unit;     ///< "K", "%"; empty where no accuracy is asked for
  bool keeps_memory = false;  ///< its tiles carry what a tighter accuracy can go on from
  /// Accuracies of the runs that it goes on from, the first one first.
  std::vector<std::string> refined_from;
  std::uint64_t base = 0;  ///< key() of the last of them; 0: none

  std::vector<sampling::PixelRect> grid() const;
  /// Those of `cubes` that there is something for.
  QuantitySet made_cubes() const;
  /// Whether tiles tell the parts of their light.
  bool tells_parts() const;
  bool tells_emissivity() const;
  bool tells_thermal_errors() const;
  /// Whether tiles carry the variances.
  bool keeps_variances() const;
  /// Whether the cubes hold all the values that tiles have, so that the state need not.
  bool leaves_values_to_cubes() const;
  /// A tile of so many pixels that holds what this run's tiles hold, its lists empty.
  sampling::TileResult example_tile(int pixels) const;
  ProductOptions products(const std::filesystem::path& folder) const;
  /// Tells this run's tiles from those of others: of all that a tile's numbers depend on.
  std::uint64_t key() const;
};

/// What the tiles of two runs differ in, a line each: what it was, what it is. Sizes and bytes of files
/// count, their times do not.
std::vector<std::string> differences(const RunPlan& was, const RunPlan& is);

/// JSON, with a checksum. docs/formats/run_state.md lists the keys.
std::string to_json(const RunPlan& plan);

/// The plan in such a text; `name` is that of its file, for messages. Throws SystemError where it is damaged or of
/// another format.
RunPlan plan_in(const std::string& text, const std::string& name);

/// The same from a file. Throws SystemError where it cannot be read, too.
RunPlan read_plan(const std::filesystem::path& file);

}  // namespace ifov::io
