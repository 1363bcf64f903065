#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/products/envi_reader.h"

namespace ifov::io {
struct Quantity;
}

namespace ifov::viewer {

/// A channel of an image.
struct Channel {
  std::string name = {};
  double centre_um = 0.0, fwhm_um = 0.0;  ///< 0: not told
};

/// The whole products of a run, or ENVI cubes of others, open for reading. Never changes: files that are replaced meanwhile go
/// on being those that were opened. From any thread.
struct OpenRun {
  struct Cube {
    std::string name;  ///< "radiance"; of cubes of others the file's
    std::string what;
    const io::Quantity* quantity = nullptr;  ///< null: of others
    std::vector<std::string> classes;        ///< of a classification
    std::vector<int> class_colours;          ///< red, green, blue of each, 0 to 255
    io::EnviReader reader;
  };
  std::filesystem::path folder = {};
  std::filesystem::path record = {};  ///< empty: cubes of others
  std::string title = {}, document = {}, document_text = {}, unit = {}, asked = {}, reached = {}, notes = {};
  double confidence = 0.0;  ///< of the intervals; 0: there are none
  int width_px = 0, height_px = 0;
  std::vector<Channel> channels = {};
  std::vector<Cube> cubes = {};  ///< all of that size

  /// Null where there is none of this name.
  const Cube* cube(std::string_view name) const;
};

/// Throws InputError where the folder holds no products, or cubes of several sizes that belong to no run, and where a record and
/// its radiance do not agree; SystemError on files that cannot be read.
std::shared_ptr<const OpenRun> open_run(const std::filesystem::path& folder);

/// Changes when products are made anew: of the files that are opened first, their inodes, sizes and times. Empty where the
/// folder holds no products. Throws nothing.
std::string signature_of(const std::filesystem::path& folder);

}  // namespace ifov::viewer
