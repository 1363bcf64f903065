#pragma once

#include <cstddef>
#include <vector>

namespace ifov::atmosphere {

/// One azimuthal mode of a field of light, as its moments over direction: for component c of (I, Q, U) and
/// l = mode .. terms - 1, at every boundary of sublayers, what the phase matrix needs to scatter it once
/// more.
struct ModeMoments {
  int mode = 0, terms = 0, components = 3;
  std::size_t levels = 0;
  std::vector<double> values;  ///< [l - mode][component][level]
  double* at(int l, int component) { return values.data() + ((l - mode) * components + component) * levels; }
  const double* at(int l, int component) const {
    return values.data() + ((l - mode) * components + component) * levels;
  }
  double peak() const;
};

}  // namespace ifov::atmosphere
