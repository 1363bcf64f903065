#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ifov::io {

/// SI (or the unit that the code works in) = number * factor + offset.
struct Unit {
  std::string_view spelling;
  double factor = 1.0;
  double offset = 0.0;
  bool listed = true;  ///< false: another spelling of a unit in the list, accepted but not offered
};

/// A kind of quantity, with the units a document may write it in.
struct Dimension {
  std::string_view name;     ///< with its article: "a length"
  std::string_view example;  ///< "1 m"
  std::span<const Unit> units;
  /// What is further from zero means nothing here, nor what must be above zero and is nearer to it; in the unit that the
  /// comment below names.
  double smallest = 1e-30, largest = 1e30;

  const Unit* find(std::string_view spelling) const;
  std::string unit_list() const;  ///< "m, km, cm": those that are offered
};

extern const Dimension kLength;                 ///< m
extern const Dimension kWavelength;             ///< um
extern const Dimension kWavelengthDifference;   ///< um
extern const Dimension kAngle;                  ///< rad
extern const Dimension kTemperature;            ///< K
extern const Dimension kTemperatureDifference;  ///< K
extern const Dimension kSunDistance;            ///< au
extern const Dimension kPixels;                 ///< px
extern const Dimension kPercent;                ///< fraction of 1
extern const Dimension kReflectance;            ///< fraction of 1
extern const Dimension kNoise;                  ///< of the sensor
extern const Dimension kDegreeOfPolarization;   ///< linear, fraction of 1
extern const Dimension kRadiance;               ///< W m-2 sr-1 um-1
extern const Dimension kDensity;                ///< m-2, of things on the ground
extern const Dimension kIrradiance;             ///< W m-2 um-1
extern const Dimension kPower;                  ///< W
extern const Dimension kLuminousFlux;           ///< lm
extern const Dimension kTurnRate;               ///< rad s-1
extern const Dimension kSpeed;                  ///< m s-1
extern const Dimension kPressure;               ///< hPa
extern const Dimension kWaterColumn;            ///< g cm-2
extern const Dimension kCloudWater;             ///< g m-2
extern const Dimension kOzoneColumn;            ///< DU
extern const Dimension kGasColumn;              ///< atm-cm
extern const Dimension kMixingRatio;            ///< g kg-1
extern const Dimension kMixingRatioByVolume;    ///< ppm
extern const Dimension kDuration;               ///< s
extern const Dimension kFrequency;              ///< Hz
extern const Dimension kElectrons;              ///< electrons of a detector element
extern const Dimension kDarkCurrent;            ///< electrons per second
extern const Dimension kGain;                   ///< electrons a count

/// A number and what follows it, as written.
struct QuantityText {
  double number = 0.0;
  std::string_view unit;
};

/// Splits "12.5 km" at the end of its number; nothing where the text does not begin with a finite number.
/// Spaces around both parts are ignored.
std::optional<QuantityText> split_quantity(std::string_view text);

/// Regular expression (ECMA 262) for the texts of a dimension; `sign` says which numbers it lets through.
enum class Sign { any, not_negative, positive };
std::string quantity_pattern(const Dimension& dimension, Sign sign);

}  // namespace ifov::io
