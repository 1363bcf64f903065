#pragma once

#include <string>
#include <vector>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"
#include "io/products/product_format.h"

namespace ifov::io {

/// A layer style of QGIS (QML) that shows the radiance as the picture does: QGIS applies the file that has the name of the
/// raster, with the ending .qml, and without one takes the first three bands for red, green and blue, whatever the raster says
/// of them. `channels` as for make_quicklook(). QGIS stretches linearly, in radiance, between the picture's ends.
std::string qgis_style(const RasterView& radiance, const RunRecord& record, const std::vector<int>& channels);

namespace formats {
extern const ProductFormat kQgisStyle;
}

}  // namespace ifov::io
