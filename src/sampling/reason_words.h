#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sampling/reasons.h"

namespace ifov::sampling {

/// Pixels for which each Reason holds; a pixel counts for every one that it has.
using ReasonCounts = std::array<std::uint64_t, kReasonNames.size()>;

void add_reasons(std::span<const Reasons> pixels, ReasonCounts& counts);
void add_counts(const ReasonCounts& more, ReasonCounts& counts);

/// What a reason says of a pixel, in plain words: "light may reach it in ways that are not sought".
std::string_view words_of(Reason reason);

/// First those with which the truth may lie outside of the interval, then those with which the interval is only wider
/// than was asked.
std::span<const Reason> reasons_by_gravity();

/// Of all reasons of a pixel the gravest; none where the set is empty.
std::optional<Reason> gravest(Reasons reasons);

/// "the samples that a pixel may take were spent (60 pixels); light may reach it in ways that are not sought (3)", the
/// most frequent first; empty where no pixel has a reason.
std::string describe_reasons(const ReasonCounts& counts);

}  // namespace ifov::sampling
