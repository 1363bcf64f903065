#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "io/products/run_record.h"

namespace ifov::io {

/// The cubes a report is made from; empty paths leave the part of the page that needs them away.
struct ReportInput {
  std::filesystem::path radiance, half_width, samples, quality;
};

/// One self-contained HTML page: image with band slider, spectrum with intervals, maps, histograms,
/// statements and channel table. Values are embedded as 16-bit numbers while they take no more than
/// `embed_limit_bytes`; of larger images every n-th pixel, and the page says so.
std::string make_report(const RunRecord& record, const ReportInput& input,
                        std::size_t embed_limit_bytes = std::size_t{24} << 20);

}  // namespace ifov::io
