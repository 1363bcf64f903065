#include "sampling/reason_words.h"

#include <algorithm>
#include <numeric>

#include "core/format.h"

namespace ifov::sampling {
namespace {

constexpr std::array<std::string_view, kReasonNames.size()> kWords{
    "nothing is known of its error",
    "the samples that a pixel may take were spent",
    "time ran out before it was finished",
    "it stayed above the limit after the last test",
    "it holds finer structure than was resolved",
    "light may reach it in ways that are not sought",
    "the air is not known well enough",
    "the spectral nodes or solved temperatures are not exact enough",
    "what the cut of the point spread function leaves out is too much",
    "it sees what lies beyond the edge of what is described",
};

constexpr std::array<Reason, kReasonNames.size()> kByGravity{
    Reason::unseen_light, Reason::structure, Reason::edge, Reason::time,    Reason::unjudged,
    Reason::psf_cut,      Reason::nodes,     Reason::air,  Reason::samples, Reason::error,
};

}  // namespace

void add_reasons(std::span<const Reasons> pixels, ReasonCounts& counts) {
  for (const Reasons reasons : pixels) {
    if (reasons == 0) continue;
    for (std::size_t r = 0; r < counts.size(); ++r) counts[r] += (reasons >> r) & 1u;
  }
}

void add_counts(const ReasonCounts& more, ReasonCounts& counts) {
  for (std::size_t r = 0; r < counts.size(); ++r) counts[r] += more[r];
}

std::string_view words_of(Reason reason) { return kWords[static_cast<std::size_t>(reason)]; }

std::span<const Reason> reasons_by_gravity() { return kByGravity; }

std::optional<Reason> gravest(Reasons reasons) {
  for (const Reason reason : kByGravity)
    if ((reasons & bit(reason)) != 0) return reason;
  return std::nullopt;
}

std::string describe_reasons(const ReasonCounts& counts) {
  std::array<std::size_t, kReasonNames.size()> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
  std::string text;
  for (const std::size_t r : order) {
    if (counts[r] == 0) break;
    text += text.empty() ? format("{} ({} pixel{})", kWords[r], counts[r], counts[r] == 1 ? "" : "s")
                         : format("; {} ({})", kWords[r], counts[r]);
  }
  return text;
}

}  // namespace ifov::sampling
