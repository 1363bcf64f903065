#include "sensor/detector/blooming.h"

#include <algorithm>
#include <vector>

namespace ifov::sensor {

void run_over(std::span<double> electrons, std::size_t first, std::size_t stride, std::size_t count,
              double well, double share) {
  std::vector<double> over(count, 0.0);
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) {
    double& held = electrons[first + k * stride];
    if (!(held > well)) continue;
    over[k] = 0.5 * share * (held - well);
    held = well;
    any = true;
  }
  if (!any) return;
  double carried = 0.0;
  const auto pass = [&](std::size_t k) {
    double& held = electrons[first + k * stride];
    if (held < well) {  // not of what is no number
      const double taken = std::min(carried, well - held);
      held += taken, carried -= taken;
    }
    carried += over[k];
  };
  for (std::size_t k = 0; k < count; ++k) pass(k);
  carried = 0.0;
  for (std::size_t k = count; k-- > 0;) pass(k);
}

}  // namespace ifov::sensor
