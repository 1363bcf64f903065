#include "io/document/schema/quantity.h"

#include <charconv>
#include <cmath>

#include "core/format.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr bool kAlias = false;

constexpr Unit kLengthUnits[] = {
    {"m"},
    {"km", 1e3},
    {"cm", 1e-2},
    {"mm", 1e-3},
    {"um", 1e-6},
    {"nm", 1e-9},
    {"ft", 0.3048},
    {"in", 0.0254},
    {"\u00B5m", 1e-6, 0.0, kAlias},
    {"\u03BCm", 1e-6, 0.0, kAlias},
};
constexpr Unit kWavelengthUnits[] = {
    {"um"},
    {"nm", 1e-3},
    {"\u00B5m", 1.0, 0.0, kAlias},
    {"\u03BCm", 1.0, 0.0, kAlias},
};
constexpr Unit kAngleUnits[] = {
    {"deg", math::kDegree},
    {"rad"},
    {"mrad", 1e-3},
    {"\u00B0", math::kDegree, 0.0, kAlias},
};
constexpr Unit kTemperatureUnits[] = {
    {"K"},
    {"degC", 1.0, 273.15},
    {"degF", 5.0 / 9.0, 273.15 - 32.0 * 5.0 / 9.0},
    {"\u00B0C", 1.0, 273.15, kAlias},
};
constexpr Unit kTemperatureDifferenceUnits[] = {{"K"}, {"mK", 1e-3}};
constexpr Unit kSunDistanceUnits[] = {{"au"}, {"AU", 1.0, 0.0, kAlias}};
constexpr Unit kPixelUnits[] = {{"px"}, {"pixel", 1.0, 0.0, kAlias}, {"pixels", 1.0, 0.0, kAlias}};
constexpr Unit kPercentUnits[] = {{"%", 1e-2}};
constexpr Unit kPowerUnits[] = {{"W"}, {"kW", 1e3}, {"mW", 1e-3}};
constexpr Unit kLuminousFluxUnits[] = {{"lm"}, {"klm", 1e3}};
constexpr Unit kTurnRateUnits[] = {{"rad/s"},
                                   {"mrad/s", 1e-3},
                                   {"deg/s", math::kDegree},
                                   {"rad s-1", 1.0, 0.0, kAlias},
                                   {"deg s-1", math::kDegree, 0.0, kAlias}};
constexpr Unit kSpeedUnits[] = {{"m/s"},
                                {"m s-1", 1.0, 0.0, kAlias},
                                {"km/s", 1e3, 0.0, kAlias},
                                {"km/h", 1.0 / 3.6},
                                {"kn", 1852.0 / 3600.0}};
constexpr Unit kReflectanceUnits[] = {{"reflectance"}};
constexpr Unit kNoiseUnits[] = {{"noise"}};
constexpr Unit kDegreeOfPolarizationUnits[] = {{"% DoLP", 1e-2}};
constexpr Unit kRadianceUnits[] = {
    {"W m-2 sr-1 um-1"},
    {"W m-2 sr-1 nm-1", 1e3},
    {"mW m-2 sr-1 nm-1"},
    {"uW cm-2 sr-1 nm-1", 10.0},
    {"W/m2/sr/um", 1.0, 0.0, kAlias},
    {"W/m^2/sr/um", 1.0, 0.0, kAlias},
    {"W/(m2 sr um)", 1.0, 0.0, kAlias},
    {"W/(m^2 sr um)", 1.0, 0.0, kAlias},
    {"W m^-2 sr^-1 um^-1", 1.0, 0.0, kAlias},
    {"W/m2/sr/nm", 1e3, 0.0, kAlias},
};
constexpr Unit kDensityUnits[] = {
    {"m-2"},
    {"ha-1", 1e-4},
    {"km-2", 1e-6},
    {"m^-2", 1.0, 0.0, kAlias},
    {"per m2", 1.0, 0.0, kAlias},
    {"per ha", 1e-4, 0.0, kAlias},
    {"per km2", 1e-6, 0.0, kAlias},
    {"/m2", 1.0, 0.0, kAlias},
    {"/ha", 1e-4, 0.0, kAlias},
    {"/km2", 1e-6, 0.0, kAlias},
};
constexpr Unit kIrradianceUnits[] = {
    {"W m-2 um-1"},
    {"W m-2 nm-1", 1e3},
    {"mW m-2 nm-1"},
    {"W/m2/um", 1.0, 0.0, kAlias},
    {"W/m^2/um", 1.0, 0.0, kAlias},
    {"W/(m2 um)", 1.0, 0.0, kAlias},
    {"W m^-2 um^-1", 1.0, 0.0, kAlias},
    {"W/m2/nm", 1e3, 0.0, kAlias},
};
constexpr Unit kPressureUnits[] = {
    {"hPa"}, {"Pa", 1e-2}, {"kPa", 10.0}, {"mbar", 1.0, 0.0, kAlias}, {"mb", 1.0, 0.0, kAlias}};
constexpr Unit kWaterColumnUnits[] = {
    {"g/cm2"},
    {"kg/m2", 0.1},
    {"mm", 0.1},
    {"cm"},
    {"g cm-2", 1.0, 0.0, kAlias},
    {"kg m-2", 0.1, 0.0, kAlias},
    {"g/cm^2", 1.0, 0.0, kAlias},
};
constexpr Unit kCloudWaterUnits[] = {
    {"g/m2"},
    {"kg/m2", 1e3},
    {"g m-2", 1.0, 0.0, kAlias},
    {"kg m-2", 1e3, 0.0, kAlias},
    {"g/m^2", 1.0, 0.0, kAlias},
};
constexpr Unit kOzoneColumnUnits[] = {{"DU"}, {"atm-cm", 1e3}};
constexpr Unit kGasColumnUnits[] = {{"atm-cm"}, {"DU", 1e-3}, {"molecules/cm2", 1.0 / 2.6868e19}};
constexpr Unit kMixingRatioUnits[] = {{"g/kg"}, {"g kg-1", 1.0, 0.0, kAlias}};
constexpr Unit kMixingRatioByVolumeUnits[] = {{"ppm"}, {"ppb", 1e-3}, {"ppmv", 1.0, 0.0, kAlias}};

constexpr Unit kDurationUnits[] = {{"s"},
                                   {"ms", 1e-3},
                                   {"us", 1e-6},
                                   {"min", 60.0},
                                   {"h", 3600.0},
                                   {"d", 86400.0},
                                   {"\u00B5s", 1e-6, 0.0, kAlias}};
constexpr Unit kFrequencyUnits[] = {{"Hz"}, {"kHz", 1e3}};
constexpr double kElementaryCharge_c = 1.602176634e-19;  // exact
constexpr Unit kElectronsUnits[] = {{"e-"}, {"ke-", 1e3}, {"Me-", 1e6}};
constexpr Unit kDarkCurrentUnits[] = {{"e-/s"},
                                      {"fA", 1e-15 / kElementaryCharge_c},
                                      {"pA", 1e-12 / kElementaryCharge_c},
                                      {"nA", 1e-9 / kElementaryCharge_c},
                                      {"A", 1.0 / kElementaryCharge_c}};
constexpr Unit kGainUnits[] = {{"e-/count"}, {"e-/DN", 1.0, 0.0, kAlias}};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string escaped(std::string_view literal) {
  std::string pattern;
  for (const char c : literal) {
    if (std::string_view("^$.*+?()[]{}|/\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace

const Dimension kLength{"a length", "1 m", kLengthUnits, 1e-9, 1e12};
const Dimension kWavelength{"a wavelength", "0.55 um", kWavelengthUnits, 1e-3, 1e5};
const Dimension kWavelengthDifference{"a difference of wavelengths", "0.5 nm", kWavelengthUnits, 1e-9, 1e3};
const Dimension kAngle{"an angle", "30 deg", kAngleUnits, 1e-12, 1e4};
const Dimension kTemperature{"a temperature", "20 degC", kTemperatureUnits, 0.1, 1e5};
const Dimension kTemperatureDifference{"a temperature difference", "0.1 K", kTemperatureDifferenceUnits, 1e-9,
                                       1e5};
const Dimension kSunDistance{"a distance of the Sun", "1.016 au", kSunDistanceUnits};
const Dimension kPixels{"a number of pixels", "0.6 px", kPixelUnits, 1e-6, 1e6};
const Dimension kPercent{"a percentage", "1 %", kPercentUnits, 1e-12, 1e6};
const Dimension kReflectance{"a reflectance", "0.002 reflectance", kReflectanceUnits, 1e-12, 1e6};
const Dimension kNoise{"a share of the sensor's noise", "0.5 noise", kNoiseUnits, 1e-9, 1e6};
const Dimension kDegreeOfPolarization{"a degree of linear polarization", "0.5 % DoLP",
                                      kDegreeOfPolarizationUnits, 1e-12, 1e3};
const Dimension kRadiance{"a spectral radiance", "12 W m-2 sr-1 um-1", kRadianceUnits};
const Dimension kDensity{"a density", "300 ha-1", kDensityUnits, 1e-15, 1e9};
const Dimension kIrradiance{"a spectral irradiance", "1800 W m-2 um-1", kIrradianceUnits};
const Dimension kPower{"a power", "100 W", kPowerUnits, 1e-12, 1e15};
const Dimension kLuminousFlux{"a luminous flux", "5000 lm", kLuminousFluxUnits, 1e-12, 1e15};
const Dimension kTurnRate{"a rate of turn", "60 deg/s", kTurnRateUnits, 1e-9, 1e6};
const Dimension kSpeed{"a speed", "3 m/s", kSpeedUnits, 1e-9, 1e6};
const Dimension kPressure{"a pressure", "1013 hPa", kPressureUnits, 1e-12, 1e6};
const Dimension kWaterColumn{"a column of water vapour", "2.1 g/cm2", kWaterColumnUnits, 1e-12, 1e6};
const Dimension kCloudWater{"a column of cloud water", "100 g/m2", kCloudWaterUnits, 1e-12, 1e6};
const Dimension kOzoneColumn{"a column of ozone", "320 DU", kOzoneColumnUnits, 1e-12, 1e6};
const Dimension kGasColumn{"a column of a gas", "0.3 atm-cm", kGasColumnUnits, 1e-12, 1e9};
const Dimension kMixingRatio{"a mixing ratio", "8 g/kg", kMixingRatioUnits, 1e-12, 1e6};
const Dimension kMixingRatioByVolume{"a mixing ratio by volume", "420 ppm", kMixingRatioByVolumeUnits, 1e-12,
                                     1e9};

const Dimension kDuration{"a duration", "10 ms", kDurationUnits, 1e-12, 1e12};
const Dimension kFrequency{"a frequency", "50 Hz", kFrequencyUnits, 1e-9, 1e9};
const Dimension kElectrons{"a number of electrons", "20 e-", kElectronsUnits, 1e-6, 1e15};
const Dimension kDarkCurrent{"a dark current", "100 e-/s", kDarkCurrentUnits, 1e-9, 1e20};
const Dimension kGain{"a gain", "16 e-/count", kGainUnits, 1e-6, 1e12};

const Unit* Dimension::find(std::string_view spelling) const {
  for (const Unit& unit : units) {
    if (unit.spelling == spelling) return &unit;
  }
  return nullptr;
}

std::string Dimension::unit_list() const {
  std::string list;
  for (const Unit& unit : units) {
    if (unit.listed) list += format("{}{}", list.empty() ? "" : ", ", unit.spelling);
  }
  return list;
}

std::optional<QuantityText> split_quantity(std::string_view text) {
  text = trimmed(text);
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const std::size_t first = digits.starts_with('-') && digits.size() == text.size() ? 1 : 0;
  const bool begins_number =
      digits.size() > first && (digits[first] == '.' || (digits[first] >= '0' && digits[first] <= '9'));
  if (!begins_number) return std::nullopt;
  QuantityText result;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), result.number);
  if (parsed.ec != std::errc() || !std::isfinite(result.number)) return std::nullopt;
  digits.remove_prefix(static_cast<std::size_t>(parsed.ptr - digits.data()));
  result.unit = trimmed(digits);
  return result;
}

std::string quantity_pattern(const Dimension& dimension, Sign sign) {
  std::string units;
  for (const Unit& unit : dimension.units)
    units += format("{}{}", units.empty() ? "" : "|", escaped(unit.spelling));
  const std::string_view before = sign == Sign::any            ? "[+-]?"
                                  : sign == Sign::not_negative ? "\\+?"
                                                               : "\\+?(?=[0-9.]*[1-9])";
  return format("^[ \\t]*{}([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+-]?[0-9]+)?[ \\t]*({})[ \\t]*$", before,
                units);
}

}  // namespace ifov::io
