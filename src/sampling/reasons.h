#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ifov::sampling {

/// Why a pixel may be farther from the truth than its interval says, or its interval is wider than was asked. A pixel
/// is converged where none of these holds.
enum class Reason : std::uint8_t {
  unjudged,      ///< nothing is known of its error, or no accuracy was asked
  samples,       ///< stopped by the number of samples that a pixel may take
  time,          ///< stopped by time
  error,         ///< the sampler ended above the error asked for another reason: borders or tests were spent
  structure,     ///< finer structure than was resolved keeps turning up, or is known to be there
  unseen_light,  ///< light may reach it by a way that is not sought (caustics, images by several mirrors)
  air,           ///< the air's own error leaves no room within the error asked
  nodes,         ///< the spectral nodes' error leaves no room
  psf_cut,       ///< what the cut of the point spread function leaves out leaves no room
  edge,          ///< it sees what lies beyond the edge of what is described
};

/// Names as they stand in products, reports and documents; one for each Reason, in order.
inline constexpr std::array<std::string_view, 10> kReasonNames{
    "unjudged", "samples", "time", "error", "structure", "unseen light", "air", "nodes", "psf cut", "edge"};

/// A set of reasons: bit number r is Reason r.
using Reasons = std::uint16_t;
constexpr Reasons bit(Reason reason) { return static_cast<Reasons>(1u << static_cast<unsigned>(reason)); }

}  // namespace ifov::sampling
