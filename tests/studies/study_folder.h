#pragma once

#include <filesystem>

#include "studies/common/study_options.h"

namespace ifov::studies {

/// A study at its smallest, on one thread, in a folder of its own.
inline StudyOptions in_a_folder(const char* name) {
  StudyOptions options;
  options.output_folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::create_directories(options.output_folder);
  options.trials = 1;
  options.threads = 1;
  return options;
}

}  // namespace ifov::studies
