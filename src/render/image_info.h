#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/tolerance/atmosphere_half_width.h"

namespace ifov::sensor {
class BrightnessScale;
class ColumnResponses;
struct Mosaic;
struct Detector;
struct ViewList;
}  // namespace ifov::sensor

namespace ifov::render {

/// Name, centre and width of an output channel.
struct ChannelInfo {
  std::string name;
  double centre_um = 0.0, fwhm_um = 0.0;
  std::optional<AtmosphereHalfWidth> air = {};  ///< where the atmosphere knows its error
  double noise = 0.0;  ///< standard deviation of the sensor's noise as a radiance; 0: none is told
  std::shared_ptr<const sensor::Detector> detector = {};  ///< of which that is the noise; null: none
  double irradiance = 0.0;      ///< by Sun and sky on a level surface, of single views; 0: none is told
  double toa_irradiance = 0.0;  ///< by the Sun alone on a level surface above the air; 0: none is told
  std::shared_ptr<const sensor::BrightnessScale> brightness = {};  ///< null: the response is not known
  std::vector<double> toa_of_carried = {};  ///< of each of ImageInfo::responses; empty: as above
  double lag = 0.0, inertia = 0.0;          ///< shares of sensor::SignalMemory
};

/// What every product says of itself.
struct ImageInfo {
  int width_px = 0, height_px = 0;
  std::vector<ChannelInfo> channels;
  std::shared_ptr<const sensor::ColumnResponses> responses;  ///< by column; null: alike in all
  std::vector<std::vector<double>> keystone_px;  ///< to the right, by channel and column; empty: nowhere
  std::shared_ptr<const sensor::Mosaic> mosaic;  ///< null: each element sees all channels
  std::vector<std::string> materials;            ///< names by material index, for abundances
  std::vector<std::string> objects;              ///< names of the document's, for classes; empty: not known
  std::vector<std::uint32_t> first_of_objects;   ///< number in the world of the first that stands for each
  std::string radiance_unit = "W m-2 sr-1 um-1";
  bool stokes = false, has_map = false;  ///< Q, U and V beside I; where it lies on a map
  bool solved = false;                   ///< some temperatures of the scene are
  double map_x_m = 0.0, map_y_m = 0.0, gsd_m = 0.0;
  double map_rotation_rad = 0.0;  ///< azimuth of the upward direction of the image, clockwise from north
  std::string map_projection;     ///< "Arbitrary" for a local ENU frame, else well-known text
  std::shared_ptr<const sensor::ViewList> views;  ///< null: the pixels are those of a picture
  int sweep_lines = 0;  ///< of a sweep, of a flying rolling shutter 1: tiles keep them apart; 0: one picture
  double footprint_px = 1.0;  ///< sampling::response_area_px(): pixels that share what one of them sees
};

/// What intervals hold of a modelled atmosphere's error.
enum class AirInIntervals { none, numbers, numbers_and_model };
AirInIntervals air_in_intervals(const ImageInfo& image);
/// As what_intervals_hold() says it.
AirInIntervals air_in_intervals(const std::string& sentence);
/// A sentence without its full stop; empty: none.
std::string what_intervals_hold(const ImageInfo& image);

}  // namespace ifov::render
