#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run_control.h"

namespace ifov::studies {

struct StudyOptions {
  std::filesystem::path output_folder;  ///< made where it does not exist
  std::filesystem::path scene;  ///< document to study instead of the study's own scene, where it takes one
  std::filesystem::path reference;  ///< folder of reference data, where a study takes one; empty: IFOV_TRUTH
  int trials = 1000;                ///< random shifts of each scene; fewer than 100 give a quick look
  int threads = 0;                  ///< 0: all cores
  std::uint64_t seed = 1;           ///< of the shifts and of the renderings
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;

  /// With a shorter sweep too.
  bool is_quick() const { return trials < 100; }
};

struct StudyOutcome {
  std::string table;                         ///< the figures and their verdicts, for a terminal
  std::vector<std::filesystem::path> files;  ///< figures.json, report.html, the documents that were rendered
  bool all_met = false;                      ///< every figure of which something is asked meets it
};

/// One command of `ifov study`. run() throws as session::Session does.
struct StudyEntry {
  std::string_view name;
  std::string_view summary;  ///< one line for help
  StudyOutcome (*run)(const StudyOptions& options);
  bool takes_scene = false;  ///< StudyOptions::scene may be given
};

}  // namespace ifov::studies
