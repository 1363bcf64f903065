#pragma once

#include <cstddef>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/column_phase.h"
#include "atmosphere/scattering/mode_moments.h"
#include "atmosphere/scattering/phase/spherical_functions.h"
#include "atmosphere/scattering/scattering_column.h"

namespace ifov::atmosphere {

/// Radiances [component][node][level] of the upward and the downward hemisphere.
struct ModeField {
  ModeField(int components, std::size_t nodes, std::size_t level_count)
      : levels(level_count),
        stride(nodes * level_count),
        up(components * stride, 0.0),
        down(components * stride, 0.0) {}
  std::size_t levels, stride;
  std::vector<double> up, down;
  double* up_at(int component, std::size_t node) { return up.data() + component * stride + node * levels; }
  const double* up_at(int component, std::size_t node) const {
    return up.data() + component * stride + node * levels;
  }
  const double* down_at(int component, std::size_t node) const {
    return down.data() + component * stride + node * levels;
  }
  double* down_at(int component, std::size_t node) {
    return down.data() + component * stride + node * levels;
  }
};

/// How light at each node passes each sublayer whose source is linear in depth: [node][sublayer].
struct NodeSteps {
  std::vector<double> transmission, near, far;
  NodeSteps(const ScatteringColumn& column, const GaussNodes& nodes);
};

/// One azimuthal mode in one column: from a field of light to its moments, from moments to what is scattered,
/// and from that to the field of the next order. Sums over directions and over l use the symmetry of the
/// functions: at -mu, p and r have the sign (-1)^(l + mode), t the other one. Borrows what it is made of.
class ModeOperator {
 public:
  ModeOperator(const ScatteringColumn& column, const ColumnPhase& phase, const GaussNodes& nodes,
               const NodeSteps& steps, int mode, bool polarized);

  int mode() const { return mode_; }
  int components() const { return components_; }  ///< of (I, Q, U); mode 0 has no U
  std::size_t nodes() const { return functions_.size(); }
  std::size_t sublayers() const { return column_.sublayers(); }

  ModeMoments empty_moments() const;
  ModeField empty_field() const { return ModeField(components_, nodes(), sublayers() + 1); }
  ModeMoments moments_of(const ModeField& field) const;
  /// Phase coefficients times moments: [l - mode][component][sublayer], the moments of sublayer s being those
  /// of boundary s + offset.
  std::vector<double> scatter(const ModeMoments& moments, std::size_t offset) const;
  /// Source at a node from scattered moments: [component][sublayer] going up and coming down.
  void expand(std::size_t node, const std::vector<double>& scattered, std::vector<double>& up,
              std::vector<double>& down) const;
  /// Carries light of a node through the sublayers, given what each adds.
  void sweep(std::size_t node, const std::vector<double>& up_gain, const std::vector<double>& down_gain,
             ModeField& field) const;
  /// Field of light scattered once more.
  ModeField next(const ModeMoments& moments) const;

 private:
  const ScatteringColumn& column_;
  const ColumnPhase& phase_;
  const GaussNodes& nodes_;
  const NodeSteps& steps_;
  int mode_, components_;
  std::vector<SphericalFunctions> functions_;
};

/// to += factor * from, element by element.
void add_scaled(std::size_t count, double factor, const double* __restrict from, double* __restrict to);

}  // namespace ifov::atmosphere
