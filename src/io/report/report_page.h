#pragma once

namespace ifov::io {

extern const char* const kReportStyle;   ///< CSS
extern const char* const kReportScript;  ///< JavaScript: reads the embedded data, draws everything

}  // namespace ifov::io
