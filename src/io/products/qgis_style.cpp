#include "io/products/qgis_style.h"

#include "core/format.h"
#include "io/product_parts/picture.h"
#include "io/product_parts/product_headers.h"
#include "io/products/part_file.h"
#include "io/quantities/radiance_quantities.h"

namespace ifov::io {
namespace {

std::string stretch(const char* name, const Range& range) {
  return format(
      "      <{0}><minValue>{1:.9g}</minValue><maxValue>{2:.9g}</maxValue><algorithm>StretchToMinimumMaximum</algorithm></{0}>\n",
      name, range.low, range.high);
}

}  // namespace

std::string qgis_style(const RasterView& radiance, const RunRecord& record,
                       const std::vector<int>& channels) {
  const std::vector<int> chosen = channels.empty() ? picture_channels(record.image) : channels;
  std::string renderer;
  if (chosen.size() == 3) {
    const std::vector<Range> ranges = colour_ranges(radiance, record.image, chosen);
    renderer = format(
        "    <rasterrenderer type=\"multibandcolor\" redBand=\"{}\" greenBand=\"{}\" blueBand=\"{}\" alphaBand=\"-1\" opacity=\"1\">\n",
        chosen[0] + 1, chosen[1] + 1, chosen[2] + 1);
    renderer += "      <rasterTransparency/>\n" + stretch("redContrastEnhancement", ranges[0]) +
                stretch("greenContrastEnhancement", ranges[1]) +
                stretch("blueContrastEnhancement", ranges[2]);
  } else {
    const int factor = averaging_factor(radiance.width, radiance.height);
    const Range range = percentiles(averaged_layer(radiance, chosen[0], factor), kLowShare, kHighShare);
    renderer = format(
        "    <rasterrenderer type=\"singlebandgray\" grayBand=\"{}\" gradient=\"BlackToWhite\" alphaBand=\"-1\" opacity=\"1\">\n",
        chosen[0] + 1);
    renderer += "      <rasterTransparency/>\n" + stretch("contrastEnhancement", range);
  }
  return "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n<qgis version=\"3.22\" styleCategories=\"Symbology\">\n  <pipe>\n" +
         renderer + "    </rasterrenderer>\n  </pipe>\n</qgis>\n";
}

constinit const ProductFormat formats::kQgisStyle{
    .name = "",
    .ending = "_radiance.qml",
    .what = "layer style for QGIS",
    .write =
        [](PartFile& file, const FormatInput& input) {
          write_part(
              file, qgis_style(input.values_of(quantities::kRadiance), input.record, input.picture_channels));
        },
    .suits = is_picture};

}  // namespace ifov::io
