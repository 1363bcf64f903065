#pragma once

#include <functional>
#include <span>

#include "atmosphere/gas/gas_spectra.h"

namespace ifov::atmosphere {

/// How terms are made of spectra.
struct TermFit {
  double first_cm1 = 0.0, step_cm1 = 1.0;
  std::size_t bins = 0;
  std::size_t most_terms = 16;  ///< in a bin, 1 to kMostTerms
  double error = 0.001;         ///< of transmittance: no more terms are taken than this needs
  int threads = 0;
  std::function<void(std::size_t)> progress = {};  ///< told how many bins are done; may throw to end it
  static constexpr std::size_t kMostTerms = 64;
};

/// How far transmittances of terms are from those of the spectra.
struct TermFitErrors {
  double largest = 0.0, rms = 0.0;  ///< over bins and paths
  double largest_at_cm1 = 0.0;
  std::size_t missed = 0;  ///< bins whose error is beyond the one asked for
  double between = 0.0;    ///< largest that interpolation between the states of the spectra may add
  double mean = 0.0;       ///< largest over paths of the mean over all bins: what wide channels see
  double terms = 0.0;      ///< in a bin, mean over those where something absorbs
  double overlap =
      0.0;  ///< rms over bins: what terms of each gas by itself, overlapping at random, would be off by
};

struct FittedTerms {
  GasTermTable table;  ///< without a name and a source
  TermFitErrors errors;
};

/// The terms of gases whose spectra have the same wavenumbers and states. A term stands for a set of wavenumbers, the same for all
/// gases and in every state, so that gases overlap as their lines do. The sets of a bin are those whose members differ least in
/// what they transmit along many paths through the U.S. standard atmosphere of 1976, by all gases together and each by itself
/// (k-means; Lloyd, IEEE Trans. Information Theory 28 (1982) 129-137). A set's cross section of a gas in a state is that of the mean
/// transmittance of its members at a depth of 1, or at twice the column where that is thinner. So absorption goes on to be matched
/// from layer to layer where lines change their width, as far as the members of a set change alike. What is left of that, and of
/// the number of terms, is the error of each bin: the largest along paths through the six model atmospheres (from the ground, 2, 5
/// and 10 km to space, from the ground to 1 and to 5 km, vertical and 1.5, 3 and 6 times as long), all gases together and each by
/// itself, against the spectra line by line, both with cross sections between states as the grid has them; and on top what
/// interpolation between states makes of the path: a third of what leaving out every second pressure, and every second temperature,
/// makes, as for an error of second order. Where no path loses more than a millionth, nothing absorbs. Only bins that the spectra
/// cover may be asked for.
FittedTerms fit_terms(std::span<const GasSpectra> spectra, const TermFit& fit);

}  // namespace ifov::atmosphere
