#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ifov::io {

/// One band of an instrument, as its makers or their agencies publish it.
struct PresetBand {
  std::string name;
  bool is_bell =
      false;  ///< `a_um`, `b_um` are centre and full width at half maximum; else where a rectangle begins and ends
  double a_um = 0.0, b_um = 0.0;
  double snr = 0.0, at_w_m2_sr_um = 0.0;  ///< at a radiance; 0: not told so
  double nedt_k = 0.0, at_k = 0.0;        ///< at a temperature; 0: not told so
  double efficiency = 0.0;                ///< electrons per photon at the peak; 0: not told

  /// The temperature at which documents tell NEdT.
  static constexpr double kUsual_k = 300.0;
  /// NEdT as a radiance.
  double nedl_w_m2_sr_um() const;
};

/// Bells with centres at equal distances, as a document's series.
struct PresetSeries {
  double from_um = 0.0, to_um = 0.0, fwhm_um = 0.0;
  int count = 0;
};

/// An instrument. What it has beside its channels is JSON, as documents write it; empty where it is not told.
struct SensorPreset {
  std::string name, about;
  std::string ground;             ///< size of its pixels on the ground, or its kind, in words
  std::vector<std::string> also;  ///< other names that it is found by
  std::vector<std::string> sources;
  std::vector<PresetBand> bands;
  std::vector<PresetSeries> series;
  std::vector<std::pair<double, double>>
      noise;  ///< of series: um and W m-2 sr-1 um-1, straight lines between
  std::string optics, detector, mosaic;
  std::string camera, platform;  ///< suggestions

  int channel_count() const;
  std::pair<double, double> range_um() const;  ///< between the outermost half-maxima
  std::string noise_text() const;              ///< what is told of it in a word or two; empty: nothing
};

/// Tables in the format of data/sensors (docs/formats/data.md). Throws InputError, with table and line, where one is not well formed.
std::vector<SensorPreset> parse_sensor_presets(const std::string& table, std::string_view text);

/// All, in the order of their tables.
std::span<const SensorPreset> sensor_presets();
/// By its name or another that it has, letters compared without case; an InputError names near misses.
const SensorPreset& sensor_preset(std::string_view name);

/// A document of it over the shore of a lake, for a user to change; a line of JSON for each channel.
std::string preset_text(const SensorPreset& preset);

}  // namespace ifov::io
