#include "io/products/gdal_view.h"

#include <cpl_error.h>
#include <gdal_pam.h>

#include <exception>

namespace ifov::io {
namespace {

class ViewBand final : public GDALPamRasterBand {
 public:
  ViewBand(GDALDataset* data, int band, const RasterView& view) : view_(view) {
    poDS = data;
    nBand = band;
    eDataType = GDT_Float32;
    nBlockXSize = view.width;
    nBlockYSize = 1;
  }

 protected:
  CPLErr IReadBlock(int, int line, void* values) override {
    try {
      view_.read(line, nBand - 1, {static_cast<float*>(values), static_cast<std::size_t>(view_.width)});
      return CE_None;
    } catch (const std::exception& error) {
      CPLError(CE_Failure, CPLE_FileIO, "%s", error.what());
      return CE_Failure;
    }
  }

 private:
  const RasterView& view_;
};

/// The Pam classes keep what is set on them; without a name nothing of it goes to a file.
class ViewDataset final : public GDALPamDataset {
 public:
  explicit ViewDataset(const RasterView& view) {
    nRasterXSize = view.width;
    nRasterYSize = view.height;
    for (int band = 1; band <= view.bands; ++band) SetBand(band, new ViewBand(this, band, view));
  }
};

}  // namespace

std::unique_ptr<GDALDataset> gdal_view(const RasterView& view) { return std::make_unique<ViewDataset>(view); }

}  // namespace ifov::io
