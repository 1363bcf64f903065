#include "io/products/geotiff.h"

#include <cpl_error.h>
#include <gdal_priv.h>

#include <vector>

#include "core/error.h"
#include "io/products/map_info.h"
#include "io/raster/gdal_setup.h"

namespace ifov::io {
namespace {

/// GDAL reports here instead of printing; the first failure is kept.
struct FirstFailure {
  FirstFailure() { CPLPushErrorHandlerEx(remember, this); }
  ~FirstFailure() { CPLPopErrorHandler(); }
  FirstFailure(const FirstFailure&) = delete;
  FirstFailure& operator=(const FirstFailure&) = delete;

  static void CPL_STDCALL remember(CPLErr severity, CPLErrorNum, const char* message) {
    auto* self = static_cast<FirstFailure*>(CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure && self->message.empty()) self->message = message;
  }
  std::string message;
};

GDALDriver& tiff_driver() {
  prepare_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) throw EnvironmentError("this GDAL cannot write GeoTIFF");
  return *driver;
}

void describe(GDALDataset& data, const RunRecord& record) {
  const auto& info = record.image;
  if (info.has_map) {
    auto transform = geotransform(info);
    data.SetGeoTransform(transform.data());
    const std::string system = coordinate_system_text(info);
    if (!system.empty()) data.SetProjection(system.c_str());
  }
  data.SetMetadataItem("TIFFTAG_SOFTWARE", format("ifov {}", record.identity.version).c_str());
  data.SetMetadataItem(
      "TIFFTAG_IMAGEDESCRIPTION",
      format("radiance in {}; document {}; seed {}; {}", info.radiance_unit, record.identity.document_path,
             record.identity.seed, record.outcome.accuracy_statement)
          .c_str());
  for (int b = 1; b <= data.GetRasterCount(); ++b) {
    const auto& channel = info.channels[static_cast<std::size_t>(b - 1)];
    GDALRasterBand& band = *data.GetRasterBand(b);
    band.SetDescription(channel.name.c_str());
    band.SetUnitType(info.radiance_unit.c_str());
    const std::string centre = format("{:.10g}", channel.centre_um),
                      fwhm = format("{:.10g}", channel.fwhm_um);
    band.SetMetadataItem("wavelength", centre.c_str());
    band.SetMetadataItem("wavelength_units", "Micrometers");
    band.SetMetadataItem("fwhm", fwhm.c_str());
    band.SetMetadataItem("CENTRAL_WAVELENGTH_UM", centre.c_str(), "IMAGERY");
    band.SetMetadataItem("FWHM_UM", fwhm.c_str(), "IMAGERY");
  }
}

}  // namespace

void write_geotiff(PartFile& file, const RasterView& radiance, const RunRecord& record) {
  const std::filesystem::path folder = file.part_path().parent_path();
  require_space(folder, std::uint64_t{4} * static_cast<std::uint64_t>(radiance.width) *
                            static_cast<std::uint64_t>(radiance.height) *
                            static_cast<std::uint64_t>(radiance.bands));
  const NoSidecars none;
  FirstFailure failure;
  const char* const options[] = {"INTERLEAVE=BAND", "BIGTIFF=IF_SAFER", nullptr};
  GDALDataset* data = tiff_driver().Create(file.part_path().c_str(), radiance.width, radiance.height,
                                           radiance.bands, GDT_Float32, options);
  if (data != nullptr) {
    describe(*data, record);
    std::vector<float> line(static_cast<std::size_t>(radiance.width));
    for (int b = 0; b < radiance.bands && failure.message.empty(); ++b)
      for (int y = 0; y < radiance.height && failure.message.empty(); ++y) {
        radiance.read(y, b, line);
        const CPLErr error = data->GetRasterBand(b + 1)->RasterIO(
            GF_Write, 0, y, radiance.width, 1, line.data(), radiance.width, 1, GDT_Float32, 0, 0, nullptr);
        if (error >= CE_Failure && failure.message.empty()) failure.message = "the line could not be written";
      }
    GDALClose(data);
  }
  if (!failure.message.empty() || data == nullptr)
    throw EnvironmentError(format("{}: cannot be written: {}", file.part_path().string(), failure.message));
}

}  // namespace ifov::io
