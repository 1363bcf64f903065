#include "io/product_parts/netcdf_map.h"

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/product_parts/map_info.h"
#include "io/product_parts/netcdf_functions.h"
#include "io/raster/gdal_reference.h"

namespace ifov::io {
namespace {

void require(int status) {
  if (status != NC_NOERR)
    throw SystemError(format("the place on the map cannot be written: {}", late::nc_strerror(status)));
}

void text(int file, int variable, const char* name, const std::string& value) {
  require(late::nc_put_att_text(file, variable, name, value.size(), value.c_str()));
}

int coordinate(int file, const char* name, int dimension, const char* standard_name) {
  int id = 0;
  require(late::nc_def_var(file, name, NC_DOUBLE, 1, &dimension, &id));
  text(file, id, "standard_name", standard_name);
  text(file, id, "units", "m");
  return id;
}

/// What CF has names of its own for; other systems are in the well-known text alone.
void put_parameters(int file, int variable, const std::string& wkt) {
  const ReferenceHandle system(late::OSRNewSpatialReference(wkt.c_str()));
  const char* const projection = system ? late::OSRGetAttrValue(system.get(), "PROJECTION", 0) : nullptr;
  if (projection == nullptr || std::string(projection) != SRS_PT_TRANSVERSE_MERCATOR) return;
  text(file, variable, "grid_mapping_name", "transverse_mercator");
  const auto parameter = [&](const char* name, double otherwise) {
    return late::OSRGetNormProjParm(system.get(), name, otherwise, nullptr);
  };
  const std::pair<const char*, double> parameters[] = {
      {"latitude_of_projection_origin", parameter(SRS_PP_LATITUDE_OF_ORIGIN, 0.0)},
      {"longitude_of_central_meridian", parameter(SRS_PP_CENTRAL_MERIDIAN, 0.0)},
      {"scale_factor_at_central_meridian", parameter(SRS_PP_SCALE_FACTOR, 1.0)},
      {"false_easting", parameter(SRS_PP_FALSE_EASTING, 0.0)},
      {"false_northing", parameter(SRS_PP_FALSE_NORTHING, 0.0)},
      {"semi_major_axis", late::OSRGetSemiMajor(system.get(), nullptr)},
      {"inverse_flattening", late::OSRGetInvFlattening(system.get(), nullptr)}};
  for (const auto& [name, value] : parameters)
    require(late::nc_put_att_double(file, variable, name, NC_DOUBLE, 1, &value));
}

}  // namespace

NetcdfMap NetcdfMap::define(int file, int y_dimension, int x_dimension, const render::ImageInfo& info) {
  NetcdfMap map;
  if (info.map_rotation_rad == 0.0) {
    map.y_ = coordinate(file, "y", y_dimension, "projection_y_coordinate");
    map.x_ = coordinate(file, "x", x_dimension, "projection_x_coordinate");
  }
  const std::string wkt = coordinate_system_text(info);
  if (wkt.empty()) return map;
  require(late::nc_def_var(file, kName, NC_INT, 0, nullptr, &map.system_));
  put_parameters(file, map.system_, wkt);
  text(file, map.system_, "crs_wkt", wkt);
  text(file, map.system_, "spatial_ref", wkt);
  std::string transform;
  for (const double value : geotransform(info))
    transform += format("{}{:.17g}", transform.empty() ? "" : " ", value);
  text(file, map.system_, "GeoTransform", transform);
  return map;
}

void NetcdfMap::write(int file, const render::ImageInfo& info) const {
  if (system_ >= 0) {
    const int nothing = 0;
    require(late::nc_put_var_int(file, system_, &nothing));
  }
  if (x_ < 0) return;
  std::vector<double> x, y;
  for (int k = 0; k < info.width_px; ++k) x.push_back(info.map_x_m + (k + 0.5) * info.gsd_m);
  for (int k = 0; k < info.height_px; ++k) y.push_back(info.map_y_m - (k + 0.5) * info.gsd_m);
  require(late::nc_put_var_double(file, x_, x.data()));
  require(late::nc_put_var_double(file, y_, y.data()));
}

}  // namespace ifov::io
