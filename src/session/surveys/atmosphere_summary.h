#pragma once

#include <filesystem>

namespace ifov::io {
struct AtmosphereReport;
}

namespace ifov::session {

/// The report's summary_table, CSV or NetCDF as the name ends (.csv, .nc). Throws InputError for other endings, SystemError where
/// it cannot be written.
void write_summary(const io::AtmosphereReport& report, const std::filesystem::path& path, bool steps);

}  // namespace ifov::session
