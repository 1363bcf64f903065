#include "session/loaded/temperature_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "sampling/intervals/quantiles.h"

namespace ifov::session {

namespace {

double student(double points) {
  static const double kConfidence = std::erf(std::numbers::sqrt2);
  return sampling::two_sided_student(kConfidence, std::max(points, 1.0));
}

/// Student's t of as many points times their root mean square.
double held_by(int points, double rms_k) { return points > 0 ? student(points) * rms_k : 0.0; }

double with_beside(const TemperatureErrors::OfMaterial& of, double of_beside_k) {
  const double of_all_k = student(of.points) * of.rms_k, of_chosen_k = 2.0 * of.unsettled_k;
  return std::hypot(std::max(of_all_k, of_chosen_k), 2.0 * of.step_k, of_beside_k) + of.ground_k +
         of.other_side_k;
}

}  // namespace

double TemperatureErrors::OfMaterial::half_width_k() const {
  return with_beside(*this, held_by(beside, beside_k));
}

double TemperatureErrors::OfMaterial::whole_half_width_k() const {
  return std::max(half_width_k(), with_beside(*this, held_by(met_beside, met_beside_k)));
}

double TemperatureErrors::half_width_k() const {
  double largest_k = 0.0;
  for (const auto& [number, error] : by_material)
    largest_k = std::max(largest_k, mirrors ? error.whole_half_width_k() : error.half_width_k());
  return largest_k;
}

std::string TemperatureErrors::statement() const {
  return format(
      "solved temperatures: at {} points that the camera sees, each solved in full by itself{}, off by {:.2f} K "
      "(root mean square, of '{}', the material that is off most), {:.2f} K at worst, {:+.3f} K on average{}; steps of time {:.3f} K{}{}{}{}; what is "
      "about them, lit and shaded as it was, {:.2f} K against the same solved in full",
      points, made_up > 0 ? format(", and {} more of materials that it hardly sees", made_up) : "", rms_k,
      material, worst_k, bias_k,
      unsettled > 0
          ? format(
                "; {:.2f} K at its own of {} that the Sun came to and left, or about which things came and went",
                unsettled_k, unsettled)
          : "",
      step_k, points > 0 ? format("; wind of {:.0f} to {:.0f} m above ground", lowest_m, highest_m) : "",
      on_nothing > 0
          ? format(
                "; below {} of them nothing faces up, and the ground beside lies lower: by the wind of their height, up to {:.2f} K",
                on_nothing, ground_k)
          : "",
      free_standing > 0
          ? format(
                "; {} of them are of thin sheets whose other side is outdoors, which is left out: up to {:.2f} K, of '{}' "
                "(\"back\": {{\"other_side\": {{}}}} has it count)",
                free_standing, other_side_k, free_material)
          : "",
      across_k >= 0.005
          ? format(
                "; faces of thin sheets are up to {:.2f} K off the temperature that both are taken to have",
                across_k)
          : "",
      beside_k);
}

}  // namespace ifov::session
