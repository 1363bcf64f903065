#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifov/run_control.h"

namespace ifov {

/// What a gas model is to be made of: absorption spectra of gases, line by line.
struct GasModelQuestion {
  struct Spectra {
    std::string gas;  ///< its formula, one of those that 'gases' of a document knows: "H2O", "CH4" ...
    std::filesystem::path file;    ///< cross sections by state (docs/formats/gas_model.md#spectra)
    double self_broadening = 1.0;  ///< of lines by the gas itself over that by air
    bool holds_continuum = false;  ///< the built-in continuum of this gas is to stay out
    /// By what share of itself the depth of this gas by these spectra may be off, 0 to 1; none: not known
    std::optional<double> depth_error = {};
  };
  std::vector<Spectra> spectra;  ///< all at the same wavenumbers and states; a gas is there once
  std::string source = {};       ///< in words, of lines, line shape and program; one line
  double step_cm1 = 1.0;         ///< width of a bin, 0.001 to 20
  std::optional<double> first_cm1 = {},
                        last_cm1 = {};  ///< of the bins; none: as far as whole bins are covered
  std::size_t most_terms = 16;          ///< in a bin, 1 to 64
  double error = 0.001;                 ///< of transmittance, that a bin takes as many terms for as it needs
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
};

/// What was made. Errors are of transmittance, of the terms against the spectra along paths through six model atmospheres.
struct GasModelOutcome {
  std::size_t bins = 0;
  double first_cm1 = 0.0, last_cm1 = 0.0;
  double terms = 0.0;  ///< of a bin, mean
  double largest_error = 0.0, largest_error_at_cm1 = 0.0, rms_error = 0.0;
  double between_states = 0.0;  ///< largest that interpolation between the spectra's states may add
  double mean_error = 0.0;      ///< largest over paths of the mean over all bins
  double random_overlap = 0.0;  ///< what gases that overlap at random would be off by, rms over bins
  std::size_t missed =
      0;  ///< bins whose largest error is beyond the one asked for: they have all terms that they may
  /// Of states too far apart, or that do not reach far enough: what the errors above do not hold.
  std::vector<std::string> warnings;
};

/// Fits terms to the spectra and writes the file (docs/formats/gas_model.md). Throws InputError for spectra that make no sense or do
/// not belong together, SystemError of files, Cancelled.
IFOV_API GasModelOutcome make_gas_model(const GasModelQuestion& question, const std::filesystem::path& to);

}  // namespace ifov
