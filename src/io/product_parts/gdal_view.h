#pragma once

#include "io/product_parts/raster_view.h"
#include "io/raster/gdal_dataset.h"

namespace ifov::io {

/// A raster that GDAL reads through a view, line by line, while this lives; what the view throws is a failure of GDAL's. Keeps a
/// reference to the view.
class GdalView {
 public:
  explicit GdalView(const RasterView& view);
  ~GdalView();
  GdalView(const GdalView&) = delete;
  GdalView& operator=(const GdalView&) = delete;
  GDALDatasetH dataset() const { return dataset_.get(); }

 private:
  std::string name_;
  Dataset dataset_;
};

}  // namespace ifov::io
