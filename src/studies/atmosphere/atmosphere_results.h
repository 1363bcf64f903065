#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studies/common/report_section.h"
#include "studies/common/study_options.h"

namespace ifov::studies {

struct ModelComparison;

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

/// Lines of numbers, separated by blanks or commas; what else a line holds ends it. Shorter ones are left
/// out.
std::vector<std::vector<double>> number_rows(const std::filesystem::path& file, std::size_t least_columns);

/// Differences of a run of comparisons.
class Differences {
 public:
  void add(double value, double reference);
  double rms() const;
  double mean() const { return count_ > 0 ? sum_ / count_ : 0.0; }
  double largest() const { return largest_; }
  int count() const { return count_; }

 private:
  double sum_ = 0.0, squares_ = 0.0, largest_ = 0.0;
  int count_ = 0;
};

using AtmosphereSection = ReportSection;

struct AtmosphereOptions {
  const ReferenceData& reference;
  const StudyOptions& study;
  bool quick = false;
};

AtmosphereSection lowtran7_section(const AtmosphereOptions& options);
AtmosphereSection terms_section(const AtmosphereOptions& options);
AtmosphereSection scattering_section(const AtmosphereOptions& options);
AtmosphereSection solar_codes_section(const AtmosphereOptions& options);
AtmosphereSection thermal_codes_section(const AtmosphereOptions& options);
AtmosphereSection model_section(const std::vector<ModelComparison>& comparisons);
AtmosphereSection broadband_section(const AtmosphereOptions& options);
AtmosphereSection nodes_section(const AtmosphereOptions& options);
AtmosphereSection rendered_section(const AtmosphereOptions& options);
AtmosphereSection sun_section(const AtmosphereOptions& options);
AtmosphereSection speed_section(const AtmosphereOptions& options);

}  // namespace ifov::studies
