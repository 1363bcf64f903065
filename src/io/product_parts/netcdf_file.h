#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/product_parts/netcdf_functions.h"

namespace ifov::io {

/// A NetCDF file that is being made: defined first, then filled. Lock netcdf_mutex() for as long as it lives. All throw SystemError
/// with the path and netCDF's reason.
class NetcdfFile {
 public:
  /// `format`: NC_64BIT_OFFSET, or NC_64BIT_DATA for variables beyond 4 GiB.
  explicit NetcdfFile(std::string path, int format = NC_64BIT_OFFSET);
  /// What was not closed is thrown away.
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  int id() const { return file_; }
  /// Of a call of netCDF.
  void require(int status) const;

  int dimension(const char* name, std::size_t size) const;
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const;
  /// The same with the attributes that each variable has; no units where they are empty.
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions,
               const std::string& long_name, const std::string& units) const;
  /// An attribute, of NC_GLOBAL too.
  void text(int variable, const char* name, const std::string& value) const;

  void end_definition() const { require(late::nc_enddef(file_)); }
  void put(int variable, const std::vector<double>& values) const;
  /// Rows of characters as long as the longest of `names` and filled up with 0, at least 1 (name_length).
  void put(int variable, std::span<const std::string> names) const;
  void close();

 private:
  std::string path_;
  int file_ = -1;
};

std::size_t name_length(std::span<const std::string> names);

}  // namespace ifov::io
