#include "session/loaded/temperature_errors.h"

#include <cmath>

#include "core/format.h"

namespace ifov::session {

double TemperatureErrors::OfMaterial::half_width_k() const { return 2.0 * std::hypot(rms_k, step_k); }

double TemperatureErrors::half_width_k() const { return OfMaterial{rms_k, step_k}.half_width_k(); }

std::string TemperatureErrors::statement() const {
  return format(
      "solved temperatures: at {} points that the camera sees, each solved in full by itself{}, off by {:.2f} K "
      "(root mean square, of '{}', the material that is off most), {:.2f} K at worst, {:+.3f} K on average; steps of time {:.3f} K; what "
      "hides the sky counts as level ground at the air's temperature",
      points, made_up > 0 ? format(", and {} more of materials that it hardly sees", made_up) : "", rms_k,
      material, worst_k, bias_k, step_k);
}

}  // namespace ifov::session
