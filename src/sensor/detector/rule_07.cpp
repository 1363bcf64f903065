#include "sensor/detector/rule_07.h"

#include <cmath>

namespace ifov::sensor {

double rule_07_a_m2(double cutoff_um, double temperature_k) {
  constexpr double kFactor_a_cm2 = 8367.00001853855, kExponent = -1.16239134096245;
  constexpr double kScale_um = 0.200847413564122, kThreshold_um = 4.63513642316149;
  constexpr double kPower = 0.544071281108481;
  constexpr double kMicrometreElectronvolts = 1.24;  // as the paper rounds hc/q
  constexpr double kKelvinPerElectronvolt = 1.602176634e-19 / 1.380649e-23;
  const double effective_um =
      cutoff_um >= kThreshold_um
          ? cutoff_um
          : cutoff_um / (1.0 - std::pow(kScale_um / cutoff_um - kScale_um / kThreshold_um, kPower));
  return 1e4 * kFactor_a_cm2 *
         std::exp(kExponent * kMicrometreElectronvolts * kKelvinPerElectronvolt /
                  (effective_um * temperature_k));
}

}  // namespace ifov::sensor
