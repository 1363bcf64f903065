#pragma once

#include <vector>

#include "honesty/figure_row.h"
#include "honesty/rows_study.h"

namespace ifov::benchmarks {

/// Runs the study, prints its figures and the worst scenes, and gives what must hold as rows.
std::vector<FigureRow> report_rows_study(const RowsStudy& study);

}  // namespace ifov::benchmarks
