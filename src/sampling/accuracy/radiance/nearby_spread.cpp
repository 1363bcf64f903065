#include "sampling/accuracy/radiance/nearby_spread.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/edges/probing.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// So many vertices tell how values of a label differ thereabouts.
constexpr double kTold = 4.0;

}  // namespace

std::vector<float> NearbySpread::deviation(const SourcePixel& pixel, std::uint32_t label) const {
  std::vector<float> deviation;
  if (label == kNoLabel) {
    deviation.assign(static_cast<std::size_t>(field_.columns()), 0.0f);
    widen(pixel, kNoLabel, deviation);
    return deviation;
  }
  if (spread_.constant(label)) return deviation;
  const double count = of_label(pixel, label, deviation);
  // What few have told, or what differs by its nature, may differ as much as all that is about.
  if (count < kTold || field_.uneven(table_.label(label))) widen(pixel, kNoLabel, deviation);
  return deviation;
}

double NearbySpread::of_label(const SourcePixel& pixel, std::uint32_t label,
                              std::vector<float>& deviation) const {
  const std::size_t columns = static_cast<std::size_t>(field_.columns());
  deviation.assign(columns, 0.0f);
  const double count = widen(pixel, label, deviation);
  // A few that agree thereabouts may do so by chance where the label's values elsewhere do not.
  for (std::size_t c = 0; c < columns; ++c) {
    const double near = static_cast<double>(deviation[c]), total = spread_.total(label, static_cast<int>(c));
    deviation[c] = static_cast<float>(std::sqrt((near * near * count + total * kTold) / (count + kTold)));
  }
  return count;
}

/// From the lattice's values of a label, or of all, in the pixel and those around it. Their number.
double NearbySpread::widen(const SourcePixel& pixel, std::uint32_t label,
                           std::vector<float>& deviation) const {
  const bool any_label = label == kNoLabel;
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1, width = lattice_.domain().width();
  const int x = pixel.source % width * k, y = pixel.source / width * k;
  const std::size_t columns = deviation.size();
  std::vector<double> mean(columns, 0.0), squares(columns, 0.0);
  double count = 0.0;
  for (int j = std::max(0, y - k); j <= std::min(lattice_.rows(), y + 2 * k); ++j)
    for (int i = std::max(0, x - k); i <= std::min(lattice_.columns(), x + 2 * k); ++i) {
      const std::size_t v = static_cast<std::size_t>(j) * row + i;
      if (!any_label && values_.labels[v] != label) continue;
      count += 1.0;
      for (std::size_t c = 0; c < columns; ++c) {
        const double difference = values_.value(v)[c] - mean[c];
        mean[c] += difference / count;
        squares[c] += difference * (values_.value(v)[c] - mean[c]);
      }
    }
  const int height = lattice_.domain().height(), column = pixel.source % width, line = pixel.source / width;
  for (int j = std::max(0, line - 1); pixel.cluttered && any_label && j <= std::min(height - 1, line + 1);
       ++j)
    for (int i = std::max(0, column - 1); i <= std::min(width - 1, column + 1); ++i)
      for (const Prober::Met& met : prober_.met(j * width + i)) {
        const double before = count;
        count += met.count;
        for (std::size_t c = 0; c < columns; ++c) {
          const double difference = table_.mean(met.label)[c] - mean[c];
          mean[c] += difference * met.count / count;
          squares[c] += difference * difference * met.count * before / count;
        }
      }
  for (std::size_t c = 0; c < columns; ++c)
    deviation[c] = std::max(deviation[c], static_cast<float>(std::sqrt(squares[c] / std::max(1.0, count))));
  return count;
}

}  // namespace ifov::sampling
