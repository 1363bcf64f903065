#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "atmosphere/imported_path.h"
#include "io/atmosphere/modtran_columns.h"

namespace ifov::io {

/// One run of a MODTRAN tape7, .tp7 or .7sc.
struct ModtranRun {
  ModtranMode mode = ModtranMode::radiance;
  int line = 0;  ///< of the run's first card
  atmosphere::ImportedPath path;
};

/// All runs of a file, in order: cards echoed, one or two lines of headings, rows of fixed width with blank
/// columns, -9999. Columns are found by the ends of their headings. The unit of the spectral column is the
/// heading's; "FREQ" alone is cm-1, but for convolved files (.7sc, tape7.scn) what card 4 asks for (FLAGS: W,
/// M or N). `unit` overrules both. Several lines of sight in one run give a run each. Throws InputError with
/// the place for other files, for runs that end early, and for headings that contradict card 1.
std::vector<ModtranRun> read_modtran_tape7(const std::filesystem::path& path,
                                           std::optional<WavelengthUnit> unit = std::nullopt);
std::vector<ModtranRun> parse_modtran_tape7(const TextFile& file,
                                            std::optional<WavelengthUnit> unit = std::nullopt);

}  // namespace ifov::io
