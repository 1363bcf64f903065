#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace ifov::fuzz {

/// A damaged copy of one of the seeds: bytes flipped, numbers replaced by awkward ones, pieces cut, doubled,
/// swapped or taken over from another seed, words of the format put in. Depends on nothing but its arguments.
std::string mutated(std::span<const std::string> seeds, std::span<const std::string> words,
                    std::uint64_t seed, std::uint64_t run);

}  // namespace ifov::fuzz
