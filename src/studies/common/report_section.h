#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "studies/common/figures.h"
#include "studies/common/report_plot.h"

namespace ifov::studies {

class ReportFigures;

struct ReportPlot {
  std::string name;  ///< of its file, without extension
  Plot plot;
  std::string caption;
};

/// What one page shows: sections of figures and plots.
struct ReportSection {
  std::string title, text;
  FigureTable figures;
  std::vector<ReportPlot> plots;

  /// A figure that could not be taken, and what was missing.
  void not_measured(const std::string& name, const std::string& meaning, const std::string& missing) {
    figures.report(name, std::numeric_limits<double>::quiet_NaN(), "",
                   meaning + " (not measured: no " + missing + ")");
  }
};

/// A figure that a study cannot take.
struct NotMeasured {
  const char *name, *meaning, *missing;
};
/// What is asked of what a study is of ("sensors") and is not measured there.
ReportSection unmeasured_of(std::string_view of, const std::vector<NotMeasured>& figures);

/// One self-contained page of sections; their plots are added to `figures`.
std::string sections_page(std::string_view title, const std::vector<ReportSection>& sections,
                          ReportFigures& figures);

/// The same as Markdown; its plots are PREFIX_name.svg beside it.
std::string sections_markdown(std::string_view title, std::string_view about, std::string_view prefix,
                              const std::vector<ReportSection>& sections);

}  // namespace ifov::studies
