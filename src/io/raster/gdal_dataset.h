#pragma once

#include <gdal.h>

#include <memory>

namespace ifov::io {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

}  // namespace ifov::io
