#include "studies/common/reference_data.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "core/format.h"
#include "io/files/input_file.h"
#include "studies/common/study_options.h"

namespace ifov::studies {

std::filesystem::path reference_folder(const StudyOptions& options) {
  if (!options.reference.empty()) {
    std::error_code unknown;
    if (!std::filesystem::is_directory(options.reference, unknown))
      throw InputError(
          format("'{}' is no folder: reference data were said to be there", options.reference.string()));
    return options.reference;
  }
  const char* given = std::getenv("IFOV_TRUTH");
  return given != nullptr ? given : "";
}

std::vector<std::vector<double>> number_rows(const std::filesystem::path& file, std::size_t least_columns) {
  std::vector<std::vector<double>> rows;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return rows;
  std::istringstream stream(io::read_input(file));
  for (std::string line; std::getline(stream, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double> row;
    for (double value; words >> value;) row.push_back(value);
    if (row.size() >= least_columns) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ifov::studies
