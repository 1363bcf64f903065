#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

namespace ifov::test {

/// A file or folder of the reference data, which lies beside the source tree (../shared/truth) or where the
/// environment variable IFOV_TRUTH points; nothing where it is absent, and then tests skip and name it:
///   const auto file = truth_file("spectra/grass.txt");
///   if (!file) GTEST_SKIP() << "reference data not found: spectra/grass.txt";
inline std::optional<std::filesystem::path> truth_file(std::string_view relative) {
  const char* root = std::getenv("IFOV_TRUTH");
  const std::filesystem::path path =
      (root != nullptr ? std::filesystem::path(root)
                       : std::filesystem::path(IFOV_SOURCE_DIR "/../shared/truth")) /
      relative;
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  return std::nullopt;
}

}  // namespace ifov::test
