#pragma once

#include <cstddef>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/phase_expansion.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/scattering_options.h"

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

/// Radiance I of mode 0 at the quadrature nodes, the sunbeam itself and light straight from the ground left
/// out.
struct NodeRadiance {
  std::vector<double> up, down;  ///< [node][level]
};

/// Phase matrices of the column's layers, expanded, times half their single-scattering albedo and delta-M
/// scaled.
struct ColumnPhase {
  int terms = 0;  ///< coefficients that are not zero everywhere
  std::size_t sublayers = 0;
  std::vector<double> beta, alpha, zeta, gamma;  ///< [l][sublayer]
  ColumnPhase(const ScatteringColumn& column, const AerosolProjection& aerosol, int most_terms);
  const double* at(const std::vector<double>& table, int l) const { return table.data() + l * sublayers; }
};

/// Successive orders of scattering (Deuze, Herman and Santer 1989; Lenoble et al. 2007) over black ground,
/// one azimuthal mode at a time. Within a sublayer the source of each order is linear in optical depth; the
/// first order of the sunbeam is integrated exactly.
class SuccessiveOrders {
 public:
  SuccessiveOrders(const ScatteringColumn& column, const ColumnPhase& phase, const GaussNodes& nodes,
                   const ScatteringOptions& options);

  struct Mode {
    ModeMoments moments;  ///< of all orders, the first included
    NodeRadiance radiance;
    int orders = 0;
  };
  /// Light of a sunbeam of irradiance 1 across itself. `reference` is the peak of mode 0's moments, 0 for
  /// mode 0.
  Mode sunlit(int mode, double reference) const;
  /// Light of a ground of radiance 1 in every direction, not polarized (mode 0). The moments include light
  /// that has not been scattered.
  Mode groundlit() const;

 private:
  struct Field;
  struct Kernel;
  Mode add_orders(const Kernel& kernel, Field field, ModeMoments moments, double reference) const;

  const ScatteringColumn& column_;
  const ColumnPhase& phase_;
  const GaussNodes& nodes_;
  ScatteringOptions options_;
  std::vector<double> transmission_, near_, far_;  ///< [node][sublayer]
};

/// Integral over a path of optical depth `depth` from its near to its far end of exp(-t - beam depth at t)
/// dt, the beam's depth being linear from `near_beam` to `far_beam`.
double beam_integral(double depth, double near_beam, double far_beam);

}  // namespace ifov::atmosphere
