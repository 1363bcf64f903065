#pragma once

#include <string>

#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"

namespace ifov::io {

/// Keeps GDAL's messages of this thread from the terminal, and hands out the last one.
class QuietGdal {
 public:
  QuietGdal() {
    late::CPLPushErrorHandler(late::CPLQuietErrorHandler);
    late::CPLErrorReset();
  }
  ~QuietGdal() { late::CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  std::string message() const {
    std::string text = without_input_prefix(late::CPLGetLastErrorMsg());
    while (text.ends_with('\n')) text.pop_back();
    return text.empty() ? "GDAL gives no reason" : text;
  }
};

}  // namespace ifov::io
