#pragma once

#include <string>
#include <vector>

namespace ifov::io {

struct AtmosphereReport;

/// What correction codes ask of an atmosphere, as columns: a row for each channel, or for each step of the spectrum.
struct SummaryTable {
  struct Column {
    std::string name, unit, what;
    std::vector<double> values;
  };
  std::vector<std::string> description;  ///< air, aerosol and geometry, a line each
  std::vector<std::string> rows;         ///< names of channels, or wavelengths of steps
  std::vector<Column> columns;           ///< as many values as rows in each
};

/// `steps`: of the spectrum, which the report has. Without a Sun the columns that are shares of sunlight are left out.
SummaryTable summary_table(const AtmosphereReport& report, bool steps);

/// Lines that begin with # tell air, units and what columns are; the first column is the name of the row.
std::string summary_csv(const SummaryTable& table);

}  // namespace ifov::io
