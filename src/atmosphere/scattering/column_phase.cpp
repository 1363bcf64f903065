#include "atmosphere/scattering/column_phase.h"

#include <algorithm>

namespace ifov::atmosphere {

ColumnPhase::ColumnPhase(const ScatteringColumn& column, const AerosolProjection& aerosol, int most_terms)
    : sublayers(column.sublayers()) {
  const bool any_aerosol = std::any_of(column.mixtures.begin(), column.mixtures.end(),
                                       [](const auto& mixture) { return mixture.aerosol > 0.0; });
  terms = any_aerosol ? most_terms : std::min(3, most_terms);
  for (auto* table : {&beta, &alpha, &zeta, &gamma}) table->assign(terms * sublayers, 0.0);
  const PhaseExpansion molecules = rayleigh_expansion(terms, column.depolarization);
  PhaseExpansion particles;
  double asymmetry = 2.0;  // of `particles`; no asymmetry has this value
  for (std::size_t s = 0; s < sublayers; ++s) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[s]];
    if (mixture.aerosol > 0.0 && mixture.asymmetry != asymmetry) {
      asymmetry = mixture.asymmetry;
      particles = aerosol.expansion(asymmetry);
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
