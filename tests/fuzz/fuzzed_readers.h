#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ifov::fuzz {

/// One reader under test. `read` may throw InputError and SystemError, nothing else.
struct FuzzedReader {
  std::string name;                ///< also the folder of its finds
  std::string file_name;           ///< that the damaged bytes are written to
  std::vector<std::string> seeds;  ///< good files
  std::vector<std::string> words;  ///< of the format
  std::function<void(const std::filesystem::path&)> read;
};

/// All readers; a new one is a row here or in a list of a subject.
std::vector<FuzzedReader> fuzzed_readers();
std::vector<FuzzedReader> atmosphere_readers();  ///< of paths through the atmosphere and of weather

}  // namespace ifov::fuzz
