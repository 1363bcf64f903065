#pragma once

namespace ifov::studies {

/// Draws and turns the panels of scatter_panels().
extern const char* const kScatterScript;

}  // namespace ifov::studies
