#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ifov::studies {

struct StudyOptions;

/// Published and computed reference data, one folder of small files, which are read in place.
class ReferenceData {
 public:
  explicit ReferenceData(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Nothing where it is absent.
  std::optional<std::filesystem::path> file(const std::string& relative) const {
    std::error_code error;
    if (folder_.empty() || !std::filesystem::exists(folder_ / relative, error)) return std::nullopt;
    return folder_ / relative;
  }

 private:
  std::filesystem::path folder_;
};

/// Where the options say it is, else the environment variable IFOV_TRUTH; empty: nowhere. Throws InputError where the options name no folder.
std::filesystem::path reference_folder(const StudyOptions& options);

/// Lines of numbers, separated by blanks or commas; what else a line holds ends it. Shorter ones are left
/// out.
std::vector<std::vector<double>> number_rows(const std::filesystem::path& file, std::size_t least_columns);

}  // namespace ifov::studies
