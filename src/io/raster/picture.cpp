#include "io/raster/picture.h"

#include <algorithm>
#include <atomic>

#include "core/error.h"
#include "io/raster/gdal_dataset.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"
#include "io/raster/quiet_gdal.h"
#include "io/raster/raster.h"

namespace ifov::io {
namespace {

[[noreturn]] void refuse_picture(const std::string& name, const std::string& message) {
  throw InputError(format("{}: {}", name, message), {name, 0, 0});
}

/// Bytes as a file of GDAL's memory, while it lives. They are not copied.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) {
    static std::atomic<std::uint64_t> count{0};
    path_ = format("/vsimem/ifov_picture_{}", count.fetch_add(1));
    VSILFILE* const file = late::VSIFileFromMemBuffer(
        path_.c_str(), reinterpret_cast<GByte*>(const_cast<char*>(bytes.data())), bytes.size(), FALSE);
    if (file != nullptr) late::VSIFCloseL(file);
  }
  ~MemoryFile() { late::VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const char* path() const { return path_.c_str(); }

 private:
  std::string path_;
};

/// One band, as bytes.
std::vector<std::uint8_t> band_bytes(GDALDatasetH dataset, int band, const Picture& picture,
                                     const std::string& name, const QuietGdal& gdal) {
  const GDALRasterBandH handle = late::GDALGetRasterBand(dataset, band);
  const std::size_t cells =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  std::vector<std::uint8_t> bytes(cells);
  const auto read = [&](void* into, GDALDataType type) {
    if (late::GDALRasterIO(handle, GF_Read, 0, 0, picture.width, picture.height, into, picture.width,
                           picture.height, type, 0, 0) != CE_None)
      refuse_picture(name, format("the image is damaged: {}", gdal.message()));
  };
  switch (late::GDALGetRasterDataType(handle)) {
    case GDT_Byte: read(bytes.data(), GDT_Byte); break;
    case GDT_UInt16: {
      std::vector<std::uint16_t> words(cells);
      read(words.data(), GDT_UInt16);
      std::transform(words.begin(), words.end(), bytes.begin(), [](std::uint16_t word) {
        return static_cast<std::uint8_t>((static_cast<unsigned>(word) + 128u) / 257u);
      });
      break;
    }
    default:
      refuse_picture(name, format("its numbers are {}; expected an image of 8 or 16 bits",
                                  late::GDALGetDataTypeName(late::GDALGetRasterDataType(handle))));
  }
  return bytes;
}

std::uint32_t packed(unsigned red, unsigned green, unsigned blue, unsigned alpha) {
  return red | green << 8 | blue << 16 | alpha << 24;
}

}  // namespace

Picture decode_picture(const std::string& bytes, const std::string& name, std::size_t max_cells) {
  prepare_gdal();
  const QuietGdal gdal;
  const MemoryFile file(bytes);
  const Dataset dataset(open_raster(file.path()));
  if (!dataset)
    refuse_picture(
        name, format("not an image of a kind that is read ({}): {}", raster_driver_list(), gdal.message()));
  Picture picture;
  picture.width = late::GDALGetRasterXSize(dataset.get());
  picture.height = late::GDALGetRasterYSize(dataset.get());
  const int bands = late::GDALGetRasterCount(dataset.get());
  if (picture.width < 1 || picture.height < 1 || bands < 1 || bands > 4)
    refuse_picture(name, format("an image of {} x {} cells with {} bands; expected 1 to 4", picture.width,
                                picture.height, bands));
  const std::size_t cells =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (cells > max_cells)
    refuse_picture(name, format("an image of {} x {} cells is larger than the {} that are read",
                                picture.width, picture.height, max_cells));
  // A damaged file may announce more than it can hold: compression of pictures gains a thousandfold at most.
  constexpr std::size_t kMostGain = 2000, kAlways = std::size_t{1} << 22;
  if (cells > kAlways && cells / kMostGain > bytes.size())
    refuse_picture(name, format("the image is damaged: {} bytes cannot hold {} x {} cells", bytes.size(),
                                picture.width, picture.height));
  std::vector<std::vector<std::uint8_t>> values;
  for (int band = 1; band <= bands; ++band)
    values.push_back(band_bytes(dataset.get(), band, picture, name, gdal));
  picture.cells.resize(cells);
  picture.has_alpha = bands == 2 || bands == 4;
  const GDALColorTableH palette =
      bands == 1 ? late::GDALGetRasterColorTable(late::GDALGetRasterBand(dataset.get(), 1)) : nullptr;
  if (palette != nullptr) {
    const int count = late::GDALGetColorEntryCount(palette);
    for (std::size_t k = 0; k < cells; ++k) {
      if (values[0][k] >= count)
        refuse_picture(name, format("cell {} has entry {} of a palette of {}", k, values[0][k], count));
      const GDALColorEntry& entry = *late::GDALGetColorEntry(palette, values[0][k]);
      picture.cells[k] =
          packed(static_cast<unsigned>(entry.c1) & 255u, static_cast<unsigned>(entry.c2) & 255u,
                 static_cast<unsigned>(entry.c3) & 255u, static_cast<unsigned>(entry.c4) & 255u);
      picture.has_alpha = picture.has_alpha || entry.c4 != 255;
    }
    return picture;
  }
  const bool colours = bands >= 3;
  for (std::size_t k = 0; k < cells; ++k)
    picture.cells[k] = packed(values[0][k], values[colours ? 1 : 0][k], values[colours ? 2 : 0][k],
                              picture.has_alpha ? values[static_cast<std::size_t>(bands - 1)][k] : 255u);
  return picture;
}

}  // namespace ifov::io
