#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ifov::io {

/// A variable of a netCDF file, all its values in the file's order: the last dimension runs fastest.
struct NetcdfVariable {
  std::vector<std::size_t> dimensions;
  std::vector<double> values;
};

/// InputError where the file cannot be read or has no such variable.
NetcdfVariable read_netcdf_variable(const std::filesystem::path& path, const std::string& name);

}  // namespace ifov::io
