#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/common/report_plot.h"

namespace ifov::studies {

/// The plots and panels of a report: each is shown in the page, and kept as SVG and PDF for those who write papers.
class ReportFigures {
 public:
  /// What the page shows; files are named after the title.
  std::string add(const Plot& plot) { return add(plot.title, draw(plot)); }
  std::string add(const ImagePanel& panel) { return add(panel.title, draw(panel)); }

  /// figures/<name>.svg and .pdf in a study's folder. Their paths.
  std::vector<std::filesystem::path> write(const std::filesystem::path& folder) const;

 private:
  struct Kept {
    std::string name;
    DrawnFigure figure;
  };
  std::string add(const std::string& title, DrawnFigure figure);

  std::vector<Kept> kept_;
};

}  // namespace ifov::studies
