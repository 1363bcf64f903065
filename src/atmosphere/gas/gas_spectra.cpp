#include "atmosphere/gas/gas_spectra.h"

#include <algorithm>

namespace ifov::atmosphere {

BinPoints points_in(const std::vector<double>& wavenumber_cm1, double from_cm1, double to_cm1) {
  const auto begin = wavenumber_cm1.begin(), end = wavenumber_cm1.end();
  // The points next to the edges stand for a part of the bin, too.
  auto first = std::upper_bound(begin, end, from_cm1), last = std::lower_bound(begin, end, to_cm1);
  if (first != begin) --first;
  if (last != end) ++last;
  BinPoints points{static_cast<std::size_t>(first - begin), {}};
  double sum = 0.0;
  for (auto at = first; at != last; ++at) {
    const double low = at == begin ? *at : 0.5 * (*std::prev(at) + *at),
                 high = std::next(at) == end ? *at : 0.5 * (*at + *std::next(at));
    points.share.push_back(std::max(0.0, std::min(high, to_cm1) - std::max(low, from_cm1)));
    sum += points.share.back();
  }
  for (double& share : points.share) share /= sum;
  return points;
}

}  // namespace ifov::atmosphere
