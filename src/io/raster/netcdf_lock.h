#pragma once

#include <mutex>

namespace ifov::io {

/// To be held while a netCDF file is open: the netCDF library keeps one list of them, and does not guard it.
inline std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace ifov::io
