#include "io/products/geotiff.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/product_parts/gdal_view.h"
#include "io/product_parts/map_info.h"
#include "io/product_parts/product_headers.h"
#include "io/quantities/radiance_quantities.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"

namespace ifov::io {
namespace {

/// GDAL reports here instead of printing; the first failure is kept.
struct FirstFailure {
  FirstFailure() { late::CPLPushErrorHandlerEx(remember, this); }
  ~FirstFailure() { late::CPLPopErrorHandler(); }
  FirstFailure(const FirstFailure&) = delete;
  FirstFailure& operator=(const FirstFailure&) = delete;

  static void CPL_STDCALL remember(CPLErr severity, CPLErrorNum, const char* message) {
    auto* self = static_cast<FirstFailure*>(late::CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure && self->message.empty()) self->message = message;
  }
  std::string message;
};

GDALDriverH cog_driver() {
  prepare_gdal();
  const GDALDriverH driver = late::GDALGetDriverByName("COG");
  if (driver == nullptr) throw SystemError("this GDAL cannot write GeoTIFF");
  return driver;
}

/// Sides of tiles: all channels of a tile lie side by side in the file, and many of them are read and written in smaller
/// pieces.
int tile_side(int bands) {
  constexpr int kMostBytes = 8 << 20;
  int side = 512;
  while (side > 64 && 4 * side * side > kMostBytes / bands) side /= 2;
  return side;
}

/// Without a picture in colour the first band is grey: the format can name no other.
GDALColorInterp colour_of(int band, const std::vector<int>& picture) {
  constexpr GDALColorInterp kColours[] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
  if (picture.size() != 3) return band == 0 ? GCI_GrayIndex : GCI_Undefined;
  for (std::size_t k = 0; k < picture.size(); ++k)
    if (picture[k] == band) return kColours[k];
  return GCI_Undefined;
}

/// The driver builds overviews in files of such names; what stands there already, a link perhaps, is not written to.
void clear_passing_files(const std::filesystem::path& part) {
  for (const char* ending : {".ovr.tmp", ".msk.ovr.tmp", ".warped.tif.tmp"}) {
    std::error_code ignored;
    std::filesystem::remove(part.string() + ending, ignored);
  }
}

void set(GDALMajorObjectH object, const char* name, const std::string& value) {
  late::GDALSetMetadataItem(object, name, value.c_str(), nullptr);
}

void describe(GDALDatasetH data, const RunRecord& record) {
  const auto& info = record.image;
  if (info.has_map) {
    auto transform = geotransform(info);
    late::GDALSetGeoTransform(data, transform.data());
    const std::string system = coordinate_system_text(info);
    if (!system.empty()) late::GDALSetProjection(data, system.c_str());
  }
  if (const std::string& time = record.identity.acquisition.time; !time.empty())
    set(data, "acquisition_time", time);
  const std::vector<int> picture = picture_channels(info);
  set(data, "TIFFTAG_SOFTWARE", format("ifov {}", record.identity.version));
  set(data, "TIFFTAG_IMAGEDESCRIPTION",
      format("radiance in {}; document {}; seed {}; {}", info.radiance_unit, record.identity.document_path,
             record.identity.seed, record.outcome.accuracy_statement));
  for (int b = 1; b <= late::GDALGetRasterCount(data); ++b) {
    const auto& channel = info.channels[static_cast<std::size_t>(b - 1)];
    const GDALRasterBandH band = late::GDALGetRasterBand(data, b);
    late::GDALSetDescription(band, channel.name.c_str());
    late::GDALSetRasterUnitType(band, info.radiance_unit.c_str());
    late::GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN());
    late::GDALSetRasterColorInterpretation(band, colour_of(b - 1, picture));
    set(band, "wavelength", format("{:.10g}", channel.centre_um));
    set(band, "wavelength_units", "Micrometers");
    set(band, "fwhm", format("{:.10g}", channel.fwhm_um));
  }
}

}  // namespace

std::uint64_t geotiff_bytes(const render::ImageInfo& info) {
  const auto pixels = static_cast<std::uint64_t>(info.width_px) * static_cast<std::uint64_t>(info.height_px);
  // A third more are overviews, which for a while are there twice.
  return 4 * pixels * info.channels.size() * 5 / 3;
}

void write_geotiff(PartFile& file, const RasterView& radiance, const RunRecord& record) {
  require_space(file.part_path().parent_path(), geotiff_bytes(record.image));
  FirstFailure failure;
  const std::string block = format("BLOCKSIZE={}", tile_side(radiance.bands));
  const char* const options[] = {block.c_str(),   "COMPRESS=DEFLATE", "LEVEL=1",
                                 "PREDICTOR=YES", "BIGTIFF=IF_SAFER", "OVERVIEW_RESAMPLING=AVERAGE",
                                 nullptr};
  const GdalView source(radiance);
  describe(source.dataset(), record);
  const NoSidecars none;  // what the format cannot hold would go to a file beside it
  clear_passing_files(file.part_path());
  const GDALDatasetH written = late::GDALCreateCopy(cog_driver(), file.part_path().c_str(), source.dataset(),
                                                    FALSE, const_cast<char**>(options), nullptr, nullptr);
  if (written != nullptr) late::GDALClose(written);
  if (!failure.message.empty() || written == nullptr)
    throw SystemError(format("{}: cannot be written: {}", file.part_path().string(), failure.message));
}

constinit const ProductFormat formats::kGeotiff{
    .name = "geotiff",
    .ending = "_radiance.tif",
    .what = "radiance, GeoTIFF",
    .write =
        [](PartFile& file, const FormatInput& input) {
          write_geotiff(file, input.values_of(quantities::kRadiance), input.record);
        },
    .suits = is_picture,
    .bytes = [](const render::ImageInfo& image, const QuantitySet&) { return geotiff_bytes(image); }};

}  // namespace ifov::io
