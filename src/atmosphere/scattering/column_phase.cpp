#include "atmosphere/scattering/column_phase.h"

#include <algorithm>

namespace ifov::atmosphere {

namespace {

bool scatters_alike(const ScatteringColumn& column, const ScatteringColumn::Mixture& a,
                    const ScatteringColumn::Mixture& b) {
  if (!column.phases) return a.asymmetry == b.asymmetry;
  const double *first = column.phases->shares(a.layer), *second = column.phases->shares(b.layer);
  return std::equal(first, first + column.phases->functions.size(), second);
}

PhaseExpansion mixed(const std::vector<PhaseExpansion>& functions, const double* share) {
  PhaseExpansion sum;
  for (std::size_t f = 0; f < functions.size(); ++f)
    for (auto part :
         {&PhaseExpansion::beta, &PhaseExpansion::alpha, &PhaseExpansion::zeta, &PhaseExpansion::gamma}) {
      const std::vector<double>& from = functions[f].*part;
      std::vector<double>& to = sum.*part;
      to.resize(from.size(), 0.0);
      for (std::size_t l = 0; l < from.size(); ++l) to[l] += share[f] * from[l];
    }
  return sum;
}

}  // namespace

ColumnPhase::ColumnPhase(const ScatteringColumn& column, const AerosolProjection& aerosol, int most_terms)
    : sublayers(column.sublayers()) {
  const bool any_aerosol = std::any_of(column.mixtures.begin(), column.mixtures.end(),
                                       [](const auto& mixture) { return mixture.aerosol > 0.0; });
  terms = any_aerosol ? most_terms : std::min(3, most_terms);
  for (auto* table : {&beta, &alpha, &zeta, &gamma}) table->assign(terms * sublayers, 0.0);
  const PhaseExpansion molecules = rayleigh_expansion(terms, column.depolarization);
  PhaseExpansion particles;
  std::vector<PhaseExpansion> functions;
  if (any_aerosol && column.phases)
    for (const PhaseFunction& function : column.phases->functions)
      functions.push_back(aerosol.expansion(function));
  const ScatteringColumn::Mixture* last = nullptr;  // whose particles are in `particles`
  for (std::size_t s = 0; s < sublayers; ++s) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[s]];
    if (mixture.aerosol > 0.0 && (last == nullptr || !scatters_alike(column, *last, mixture))) {
      particles = column.phases ? mixed(functions, column.phases->shares(mixture.layer))
                                : aerosol.expansion(mixture.asymmetry);
      last = &mixture;
    }
    for (int l = 0; l < terms; ++l) {
      const std::size_t at = l * sublayers + s;
      const double r = 0.5 * mixture.rayleigh;
      beta[at] = r * molecules.beta[l];
      alpha[at] = r * molecules.alpha[l];
      gamma[at] = r * molecules.gamma[l];
      if (mixture.aerosol <= 0.0) continue;
      const double a = 0.5 * mixture.aerosol, forward = mixture.peak * (2.0 * l + 1.0);
      beta[at] += a * (particles.beta[l] - forward);
      gamma[at] += a * particles.gamma[l];
      if (l < 2) continue;  // Q and U have no terms below 2
      alpha[at] += a * (particles.alpha[l] - forward);
      zeta[at] += a * (particles.zeta[l] - forward);
    }
  }
}

}  // namespace ifov::atmosphere
