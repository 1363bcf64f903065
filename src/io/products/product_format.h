#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/product_parts/raster_view.h"

namespace ifov::render {
struct ImageInfo;
}

namespace ifov::io {

class PartFile;
class QuantitySet;
struct Quantity;
struct RunRecord;

/// What a format is written from, once the cubes are whole.
struct FormatInput {
  const RunRecord& record;
  const std::vector<int>& picture_channels;              ///< as of ProductOptions::quicklook_channels
  std::function<RasterView(const Quantity&)> values_of;  ///< empty where the run keeps no such cube
  /// The same of cubes in double precision.
  std::function<WideView(const Quantity&)> wide_values_of;
  /// Of formats that have a header: its text, for a file of that ending and ".hdr". Comes once.
  std::function<void(const std::string& text)> put_header;
};

/// A kind of product: one file beside the cubes, or the cubes themselves.
struct ProductFormat {
  std::string_view name;      ///< as a document asks for it (output.formats); empty: it comes with every run
  std::string_view ending{};  ///< of the file's name, behind that of the products: "_radiance.tif"
  std::string_view what{};    ///< in lists of files: "radiance, GeoTIFF"

  /// Throws SystemError on full disks; then the run keeps its other products. Null: no file of its own.
  void (*write)(PartFile& file, const FormatInput& input) = nullptr;

  /// Whether there is such a product of an image; null: of every one.
  bool (*suits)(const render::ImageInfo& image) = nullptr;

  /// Disk space that this takes at most while it is made, of cubes of these quantities; null where it is small.
  std::uint64_t (*bytes)(const render::ImageInfo& image, const QuantitySet& cubes) = nullptr;

  bool has_header = false;          ///< a file beside it, of its ending and ".hdr"
  const Quantity* needs = nullptr;  ///< a cube that it is made of, and that whoever asks for it has too
};

/// ProductFormat::suits of what makes a picture: not of single views.
bool is_picture(const render::ImageInfo& image);

/// All there are, in the order of documents and in that in which they are made.
std::span<const ProductFormat* const> all_product_formats();

namespace formats {
extern const ProductFormat kGlt, kGeolocatedVrt;       // geolocation_formats.cpp
extern const ProductFormat kWavelengths, kDemosaiced;  // detector/
extern const ProductFormat kStac;                      // stac_format.cpp
}  // namespace formats

/// Null where no document can ask for one of this name.
const ProductFormat* find_product_format(std::string_view name);

}  // namespace ifov::io
