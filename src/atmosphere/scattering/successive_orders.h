#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/column_phase.h"
#include "atmosphere/scattering/mode_operator.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

/// Radiance I of mode 0 at the quadrature nodes, the sunbeam itself and light straight from the ground left
/// out.
struct NodeRadiance {
  std::vector<double> up, down;  ///< [node][level]
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
    /// What comes down on the ground, scattered: [component][node].
    std::vector<double> ground_down;
    int orders = 0;
    void take(const ModeOperator& step, ModeField field);
  };
  /// Light of a sunbeam of irradiance 1 across itself. `reference` is the peak of mode 0's moments, 0 for
  /// mode 0.
  Mode sunlit(int mode, double reference) const;
  /// Light of a ground of radiance 1 in every direction, not polarized (mode 0). The moments include light
  /// that has not been scattered.
  Mode groundlit() const;
  /// Light of a ground whose radiance is `light` in the directions of `out` (GroundModes::out). The moments include light
  /// that has not been scattered. `reference` as of sunlit().
  Mode groundlit(int mode, const GaussNodes& out, std::span<const double> light, double reference) const;
  /// Light that the column itself emits, not polarized (mode 0): at the boundaries of sublayers Planck's radiance is `planck`,
  /// between them linear, and what is not scattered is absorbed. Moments as of groundlit(); `radiance` is what is scattered.
  Mode emitted(std::span<const double> planck) const;

 private:
  bool is_thick() const;
  Mode add_orders(const ModeOperator& step, ModeField field, ModeMoments sum, double reference) const;
  /// Where orders would be too many, or grow.
  Mode all_at_once(const ModeOperator& step, const ModeField& field, const ModeMoments& sum) const;

  const ScatteringColumn& column_;
  const ColumnPhase& phase_;
  const GaussNodes& nodes_;
  ScatteringOptions options_;
  NodeSteps steps_;
};

}  // namespace ifov::atmosphere
