#include <algorithm>
#include <mutex>

#include "core/error.h"
#include "core/version.h"
#include "io/atmosphere_report/summary_table.h"
#include "io/product_parts/netcdf_functions.h"
#include "io/products/netcdf.h"
#include "io/raster/netcdf_lock.h"

namespace ifov::io {
namespace {

class TableWriter {
 public:
  explicit TableWriter(const std::string& path) : path_(path) {
    require(late::nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &file_));
  }
  ~TableWriter() {
    if (file_ >= 0) late::nc_abort(file_);
  }
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;

  void write(const SummaryTable& table) {
    std::size_t widest = 1;
    for (const std::string& row : table.rows) widest = std::max(widest, row.size());
    int rows = 0, length = 0, name = 0;
    require(late::nc_def_dim(file_, "channel", table.rows.size(), &rows));
    require(late::nc_def_dim(file_, "name_length", widest, &length));
    std::string description;
    for (const std::string& line : table.description) description += (description.empty() ? "" : "\n") + line;
    text(NC_GLOBAL, "Conventions", "CF-1.8");
    text(NC_GLOBAL, "title", "what the air does to light");
    text(NC_GLOBAL, "source", format("ifov {}", version()));
    text(NC_GLOBAL, "comment", description);
    const int both[] = {rows, length};
    require(late::nc_def_var(file_, "name", NC_CHAR, 2, both, &name));
    text(name, "long_name", "name of the channel");
    std::vector<int> variables;
    for (const SummaryTable::Column& column : table.columns) {
      int& variable = variables.emplace_back();
      require(late::nc_def_var(file_, column.name.c_str(), NC_DOUBLE, 1, &rows, &variable));
      text(variable, "units", column.unit);
      text(variable, "long_name", column.what);
      text(variable, "coordinates", "name");
    }
    require(late::nc_enddef(file_));
    std::string names;
    for (const std::string& row : table.rows) names += row + std::string(widest - row.size(), '\0');
    require(late::nc_put_var_text(file_, name, names.c_str()));
    for (std::size_t k = 0; k < variables.size(); ++k)
      require(late::nc_put_var_double(file_, variables[k], table.columns[k].values.data()));
    const int status = late::nc_close(file_);
    file_ = -1;
    require(status);
  }

 private:
  void require(int status) const {
    if (status != NC_NOERR)
      throw SystemError(format("{}: cannot be written: {}", path_, late::nc_strerror(status)));
  }
  void text(int variable, const char* name, const std::string& value) const {
    require(late::nc_put_att_text(file_, variable, name, value.size(), value.c_str()));
  }

  std::string path_;
  int file_ = -1;
};

}  // namespace

void write_netcdf(const std::filesystem::path& path, const SummaryTable& table) {
  PartFile file(path);
  {
    const std::scoped_lock lock(netcdf_mutex());
    TableWriter(file.part_path().string()).write(table);
  }
  file.publish();
}

}  // namespace ifov::io
