#include "session/surveys/atmosphere_summary.h"

#include "core/error.h"
#include "io/atmosphere_report/summary_table.h"
#include "io/products/netcdf.h"
#include "io/products/part_file.h"

namespace ifov::session {

void write_summary(const io::AtmosphereReport& report, const std::filesystem::path& path, bool steps) {
  const std::string ending = path.extension().string();
  if (ending != ".csv" && ending != ".nc")
    throw InputError(format("'{}': expected a name that ends in .csv or .nc", path.string()));
  const io::SummaryTable table = io::summary_table(report, steps);
  if (ending == ".nc") return io::write_netcdf(path, table);
  io::PartFile file(path);
  io::write_part(file, io::summary_csv(table));
  file.publish();
}

}  // namespace ifov::session
