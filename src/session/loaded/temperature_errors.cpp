#include "session/loaded/temperature_errors.h"

#include <cmath>

#include "core/format.h"

namespace ifov::session {

double TemperatureErrors::half_width_k() const { return 2.0 * std::hypot(rms_k, step_k); }

std::string TemperatureErrors::statement() const {
  return format(
      "solved temperatures: at {} points that the camera sees, each solved in full by itself, off by {:.2f} K "
      "(root mean square), {:.2f} K at worst, {:+.3f} K on average; steps of time {:.3f} K",
      points, rms_k, worst_k, bias_k, step_k);
}

}  // namespace ifov::session
