#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "io/product_parts/raster_view.h"

namespace ifov::io {

struct Quantity;
struct RunRecord;

/// The mean over all directions, weighed by their cosine: what an area sends back of what falls on it.
struct Albedo {
  double value = 0.0, standard_error = 0.0, half_width = 0.0;
};

/// What a run of single views (sensor::ViewList) found, for its tables: a value by [view * channels + channel].
struct ViewValues {
  std::size_t views = 0, channels = 0;
  std::vector<float> value, half_width, standard_error;  ///< the errors empty where nothing is known of them
  std::vector<float> samples, reasons;                   ///< by view
  std::vector<float> sky_view, sky_view_half_width;      ///< by view, of points; else empty
  bool has_reflectance = false;                          ///< some channel knows what falls on the area
  std::vector<Albedo> albedo;                            ///< by channel, of a hemisphere that has_reflectance

  const char* name = "radiance";  ///< of the value: "irradiance" of points
};

/// Reads a run's cubes. pi over what falls on a level surface, which makes a reflectance factor of a radiance, is
/// 0 where a channel has none.
ViewValues view_values(const RunRecord& record, const std::function<RasterView(const Quantity&)>& values_of);
double reflectance_scale(const RunRecord& record, std::size_t channel);

/// The columns of a comma-separated table, and a line of it for each view and channel.
std::string view_csv(const RunRecord& record, const ViewValues& values);

/// The same as NetCDF by the CF conventions, over (view, channel). SystemError where it cannot be written.
void write_view_netcdf(const std::string& path, const RunRecord& record, const ViewValues& values);

/// "albedo of channel 'red': 0.3000 +- 0.0004", one a channel.
std::vector<std::string> albedo_lines(const RunRecord& record, const ViewValues& values);

}  // namespace ifov::io
