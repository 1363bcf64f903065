#include "atmosphere/particles/mie_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace ifov::atmosphere {
namespace {

constexpr double kShortest_um = 0.2, kLongest_um = 50.0;

/// Wavelengths in equal steps of their logarithms, from end to end.
struct Grid {
  std::size_t steps;
  double at(double node) const {
    return kShortest_um * std::pow(kLongest_um / kShortest_um, node / static_cast<double>(steps));
  }
  /// Position, in steps from the first.
  double position(double um) const {
    const double share = std::log(um / kShortest_um) / std::log(kLongest_um / kShortest_um);
    return std::clamp(share, 0.0, 1.0) * static_cast<double>(steps);
  }
  std::pair<std::size_t, double> place(double um) const {
    const double at = position(um);
    const std::size_t node = std::min(static_cast<std::size_t>(at), steps - 1);
    return {node, at - static_cast<double>(node)};
  }
};
constexpr Grid kOptics{276}, kMatrices{72};
constexpr double kTermsOfMatrices = 3e5;  ///< each at all angles: a tenth of a second

std::vector<double> cosines(const PhaseAngles& angles) {
  std::vector<double> result;
  for (const double angle : angles.angle_rad) result.push_back(std::cos(angle));
  return result;
}

}  // namespace

std::shared_ptr<const PhaseAngles> mie_angles() {
  static const auto angles = [] {
    std::vector<double> degrees{0.0};
    for (double step = 0.02; degrees.back() < 10.0; step = std::min(1.1 * step, 1.0))
      degrees.push_back(degrees.back() + step);
    degrees.back() = 10.0;
    for (double at = 11.25; at <= 170.0; at += 1.25) degrees.push_back(at);
    for (double at = 170.25; at <= 180.0; at += 0.25) degrees.push_back(at);
    std::vector<double> radians;
    for (const double at : degrees)
      radians.push_back(at == 180.0 ? std::numbers::pi : at * std::numbers::pi / 180.0);
    return std::make_shared<const PhaseAngles>(std::move(radians));
  }();
  return angles;
}

struct MieParticles::Kept {
  template <std::size_t count>
  struct Nodes {
    std::array<std::once_flag, count> made;
    std::array<MieMixture, count> mixture;
  };
  Nodes<kOptics.steps + 1> optics;
  Nodes<kMatrices.steps + 1> matrices;
};

MieParticles::MieParticles(SizeDistribution sizes, radiometry::Spectrum n, radiometry::Spectrum k)
    : sizes_(std::move(sizes)), n_(std::move(n)), k_(std::move(k)), kept_(std::make_unique<Kept>()) {
  const auto place = [](const radiometry::Spectrum& spectrum, auto better) {
    const auto values = spectrum.values();
    const auto at = std::min_element(values.begin(), values.end(), better) - values.begin();
    const std::string where =
        spectrum.is_constant()
            ? std::string()
            : format(" at {:g} um", spectrum.wavelength_um()[static_cast<std::size_t>(at)]);
    return std::pair(values[static_cast<std::size_t>(at)], where);
  };
  const auto [least_n, where_n] = place(n_, std::less<>());
  if (!(least_n >= 0.01))
    throw InputError(format("an index of refraction n of {:g}{}: expected 0.01 or more", least_n, where_n));
  const auto [least_k, where_k] = place(k_, std::less<>());
  if (!(least_k >= 0.0))
    throw InputError(format("an index of refraction k of {:g}{}: expected 0 or more", least_k, where_k));
  const double largest_um = sizes_.radius_um.back(),
               most_um = MieSphere::kLargest * kShortest_um / (2.0 * std::numbers::pi);
  if (largest_um > most_um)
    throw InputError(format("spheres of up to {:.3g} um: expected {:.3g} um or less", largest_um, most_um));
  share_within_ = sizes_.share_within();
  reference_extinction_ = interpolated(kReference_um).extinction;
}

MieParticles::~MieParticles() = default;

/// Where a node lies beyond what is known, the end of that.
std::complex<double> MieParticles::index(double um) const {
  const double within =
      std::clamp(um, std::max(n_.first_um(), k_.first_um()), std::min(n_.last_um(), k_.last_um()));
  return {n_.at(within), k_.at(within)};
}

const MieMixture& MieParticles::efficiencies(std::size_t node) const {
  std::call_once(kept_->optics.made[node], [&] {
    const double um = kOptics.at(static_cast<double>(node));
    kept_->optics.mixture[node] = mie_mixture(sizes_.resolved(um), um, index(um), {});
  });
  return kept_->optics.mixture[node];
}

const MieMixture& MieParticles::matrix(std::size_t node) const {
  std::call_once(kept_->matrices.made[node], [&] {
    const double um = kMatrices.at(static_cast<double>(node));
    kept_->matrices.mixture[node] =
        mie_mixture(sizes_.resolved(um, kTermsOfMatrices), um, index(um), cosines(*mie_angles()));
  });
  return kept_->matrices.mixture[node];
}

MieMixture MieParticles::interpolated(double um) const {
  const auto [node, share] = kOptics.place(um);
  const MieMixture &a = efficiencies(node), &b = efficiencies(node + 1);
  MieMixture result;
  result.extinction = std::lerp(a.extinction, b.extinction, share);
  result.scattering = std::lerp(a.scattering, b.scattering, share);
  result.asymmetry = std::lerp(a.asymmetry, b.asymmetry, share);
  result.volume = a.volume;
  return result;
}

AerosolProperties MieParticles::properties(double um) const {
  // Asked for beyond what is known of the index, it says so.
  if (um != kReference_um) (void)n_.at(um), (void)k_.at(um);
  const MieMixture here = interpolated(um);
  return {here.extinction / reference_extinction_,
          std::max(0.0, here.extinction - here.scattering) / reference_extinction_, here.asymmetry};
}

double MieParticles::extinction_per_volume(double um) const {
  const MieMixture here = interpolated(um);
  return here.extinction / here.volume;
}

MieMixture MieParticles::cross_sections(double um) const {
  MieMixture here = interpolated(um);
  here.extinction *= share_within_, here.scattering *= share_within_, here.volume *= share_within_;
  return here;
}

MieMixture MieParticles::matrix_at(double um) const {
  const auto [node, share] = kMatrices.place(um);
  const MieMixture &a = matrix(node), &b = matrix(node + 1);
  const std::size_t count = a.a1.size();
  MieMixture here;
  here.a1.resize(count), here.a3.resize(count), here.b1.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    here.a1[k] = std::exp(std::lerp(std::log(a.a1[k]), std::log(b.a1[k]), share));
    here.a3[k] = here.a1[k] * std::lerp(a.a3[k] / a.a1[k], b.a3[k] / b.a1[k], share);
    here.b1[k] = here.a1[k] * std::lerp(a.b1[k] / a.a1[k], b.b1[k] / b.a1[k], share);
  }
  return here;
}

PhaseFunction MieParticles::phase_function(double um) const {
  const MieMixture here = matrix_at(um);
  const std::size_t count = here.a1.size();
  std::vector<double> logarithms(count);
  PolarizationRatios ratios{std::vector<double>(count, 1.0), std::vector<double>(count),
                            std::vector<double>(count)};
  for (std::size_t k = 0; k < count; ++k) {
    logarithms[k] = std::log(here.a1[k]);
    ratios.a3[k] = here.a3[k] / here.a1[k];
    ratios.b1[k] = here.b1[k] / here.a1[k];
  }
  return {mie_angles(), std::move(logarithms), std::make_shared<const PolarizationRatios>(std::move(ratios))};
}

}  // namespace ifov::atmosphere
