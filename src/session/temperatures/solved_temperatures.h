#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::atmosphere {
class WeatherSeries;
}
namespace ifov::geometry {
struct SurfacePoint;
}
namespace ifov::io {
struct Document;
}
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

struct Parts;

/// What solved temperatures may be off by, beside what rays into the past do not tell: measured at points that the camera
/// sees, each solved in full by itself against what its class makes of the same exposure. Kelvins.
struct TemperatureErrors {
  int points = 0;
  double bias_k = 0.0, rms_k = 0.0, worst_k = 0.0;
  double step_k = 0.0;  ///< of the steps of time, by those of twice the length
  std::string weather;  ///< by which they are solved, and what stood in for what it does not tell

  /// Half-width of about 95 %: twice the root of the sum of squares.
  double half_width_k() const;
  std::string statement() const;
};

/// Solves for the temperature of every material whose document asks for it (`"temperature": "solved"`) under its weather,
/// and gives it to the scene; then measures what that may be off by at some of `seen`. Nothing where nobody asks. InputError,
/// located: what is missing (a time, weather, a place, what a material stands on). `weather` may be null.
std::optional<TemperatureErrors> solve_temperatures(const io::Document& document,
                                                    const atmosphere::WeatherSeries* weather,
                                                    const std::vector<geometry::SurfacePoint>& seen,
                                                    scene::Scene& scene, int threads, LogSink* log);

/// Puts what solved temperatures may be off by into the half-widths of the channels. InputError where an accuracy in kelvins is
/// asked for that is finer than that.
void count_temperature_errors(Parts& parts);

}  // namespace ifov::session
