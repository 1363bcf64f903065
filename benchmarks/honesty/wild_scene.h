#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "honesty/plain_tracer.h"

namespace ifov::benchmarks {

/// A small scene made by rule and chance.
struct WildScene {
  std::string kind, name;
  std::string document;       ///< JSON; the files that it names lie in the folder it was made for
  std::vector<double> exact;  ///< radiance of each pixel in the one channel, where a closed form gives it
  PlainHints hints;           ///< else for the plain tracer
};

/// All kinds, in the order in which numbers take them by turns.
std::span<const std::string_view> wild_kinds();

/// The scene of this number, which wholly determines it; kind number % kinds. Writes its maps and meshes to `folder`.
WildScene wild_scene(std::uint64_t number, const std::filesystem::path& folder);

}  // namespace ifov::benchmarks
