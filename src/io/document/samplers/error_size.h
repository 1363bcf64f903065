#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace ifov::io {

struct Dimension;
template <class V>
struct SchemaType;

/// A size of error or difference, in the unit the user thinks in.
struct ErrorSize {
  enum class Unit {
    kelvin,        ///< brightness temperature of a channel
    radiance,      ///< W m-2 sr-1 um-1
    fraction,      ///< of the pixel's own value (1 % is 0.01)
    reflectance,   ///< apparent reflectance
    noise,         ///< the noise that each channel of the sensor declares
    polarization,  ///< degree of linear polarization (0.5 % DoLP is 0.005)
  };
  double value = 0.0;  ///< above zero
  Unit unit = Unit::fraction;
  SourcePosition position{};
};

/// "0.1 K"
std::string text_of(const ErrorSize& error);

/// A size whose unit says what is meant, of these.
struct ErrorUnit {
  ErrorSize::Unit unit;
  const Dimension* dimension;
};
SchemaType<ErrorSize> error_size_type(const std::vector<ErrorUnit>& allowed);

}  // namespace ifov::io
