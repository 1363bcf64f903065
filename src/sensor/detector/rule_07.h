#pragma once

namespace ifov::sensor {

/// Density of the dark current of HgCdTe photodiodes, A m-2, by the wavelength at which their response ends and their temperature:
/// "Rule 07" of Tennant, Lee, Zandian, Piquette and Carmody (2008): MBE HgCdTe technology: a very general solution to IR detection,
/// described by "Rule 07", a very convenient heuristic, Journal of Electronic Materials 37, 1406-1410.
double rule_07_a_m2(double cutoff_um, double temperature_k);

}  // namespace ifov::sensor
