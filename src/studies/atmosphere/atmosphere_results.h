#pragma once

#include <string>
#include <vector>

#include "studies/common/study_sections.h"

namespace ifov::studies {

struct ModelComparison;

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

AtmosphereSection lowtran7_section(const SectionOptions& options);
AtmosphereSection terms_section(const SectionOptions& options);
AtmosphereSection scattering_section(const SectionOptions& options);
AtmosphereSection solar_codes_section(const SectionOptions& options);
AtmosphereSection thermal_codes_section(const SectionOptions& options);
AtmosphereSection model_section(const std::vector<ModelComparison>& comparisons);
AtmosphereSection broadband_section(const SectionOptions& options);
AtmosphereSection round_earth_section(const SectionOptions& options);
AtmosphereSection nodes_section(const SectionOptions& options);
AtmosphereSection rendered_section(const SectionOptions& options);
AtmosphereSection sun_section(const SectionOptions& options);
AtmosphereSection speed_section(const SectionOptions& options);

}  // namespace ifov::studies
