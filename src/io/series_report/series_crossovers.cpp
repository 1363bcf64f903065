#include <algorithm>
#include <cmath>

#include "io/series_report/series_report.h"

namespace ifov::io {
namespace {

/// Those of one pair.
void add_crossovers(const SeriesReport& report, std::size_t a, std::size_t b,
                    std::vector<SeriesReport::Crossover>& found) {
  const std::vector<double>&one = report.told(report.materials[a]).mean_k,
        &other = report.told(report.materials[b]).mean_k;
  // Which was the warmer one when they were last apart (0: never yet), and where the sign last changed since.
  int warmer = 0;
  double crossed_s = 0.0, before_k = 0.0, before_s = 0.0;
  int before = 0;
  for (std::size_t t = 0; t < report.time_s.size(); ++t) {
    const double by_k = one[t] - other[t];
    if (!std::isfinite(by_k)) continue;
    const int sign = by_k > 0.0 ? 1 : by_k < 0.0 ? -1 : before;
    if (before != 0 && sign != before)
      crossed_s = before_s + (report.time_s[t] - before_s) * before_k / (before_k - by_k);
    if (std::abs(by_k) >= kApart_k) {
      if (warmer != 0 && sign != warmer) found.push_back({crossed_s, sign > 0 ? a : b, sign > 0 ? b : a, {}});
      warmer = sign;
    }
    before = sign, before_k = by_k, before_s = report.time_s[t];
  }
}

}  // namespace

std::vector<SeriesReport::Crossover> crossovers_of(const SeriesReport& report) {
  std::vector<SeriesReport::Crossover> found;
  for (std::size_t a = 0; a < report.materials.size(); ++a)
    for (std::size_t b = a + 1; b < report.materials.size(); ++b) add_crossovers(report, a, b, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return found;
}

}  // namespace ifov::io
