#include <cmath>
#include <cstdio>
#include <vector>

#include "figure_data.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/detector_signal.h"
#include "sensor/detector/one_over_f.h"

namespace ifov::figures {
namespace {

struct Spread {
  double mean = 0.0, variance = 0.0;
};

/// Of the counts of many lines of one radiance, by elements of their own.
Spread spread_of_counts(const sensor::Detector& detector, double radiance) {
  constexpr int kLines = 64, kColumns = 512;
  const sensor::DetectorSignal signal(detector, 1, 0, kColumns);
  const std::vector<float> line(kColumns, static_cast<float>(radiance));
  std::vector<double> electrons(kColumns);
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < kLines; ++y) {
    signal.draw(y, line, {}, electrons);
    for (const double e : electrons) {
      const double count = detector.count(e) - detector.offset;
      sum += count;
      squares += count * count;
    }
  }
  const double mean = sum / (kLines * kColumns);
  return {mean, squares / (kLines * kColumns) - mean * mean};
}

}  // namespace

void print_photon_transfer() {
  sensor::Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.read_noise = 12.0;
  detector.full_well = 60000.0;
  detector.gain = 4.0;
  detector.offset = 200.0;
  detector.bits = 14.0;
  for (const double prnu : {0.0, 0.01}) {
    detector.prnu = prnu;
    for (int k = 0; k <= 50; ++k) {
      const double electrons = std::pow(10.0, 1.0 + k * 0.08);
      const Spread found = spread_of_counts(detector, electrons);
      std::printf("transfer %g %.4f %.5f\n", prnu, found.mean, found.variance);
    }
  }
  constexpr int kLines = 400, kColumns = 3;
  detector.one_over_f = 0.1;
  const std::vector<float> drift = sensor::one_over_f_noise(detector, 3, 0, kLines, kColumns, 1);
  for (int y = 0; y < kLines; ++y)
    std::printf("drift %d %.3f %.3f %.3f\n", y, drift[kColumns * y], drift[kColumns * y + 1],
                drift[kColumns * y + 2]);
}

}  // namespace ifov::figures
