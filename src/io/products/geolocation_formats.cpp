#include <array>
#include <cmath>

#include "core/format.h"
#include "io/product_parts/lookup_table.h"
#include "io/product_parts/map_info.h"
#include "io/product_parts/product_headers.h"
#include "io/product_parts/run_record.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"
#include "io/quantities/location_quantities.h"

namespace ifov::io {
namespace {

PixelPlaces places_of(const WideView& location) {
  PixelPlaces places;
  places.width = location.width, places.height = location.height;
  const auto width = static_cast<std::size_t>(places.width);
  const std::size_t pixels = width * static_cast<std::size_t>(places.height);
  places.x_m.resize(pixels), places.y_m.resize(pixels);
  for (int line = 0; line < places.height; ++line) {
    location.read(line, 0, {&places.x_m[places.at(0, line)], width});
    location.read(line, 1, {&places.y_m[places.at(0, line)], width});
  }
  return places;
}

std::string header_of(const LookupTable& table, const RunRecord& record) {
  render::ImageInfo grid = record.image;
  grid.width_px = table.width, grid.height_px = table.height;
  grid.has_map = true, grid.map_rotation_rad = 0.0;
  grid.map_x_m = table.left_m, grid.map_y_m = table.top_m, grid.gsd_m = table.cell_m;
  EnviHeader header =
      image_header("geographic lookup table of the image", grid, record.identity, std::string());
  header.description +=
      "\nwhich pixel of the image each cell of the map shows, its column and its line from 1; negative: none lies in the cell, and it has "
      "the nearest; 0: the image does not see it";
  header.bands = 2;
  header.data_type = EnviType::int32;
  header.data_units = "1";
  header.band_names = {"GLT Sample Lookup", "GLT Line Lookup"};
  header.other["data ignore value"] = "0";
  return to_text(header);
}

void write_lookup_table(PartFile& file, const FormatInput& input) {
  LookupTable table = make_lookup_table(places_of(input.wide_values_of(quantities::kLocation)));
  if (table.width == 0)  // no pixel sees anything
    table.width = table.height = 1, table.cell_m = 1.0, table.sample = table.line = {0};
  const std::size_t bytes = sizeof(std::int32_t) * static_cast<std::size_t>(table.width);
  for (int y = 0; y < table.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(table.width);
    file.write_at(2 * static_cast<std::size_t>(y) * bytes, &table.sample[first], bytes);
    file.write_at((2 * static_cast<std::size_t>(y) + 1) * bytes, &table.line[first], bytes);
  }
  input.put_header(header_of(table, input.record));
}

std::uint64_t lookup_table_bytes(const render::ImageInfo& image, const QuantitySet&) {
  return std::uint64_t{2 * sizeof(std::int32_t) * kMostCellsPerPixel} *
         static_cast<std::uint64_t>(image.width_px) * static_cast<std::uint64_t>(image.height_px);
}

std::string as_xml(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  return result;
}

/// The radiance with its geolocation arrays (GDAL's RFC 4), which name the cubes that lie beside it.
std::string virtual_raster(const RunRecord& record, const std::string& cube, const std::string& location) {
  const render::ImageInfo& image = record.image;
  const std::string system = coordinate_system_text(image);
  std::string text =
      format("<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n  <Metadata domain=\"GEOLOCATION\">\n",
             image.width_px, image.height_px);
  const std::array<std::pair<const char*, std::string>, 11> items{
      {{"X_DATASET", location},
       {"X_BAND", "1"},
       {"X_DATASET_RELATIVE_TO_SOURCE", "YES"},
       {"Y_DATASET", location},
       {"Y_BAND", "2"},
       {"Y_DATASET_RELATIVE_TO_SOURCE", "YES"},
       {"PIXEL_OFFSET", "0"},
       {"PIXEL_STEP", "1"},
       {"LINE_OFFSET", "0"},
       {"LINE_STEP", "1"},
       {"GEOREFERENCING_CONVENTION", "PIXEL_CENTER"}}};
  for (const auto& [key, value] : items) text += format("    <MDI key=\"{}\">{}</MDI>\n", key, as_xml(value));
  if (!system.empty()) text += format("    <MDI key=\"SRS\">{}</MDI>\n", as_xml(system));
  text += "  </Metadata>\n";
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    const render::ChannelInfo& channel = image.channels[c];
    text += format(
        "  <VRTRasterBand dataType=\"Float32\" band=\"{}\">\n    <Metadata>\n      <MDI key=\"wavelength\">{:.9g}</MDI>\n"
        "      <MDI key=\"wavelength_units\">Micrometers</MDI>\n    </Metadata>\n    <Description>{}</Description>\n"
        "    <UnitType>{}</UnitType>\n    <NoDataValue>nan</NoDataValue>\n    <SimpleSource>\n"
        "      <SourceFilename relativeToVRT=\"1\">{}</SourceFilename>\n      <SourceBand>{}</SourceBand>\n    </SimpleSource>\n"
        "  </VRTRasterBand>\n",
        c + 1, channel.centre_um, as_xml(channel.name), as_xml(image.radiance_unit), as_xml(cube), c + 1);
  }
  return text + "</VRTDataset>\n";
}

/// Name of a cube beside a file of the products: "image_radiance.vrt" and "radiance" make "image_radiance.img".
std::string beside(const PartFile& file, std::string_view ending, std::string_view cube) {
  std::string name = file.final_path().filename().string();
  name.erase(name.size() - ending.size());
  return format("{}_{}.img", name, cube);
}

constexpr std::string_view kVirtualEnding = "_radiance.vrt";

}  // namespace

constinit const ProductFormat formats::kGlt{.name = "glt",
                                            .ending = "_glt.img",
                                            .what = "geographic lookup table, ENVI",
                                            .write = write_lookup_table,
                                            .suits = is_picture,
                                            .bytes = lookup_table_bytes,
                                            .has_header = true,
                                            .needs = &quantities::kLocation};

constinit const ProductFormat formats::kGeolocatedVrt{
    .name = "vrt",
    .ending = kVirtualEnding,
    .what = "radiance with the place of each pixel, for GDAL",
    .write =
        [](PartFile& file, const FormatInput& input) {
          write_part(file, virtual_raster(input.record, beside(file, kVirtualEnding, "radiance"),
                                          beside(file, kVirtualEnding, quantities::kLocation.name)));
        },
    .suits = is_picture,
    .needs = &quantities::kLocation};

}  // namespace ifov::io
