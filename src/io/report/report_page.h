#pragma once

namespace ifov::io {

extern const char* const kReportStyle;  ///< CSS

/// JavaScript that reads the embedded data and draws everything: one function in these parts, one behind the other.
extern const char* const kReportScript;         ///< data, image, spectrum, maps and histograms
extern const char* const kReportQualityScript;  ///< reasons of pixels
extern const char* const kReportBeginScript;    ///< what clicks do, and the first drawing

}  // namespace ifov::io
