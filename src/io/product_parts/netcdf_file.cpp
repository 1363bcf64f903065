#include "io/product_parts/netcdf_file.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace ifov::io {

NetcdfFile::NetcdfFile(std::string path, int format) : path_(std::move(path)) {
  require(late::nc_create(path_.c_str(), NC_CLOBBER | format, &file_));
}

NetcdfFile::~NetcdfFile() {
  if (file_ >= 0) late::nc_abort(file_);
}

void NetcdfFile::require(int status) const {
  if (status != NC_NOERR)
    throw SystemError(format("{}: cannot be written: {}", path_, late::nc_strerror(status)));
}

int NetcdfFile::dimension(const char* name, std::size_t size) const {
  int id = 0;
  require(late::nc_def_dim(file_, name, size, &id));
  return id;
}

int NetcdfFile::variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const {
  int id = 0;
  require(late::nc_def_var(file_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(),
                           &id));
  return id;
}

int NetcdfFile::variable(const std::string& name, nc_type type, const std::vector<int>& dimensions,
                         const std::string& long_name, const std::string& units) const {
  const int id = variable(name, type, dimensions);
  text(id, "long_name", long_name);
  if (!units.empty()) text(id, "units", units);
  return id;
}

void NetcdfFile::text(int variable, const char* name, const std::string& value) const {
  require(late::nc_put_att_text(file_, variable, name, value.size(), value.c_str()));
}

void NetcdfFile::put(int variable, const std::vector<double>& values) const {
  require(late::nc_put_var_double(file_, variable, values.data()));
}

void NetcdfFile::put(int variable, std::span<const std::string> names) const {
  const std::size_t length = name_length(names);
  std::string rows;
  for (const std::string& name : names) rows += name + std::string(length - name.size(), '\0');
  require(late::nc_put_var_text(file_, variable, rows.c_str()));
}

void NetcdfFile::close() {
  const int status = late::nc_close(file_);
  file_ = -1;
  require(status);
}

std::size_t name_length(std::span<const std::string> names) {
  std::size_t length = 1;
  for (const std::string& name : names) length = std::max(length, name.size());
  return length;
}

}  // namespace ifov::io
