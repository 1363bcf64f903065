#pragma once

namespace ifov::studies {

/// Draws and turns the panels of scatter_plots().
extern const char* const kScatterPlotScript;

}  // namespace ifov::studies
