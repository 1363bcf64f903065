#include "io/product_parts/map_info.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/error.h"
#include "io/raster/gdal_reference.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {
namespace {

bool is_local(const render::ImageInfo& info) {
  return info.map_projection.empty() || info.map_projection == "Arbitrary";
}

ReferenceHandle reference(const render::ImageInfo& info) {
  const QuietGdal quiet;
  ReferenceHandle result(late::OSRNewSpatialReference(nullptr));
  const std::string& text = info.map_projection;
  char* wkt = const_cast<char*>(text.c_str());
  const bool known = text.starts_with("EPSG:")
                         ? late::OSRImportFromEPSG(result.get(), std::atoi(text.c_str() + 5)) == OGRERR_NONE
                         : late::OSRImportFromWkt(result.get(), &wkt) == OGRERR_NONE;
  if (!known)
    throw InputError(format(
        "the map projection \"{}\" is not known; expected \"Arbitrary\", an EPSG code or well-known text",
        text));
  return result;
}

std::string text_of(const render::ImageInfo& info, const char* form) {
  if (is_local(info)) return {};
  char* text = nullptr;
  const char* const options[] = {form, nullptr};
  late::OSRExportToWktEx(reference(info).get(), &text, options);
  std::string result = text == nullptr ? "" : text;
  late::VSIFree(text);
  return result;
}

}  // namespace

std::array<double, 6> geotransform(const render::ImageInfo& info) {
  const double c = info.gsd_m * std::cos(info.map_rotation_rad),
               s = info.gsd_m * std::sin(info.map_rotation_rad);
  return {info.map_x_m, c, -s, info.map_y_m, -s, -c};
}

std::string coordinate_system_text(const render::ImageInfo& info) {
  return text_of(info, "FORMAT=WKT1_GDAL");
}
std::string wkt2_text(const render::ImageInfo& info) { return text_of(info, "FORMAT=WKT2_2019"); }
std::string esri_coordinate_system_text(const render::ImageInfo& info) {
  return text_of(info, "FORMAT=WKT1_ESRI");
}

MapSystem map_system(const render::ImageInfo& info) {
  const ReferenceHandle system = reference(info);
  const char* const code = late::OSRGetAuthorityCode(system.get(), nullptr);
  const char* const name = late::OSRGetName(system.get());
  return {name != nullptr ? name : "", coordinate_system_text(info), code != nullptr ? std::atoi(code) : 0};
}

std::vector<std::string> envi_map_info(const render::ImageInfo& info) {
  std::vector<std::string> items{"Arbitrary",
                                 "1",
                                 "1",
                                 format("{:.6f}", info.map_x_m),
                                 format("{:.6f}", info.map_y_m),
                                 format("{:.10g}", info.gsd_m),
                                 format("{:.10g}", info.gsd_m)};
  if (!is_local(info)) {
    const ReferenceHandle system = reference(info);
    int north = 1;
    if (const int zone = late::OSRGetUTMZone(system.get(), &north); zone != 0) {
      items[0] = "UTM";
      items.insert(items.end(), {format("{}", zone), north != 0 ? "North" : "South"});
    } else if (const char* name = late::OSRGetAttrValue(system.get(), "PROJECTION", 0)) {
      items[0] = name;
    }
    if (const char* datum = late::OSRGetAttrValue(system.get(), "DATUM", 0))
      items.push_back(std::string(datum) == "WGS_1984" ? "WGS-84" : datum);
  }
  items.push_back("units=Meters");
  if (info.map_rotation_rad != 0.0)
    // ENVI turns the image counter-clockwise, as GDAL's reader shows.
    items.push_back(format("rotation={:.10g}", -info.map_rotation_rad * 180.0 / std::numbers::pi));
  return items;
}

}  // namespace ifov::io
