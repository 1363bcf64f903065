#include "io/raster/raster.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/files/inputs.h"
#include "io/raster/gdal_dataset.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {
namespace {

// Kinds whose readers open the named file and its companions only, and refuse what is damaged; IFOV_GDAL_DRIVERS of
// the build chooses among them. OpenJPEG does not: it ends the program by an assertion.
#define IFOV_DRIVER(name) #name,
constexpr const char* kDrivers[] = {IFOV_RASTER_DRIVERS nullptr};
#undef IFOV_DRIVER

[[noreturn]] void fail(const std::string& name, const std::string& message) {
  stop_if_cancelled();  // GDAL cannot be told, and takes the file for damaged
  throw InputError(format("{}: {}", name, message), {name, 0, 0});
}

/// GDAL takes memory for whole blocks. Those of a small raster may be larger than itself, but not by much.
void check_blocks(GDALDatasetH dataset, const std::string& name, std::size_t values) {
  constexpr std::size_t kAlways_bytes = std::size_t{64} << 20, kMostTimes = 4;
  int width = 0, height = 0;
  const GDALRasterBandH band = late::GDALGetRasterBand(dataset, 1);
  late::GDALGetBlockSize(band, &width, &height);
  const auto value_bytes =
      static_cast<std::size_t>(late::GDALGetDataTypeSizeBytes(late::GDALGetRasterDataType(band)));
  const char* interleave = late::GDALGetMetadataItem(dataset, "INTERLEAVE", "IMAGE_STRUCTURE");
  const bool all_bands = interleave != nullptr && std::string_view(interleave) == "PIXEL";
  const std::size_t block_bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                  value_bytes *
                                  static_cast<std::size_t>(all_bands ? late::GDALGetRasterCount(dataset) : 1);
  if (block_bytes > std::max(kAlways_bytes, kMostTimes * values * value_bytes))
    fail(name, format("the raster is damaged: its blocks have {} x {} cells, it has {} x {}", width, height,
                      late::GDALGetRasterXSize(dataset), late::GDALGetRasterYSize(dataset)));
}

/// GDAL looks for every row of a text that is cut short, which takes it minutes. A number and what parts it from the next
/// are two bytes.
void check_text(GDALDatasetH dataset, const std::string& name, std::size_t values) {
  const std::string_view driver = late::GDALGetDriverShortName(late::GDALGetDatasetDriver(dataset));
  if (driver != "AAIGrid" && driver != "GSAG") return;
  const std::uint64_t file_bytes = InputFile(name).size();
  if (file_bytes / 2 + 1 < values)
    fail(name, format("the raster is damaged: {} bytes cannot hold {} x {} numbers", file_bytes,
                      late::GDALGetRasterXSize(dataset), late::GDALGetRasterYSize(dataset)));
}

/// A small file that announces a large raster must give its last row before memory is taken for all of them.
void check_end(GDALDatasetH dataset, const std::string& name, std::size_t values, const QuietGdal& gdal) {
  constexpr std::size_t kSmall_bytes = std::size_t{64} << 20, kMostCompressed_times = 100;
  const std::uint64_t file_bytes = InputFile(name).size();
  if (values * sizeof(float) < kSmall_bytes || values * sizeof(float) / kMostCompressed_times < file_bytes)
    return;
  const int width = late::GDALGetRasterXSize(dataset), height = late::GDALGetRasterYSize(dataset);
  std::vector<float> row(static_cast<std::size_t>(width));
  if (late::GDALRasterIO(late::GDALGetRasterBand(dataset, late::GDALGetRasterCount(dataset)), GF_Read, 0,
                         height - 1, width, 1, row.data(), width, 1, GDT_Float32, 0, 0) != CE_None)
    fail(name, format("the raster is damaged: {}", gdal.message()));
}

/// Applies the factor and offset that the file states for a band, where it states any.
void scale(GDALRasterBandH band, std::optional<double> nodata, std::span<float> values) {
  const double factor = late::GDALGetRasterScale(band, nullptr),
               offset = late::GDALGetRasterOffset(band, nullptr);
  if (factor == 1.0 && offset == 0.0) return;
  for (float& value : values)
    if (!nodata || static_cast<double>(value) != *nodata)
      value = static_cast<float>(factor * static_cast<double>(value) + offset);
}

/// A file that is open, and GDAL kept quiet meanwhile.
class RasterFile {
 public:
  explicit RasterFile(const std::filesystem::path& path) : name_(path.string()) {
    const InputFile readable(path);  // says why where it is not
    dataset_.reset(open_raster(gdal_input_name(path)));
    if (!dataset_ && (path.extension() == ".jp2" || path.extension() == ".j2k"))
      fail(name_, "JPEG 2000 is not read; turn it into a GeoTIFF first: gdal_translate a.jp2 a.tif");
    if (!dataset_)
      fail(name_,
           format("not a raster of a kind that is read ({}): {}", raster_driver_list(), gdal_.message()));
    frame_.width = late::GDALGetRasterXSize(dataset_.get());
    frame_.height = late::GDALGetRasterYSize(dataset_.get());
    frame_.bands = late::GDALGetRasterCount(dataset_.get());
    if (frame_.width < 1 || frame_.height < 1 || frame_.bands < 1) fail(name_, "the raster has no pixels");
    std::array<double, 6> transform{};
    if (late::GDALGetGeoTransform(dataset_.get(), transform.data()) == CE_None)
      frame_.geotransform = transform;
    if (const char* wkt = late::GDALGetProjectionRef(dataset_.get())) frame_.projection = wkt;
  }

  const RasterFrame& frame() const { return frame_; }

  /// `count` bands from number `first`, counted from 1.
  Raster read(int first, int count, std::size_t max_values) const {
    Raster raster{frame_, {}, {}, {}};
    raster.bands = count;
    const std::size_t cells = frame_.cells(), values = cells * static_cast<std::size_t>(count);
    if (cells > max_values / static_cast<std::size_t>(count))
      fail(name_, format("a raster of {} x {} x {} numbers is larger than the {} that are read", frame_.width,
                         frame_.height, count, max_values));
    check_blocks(dataset_.get(), name_, cells * static_cast<std::size_t>(frame_.bands));
    check_text(dataset_.get(), name_, values);
    check_end(dataset_.get(), name_, values, gdal_);
    raster.values.resize(values);
    for (int k = 0; k < count; ++k)
      read_band(first + k, raster, {raster.values.data() + static_cast<std::size_t>(k) * cells, cells});
    return raster;
  }

 private:
  void read_band(int band, Raster& raster, std::span<float> values) const {
    const GDALRasterBandH handle = late::GDALGetRasterBand(dataset_.get(), band);
    if (late::GDALDataTypeIsComplex(late::GDALGetRasterDataType(handle)))
      fail(name_, "found complex numbers; expected real ones");
    if (late::GDALRasterIO(handle, GF_Read, 0, 0, frame_.width, frame_.height, values.data(), frame_.width,
                           frame_.height, GDT_Float32, 0, 0) != CE_None)
      fail(name_, format("the raster is damaged: {}", gdal_.message()));
    int has_nodata = 0;
    const double nodata = late::GDALGetRasterNoDataValue(handle, &has_nodata);
    if (has_nodata != 0 && !raster.nodata) raster.nodata = nodata;
    const char* unit = late::GDALGetRasterUnitType(handle);
    raster.units.emplace_back(unit != nullptr ? unit : "");
    scale(handle, has_nodata != 0 ? std::optional<double>(nodata) : std::nullopt, values);
  }

  std::string name_;
  QuietGdal gdal_;
  Dataset dataset_;
  RasterFrame frame_;
};

const Raster* raster_asset(const std::filesystem::path& path) {
  return arrays_of_asset<Raster>(path, "a raster");
}

[[noreturn]] void refuse_band(const std::string& name, int band, int bands) {
  throw InputError(format("{} has no band {}; it has {}", name, band, bands));
}

Raster band_of(const Raster& all, const std::filesystem::path& path, int band) {
  if (band < 1 || band > all.bands) refuse_band(path.string(), band, all.bands);
  const auto first = all.values.begin() + static_cast<std::ptrdiff_t>(all.cells()) * (band - 1);
  Raster one{static_cast<const RasterFrame&>(all), {}, all.nodata, {}};
  one.bands = 1;
  one.values.assign(first, first + static_cast<std::ptrdiff_t>(all.cells()));
  one.units = {all.units.empty() ? std::string() : all.units[static_cast<std::size_t>(band - 1)]};
  return one;
}

}  // namespace

void* open_raster(const std::string& gdal_name) {
  return late::GDALOpenEx(gdal_name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                          kDrivers, nullptr, nullptr);
}

std::string raster_driver_list() {
  std::string list;
  for (const char* const* driver = kDrivers; *driver != nullptr; ++driver)
    list += (list.empty() ? "" : ", ") + std::string(*driver);
  return list;
}

Raster read_raster(const std::filesystem::path& path, std::size_t max_values) {
  if (const Raster* const asset = raster_asset(path)) return *asset;
  prepare_gdal();
  const RasterFile file(path);
  return file.read(1, file.frame().bands, max_values);
}

Raster read_band(const std::filesystem::path& path, int band, std::size_t max_values) {
  if (const Raster* const asset = raster_asset(path)) return band_of(*asset, path, band);
  prepare_gdal();
  const RasterFile file(path);
  if (band < 1 || band > file.frame().bands) refuse_band(path.string(), band, file.frame().bands);
  return file.read(band, 1, max_values);
}

RasterFrame read_raster_frame(const std::filesystem::path& path) {
  if (const Raster* const asset = raster_asset(path)) return *asset;
  prepare_gdal();
  return RasterFile(path).frame();
}

}  // namespace ifov::io
