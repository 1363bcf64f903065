#pragma once

#include <span>
#include <string>
#include <string_view>
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

  /// The temperature at which documents tell NEdT.
  static constexpr double kUsual_k = 300.0;
  /// NEdT as a radiance.
  double nedl_w_m2_sr_um() const;
};

/// An instrument.
struct SensorPreset {
  std::string name, about;
  std::vector<std::string> sources;
  std::vector<PresetBand> bands;
};

/// Tables in the format of data/sensors (docs/formats/data.md). Throws InputError, with table and line, where one is not well formed.
std::vector<SensorPreset> parse_sensor_presets(const std::string& table, std::string_view text);

/// All, by name.
std::span<const SensorPreset> sensor_presets();
/// By its name, letters compared without case; an InputError names near misses.
const SensorPreset& sensor_preset(std::string_view name);

/// A document of its channels alone, for a user to change.
std::string preset_text(const SensorPreset& preset);

}  // namespace ifov::io
