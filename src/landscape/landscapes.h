#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::landscape {

struct MakeOptions {
  std::filesystem::path folder;  ///< of the scene; made by this
  double size_m = 200.0;         ///< side of the square that the images show
  std::uint64_t seed = 1;
  bool replace = false;  ///< whether a folder that exists gives way
};

/// What was made.
struct MadeScene {
  std::vector<std::filesystem::path> documents;  ///< the one to begin with first
  std::vector<std::string> contents;             ///< "112 houses of 18 designs", ...
  std::size_t files = 0, triangles = 0;
  std::uint64_t bytes = 0;
};

/// One kind of generated scene.
struct LandscapeEntry {
  std::string_view name;
  std::string_view summary;  ///< one line for help
  MadeScene (*make)(const MakeOptions& options);
};

inline constexpr double kSmallest_m = 60.0, kLargest_m = 1000.0;

/// All kinds, in the order of the help page.
std::span<const LandscapeEntry> all_landscapes();
/// null where there is none of that name.
const LandscapeEntry* find_landscape(std::string_view name);

/// A length as documents and --size give it: "200m". InputError on anything else.
double size_m_of(const std::string& text);

/// Each writes an ordinary scene into a folder: documents, meshes, instance lists, maps. The same options give the
/// same bytes. Throws InputError where the size is not between kSmallest_m and kLargest_m or the folder exists,
/// SystemError where something cannot be written; then no folder is left.
MadeScene make_suburb(const MakeOptions& options);
MadeScene make_forest(const MakeOptions& options);
MadeScene make_desert(const MakeOptions& options);
MadeScene make_harbour(const MakeOptions& options);

}  // namespace ifov::landscape
