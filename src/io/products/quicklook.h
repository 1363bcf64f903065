#pragma once

#include <string>
#include <vector>

#include "io/products/raster_view.h"
#include "io/products/run_record.h"

namespace ifov::io {

/// A PNG for people: three channels in colour, or one through a colour map with its bar (brightness
/// temperature in the thermal infrared), with title, range, scale bar and accuracy. `channels`: three, one,
/// or empty for a choice by wavelength.
std::string make_quicklook(const RasterView& radiance, const RunRecord& record,
                           const std::vector<int>& channels);

}  // namespace ifov::io
