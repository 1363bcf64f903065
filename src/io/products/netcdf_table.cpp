#include <mutex>

#include "core/version.h"
#include "io/atmosphere_report/summary_table.h"
#include "io/product_parts/netcdf_file.h"
#include "io/products/netcdf.h"
#include "io/raster/netcdf_lock.h"

namespace ifov::io {
namespace {

void write_table(const std::string& path, const SummaryTable& table) {
  NetcdfFile file(path);
  const int channel = file.dimension("channel", table.rows.size()),
            length = file.dimension("name_length", name_length(table.rows));
  std::string description;
  for (const std::string& line : table.description) description += (description.empty() ? "" : "\n") + line;
  file.text(NC_GLOBAL, "Conventions", "CF-1.8");
  file.text(NC_GLOBAL, "title", "what the air does to light");
  file.text(NC_GLOBAL, "source", format("ifov {}", version()));
  file.text(NC_GLOBAL, "comment", description);
  const int name = file.variable("name", NC_CHAR, {channel, length}, "name of the channel", "");
  std::vector<int> variables;
  for (const SummaryTable::Column& column : table.columns) {
    variables.push_back(file.variable(column.name, NC_DOUBLE, {channel}, column.what, column.unit));
    file.text(variables.back(), "coordinates", "name");
  }
  file.end_definition();
  file.put(name, table.rows);
  for (std::size_t k = 0; k < variables.size(); ++k) file.put(variables[k], table.columns[k].values);
  file.close();
}

}  // namespace

void write_netcdf(const std::filesystem::path& path, const SummaryTable& table) {
  PartFile file(path);
  {
    const std::scoped_lock lock(netcdf_mutex());
    write_table(file.part_path().string(), table);
  }
  file.publish();
}

}  // namespace ifov::io
