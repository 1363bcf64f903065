#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// The cubes a report is made from; the part of the page that needs an empty one is left away.
struct ReportInput {
  RasterView radiance, half_width;  ///< one band a channel
  RasterView samples;               ///< first band: samples per pixel
  RasterView quality;               ///< converged, half-width over limit, missable fraction, borders' share
  RasterView reasons;               ///< bits of sampling::Reason
  std::vector<int> picture;         ///< channels of the picture; empty: chosen from wavelengths
};

/// One self-contained HTML page: image with band slider, spectrum with intervals, maps, histograms,
/// statements and channel table. Values are embedded as 16-bit numbers while they take no more than
/// `embed_limit_bytes`; of larger images every n-th pixel, and the page says so.
std::string make_report(const RunRecord& record, const ReportInput& input,
                        std::size_t embed_limit_bytes = std::size_t{24} << 20);

}  // namespace ifov::io
