#pragma once

#include <string>

#include "studies/common/report_figures.h"
#include "studies/suburb/suburb_study.h"

namespace ifov::studies {

/// The study's page: table 2, figures 8, 12 and 13 of the paper, and what ours does.
std::string suburb_report(const SceneResults& results, ReportFigures& figures);

}  // namespace ifov::studies
