#pragma once

#include <cstdint>
#include <map>

#include "sampling/accuracy/basis/stopping.h"

namespace ifov::sampling {

/// What sequences of paths gain (the variance that they leave over that of paths drawn apart), as all outputs of a tile whose
/// variance comes from the same label tell it together. Few replicates tell an output's own gain badly; like outputs have like
/// gains, and how like is told by how much more their logarithms differ than degrees of freedom make them. Empirical Bayes
/// for variances: Smyth, Stat. Appl. Genet. Mol. Biol. 3(1), 3, 2004, eqs. (2) to (4) and section 6.2, with a mean that
/// follows the logarithm of the number of values.
class SequenceGains {
 public:
  /// An output whose variance comes from `label` at most and rests on about `count` values.
  void add(std::uint32_t label, SequenceGain own, double count);
  /// After all were added.
  void settle();
  /// The output's own gain and what like outputs tell, weighed by their degrees of freedom; `own` where too few are like it.
  SequenceGain moderated(std::uint32_t label, SequenceGain own, double count) const;

 private:
  struct Pool {
    // Sums over outputs: of x = log(count) and z, the logarithm of the gain less its expectation at its degrees of freedom.
    double n = 0.0, x = 0.0, z = 0.0, xx = 0.0, xz = 0.0, zz = 0.0;
    double scatter = 0.0;             ///< of the variances that degrees of freedom make of z
    double level = 0.0, slope = 0.0;  ///< of z over x
    double freedom = 0.0;             ///< 0: tells nothing
    double lowest = 0.0, highest = 0.0;
  };
  static void settle(Pool& pool);
  const Pool* pool_of(std::uint32_t label) const;

  std::map<std::uint32_t, Pool> pools_;
  Pool rest_;  // of labels whose own pools are too small
};

}  // namespace ifov::sampling
