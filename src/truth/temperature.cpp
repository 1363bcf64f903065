#include "truth/temperature.h"

#include <cmath>
#include <limits>

namespace ifov::truth {
namespace {

constexpr int kDraws = 16;

void collect_temperatures(const MiddleRays& rays, std::span<float> values) {
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    values[2 * k] = values[2 * k + 1] = std::numeric_limits<float>::quiet_NaN();
    if (!rays.hits[k].hit()) continue;
    double sum_k = 0.0, variance_k2 = 0.0, warm = 0.0;
    const int draws = rays.scene.solved.empty() ? 1 : kDraws;
    for (int draw = 0; draw < draws; ++draw)
      for (const scene::Constituent& part :
           rays.scene.resolve(rays.hits[k], static_cast<std::uint64_t>(draw))) {
        const double kelvin = part.mapped_temperature_k > 0.0 ? part.mapped_temperature_k
                                                              : rays.scene.states[part.state].temperature_k;
        if (!(kelvin > 0.0)) continue;
        const double weight = part.weight / draws;
        sum_k += weight * kelvin;
        variance_k2 += weight * part.deviation_k * part.deviation_k / draws;
        warm += weight;
      }
    if (!(warm > 0.0)) continue;
    values[2 * k] = static_cast<float>(sum_k / warm);
    values[2 * k + 1] = static_cast<float>(std::sqrt(variance_k2 / warm));
  }
}

}  // namespace

constinit const Collector kTemperature{"temperature", 2, collect_temperatures};

}  // namespace ifov::truth
