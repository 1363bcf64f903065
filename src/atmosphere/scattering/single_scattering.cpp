#include "atmosphere/scattering/single_scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/beam_integral.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/shell_line_of_sight.h"

namespace ifov::atmosphere {

namespace {

/// Adds up the pieces of a path.
class SingleScattering {
 public:
  SingleScattering(const ScatteringColumn& column, double aerosol_polarization, const Propagation& direction,
                   const SunCell& cell = {})
      : column_(column),
        cosine_(scattering_cosine({-column.sun_mu, 0.0}, direction)),
        assumed_b1_(particle_matrix(cosine_, 1.0, aerosol_polarization).b1) {
    constexpr double kTowardsSun = 1.0 - 1e-10;
    const bool forward = cell.any() && cosine_ > kTowardsSun;
    const Propagation sun{-column.sun_mu, 0.0};
    molecules_ = scatter_unpolarized(sun, direction, rayleigh_matrix(cosine_, column.depolarization));
    polarized_ = scatter_unpolarized(sun, direction, {0.0, 0.0, 0.0, 1.0});
    if (!column.phases) return;
    for (const PhaseFunction& function : column.phases->functions) {
      const ScatteringMatrix matrix = function.matrix(cosine_, aerosol_polarization);
      // No particle polarizes what it scatters straight on.
      values_.push_back(forward
                            ? Value{function.forward_for(cell.along_zenith_rad, cell.along_azimuth_rad), 0.0}
                            : Value{matrix.a1, matrix.b1});
    }
  }

  bool operator()(const PathPiece& piece) {
    const double top = column_.beam_depth[piece.sublayer];
    const double beam = column_.beam_depth[piece.sublayer + 1] - top;
    add(column_.mixtures[column_.mixture_of[piece.sublayer]], piece.depth, piece.true_depth,
        top + beam * piece.near_position, top + beam * piece.far_position);
    return true;
  }
  /// Depths are along the path, those of the sunbeam at both ends from space.
  void add(const ScatteringColumn::Mixture& mixture, double depth, double true_depth, double near_beam,
           double far_beam) {
    if (&mixture != mixture_) enter(mixture);
    const double light = beam_integral(depth, depth_ + near_beam, depth_ + far_beam);
    rayleigh_sum_ += light * mixture.rayleigh;
    aerosol_sum_ += light * mixture.aerosol * aerosol_.a1;
    polarized_sum_ += light * mixture.aerosol * aerosol_.b1;
    pass(depth, true_depth);
  }
  /// Through what is not lit.
  void pass(double depth, double true_depth) {
    depth_ += depth;
    true_depth_ += true_depth;
  }

  PathLight light() const {
    PathLight light;
    light.single = 0.25 / std::numbers::pi * (rayleigh_sum_ * molecules_ + polarized_sum_ * polarized_);
    light.single.i += 0.25 / std::numbers::pi * aerosol_sum_;
    light.transmittance = std::exp(-true_depth_);
    light.peak_transmittance = std::exp(-depth_);
    return light;
  }

 private:
  struct Value {
    double a1 = 0.0, b1 = 0.0;
  };
  void enter(const ScatteringColumn::Mixture& mixture) {
    if (!column_.phases && (mixture_ == nullptr || mixture.asymmetry != mixture_->asymmetry)) {
      aerosol_.a1 = aerosol_matrix(cosine_, mixture.asymmetry, 0.0).a1;
      aerosol_.b1 = aerosol_.a1 * assumed_b1_;
    }
    mixture_ = &mixture;
    if (!column_.phases) return;
    const double* share = column_.phases->shares(mixture.layer);
    aerosol_ = {};
    for (std::size_t f = 0; f < values_.size(); ++f) {
      aerosol_.a1 += share[f] * values_[f].a1;
      aerosol_.b1 += share[f] * values_[f].b1;
    }
  }

  const ScatteringColumn& column_;
  const ScatteringColumn::Mixture* mixture_ = nullptr;
  std::vector<Value> values_;  ///< of the column's phase functions
  Value aerosol_;              ///< of the aerosol of `mixture_`
  double cosine_, assumed_b1_;
  StokesVector molecules_, polarized_;  ///< polarized: of b1 = 1
  double rayleigh_sum_ = 0.0, aerosol_sum_ = 0.0, polarized_sum_ = 0.0, depth_ = 0.0, true_depth_ = 0.0;
};

}  // namespace

PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const Propagation& direction, double observer_km, double length_km) {
  SingleScattering sum(column, aerosol_polarization, direction);
  walk_path(column, observer_km, direction.mu, length_km, sum);
  return sum.light();
}

PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const ShellLineOfSight& line, const SunCell& cell) {
  SingleScattering sum(column, aerosol_polarization, line.direction(), cell);
  if (line.pieces().empty()) return sum.light();
  const std::vector<double> beam = line.beam_depths(column.layer_depth);
  const double shallowest = *std::min_element(beam.begin(), beam.end());
  for (std::size_t p = 0; p < line.pieces().size(); ++p) {
    const ShellLineOfSight::Piece& piece = line.pieces()[p];
    const double depth = piece.slant * column.layer_depth[piece.layer],
                 true_depth = piece.slant * column.layer_true_depth[piece.layer];
    if (!piece.lit) {
      sum.pass(depth, true_depth);
      continue;
    }
    // Where a low Sun's beam is weakened much within the piece, its depth goes with the root of the way below the layer's top.
    const auto add = [&](const auto& again, double from, double to, double near, double far,
                         int halvings) -> void {
      constexpr double kWeakened = 0.3, kDarker = 12.0, kStraight = 0.02;
      if (halvings > 0 && std::abs(far - near) > kWeakened && std::min(near, far) < shallowest + kDarker) {
        const double half = 0.5 * (from + to), middle = line.beam_depth_within(p, half, column.layer_depth);
        if (std::abs(middle - 0.5 * (near + far)) > kStraight) {
          again(again, from, half, near, middle, halvings - 1);
          again(again, half, to, middle, far, halvings - 1);
          return;
        }
      }
      sum.add(column.mixtures[piece.layer], (to - from) * depth, (to - from) * true_depth, near, far);
    };
    constexpr int kHalvings = 10;
    add(add, 0.0, 1.0, beam[p], beam[p + 1], line.bends() ? kHalvings : 0);
  }
  return sum.light();
}

}  // namespace ifov::atmosphere
