#pragma once

#include <string>

#include "studies/common/report_figures.h"

namespace ifov::studies {

struct ImageCurves;

/// A section of the page: time over RMS error as curves, and a table of them.
std::string image_curves_report(const ImageCurves& curves, ReportFigures& figures);

}  // namespace ifov::studies
