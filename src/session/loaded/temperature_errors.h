#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ifov::session {

/// What solved temperatures may be off by, beside what rays into the past do not tell: measured at points that the camera
/// sees, and at some made up of materials that it hardly sees, each solved in full by itself against what its class makes of
/// the same exposure. Kelvins.
struct TemperatureErrors {
  struct OfMaterial {
    double rms_k = 0.0, step_k = 0.0;
    double half_width_k() const;
  };
  int points = 0, made_up = 0;
  double rms_k = 0.0, bias_k = 0.0;  ///< root mean square and mean, of the material that is off most
  std::string material;              ///< its name
  double worst_k = 0.0;
  double step_k = 0.0;  ///< of the steps of time, by those of twice the length
  std::string weather;  ///< by which they are solved, and what stood in for what it does not tell

  std::map<std::uint32_t, OfMaterial> by_material{};  ///< by its number; the same without the maxima

  /// Half-width of about 95 %: twice the root of the sum of squares. Of an image it is that of the material that is off most, as a
  /// pixel may see any.
  double half_width_k() const;
  std::string statement() const;
};

}  // namespace ifov::session
