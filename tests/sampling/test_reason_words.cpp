#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "sampling/reason_words.h"

namespace ifov::sampling::test_reason_words {
namespace {

TEST(Reasons, AreCountedEachForItself) {
  ReasonCounts counts{};
  const std::vector<Reasons> pixels{0, bit(Reason::samples),
                                    static_cast<Reasons>(bit(Reason::samples) | bit(Reason::air)), 0};
  add_reasons(pixels, counts);
  add_counts(counts, counts);
  for (std::size_t r = 0; r < counts.size(); ++r)
    EXPECT_EQ(counts[r], r == static_cast<std::size_t>(Reason::samples) ? 4u
                         : r == static_cast<std::size_t>(Reason::air)   ? 2u
                                                                        : 0u);
}

TEST(Reasons, AreSaidInWordsTheMostFrequentFirst) {
  ReasonCounts counts{};
  EXPECT_EQ(describe_reasons(counts), "");
  counts[static_cast<std::size_t>(Reason::samples)] = 1;
  EXPECT_EQ(describe_reasons(counts), "the samples that a pixel may take were spent (1 pixel)");
  counts[static_cast<std::size_t>(Reason::unseen_light)] = 30;
  EXPECT_EQ(
      describe_reasons(counts),
      "light may reach it in ways that are not sought (30 pixels); the samples that a pixel may take were spent (1)");
}

TEST(Reasons, TheGravestIsOneWithWhichTheTruthMayLieOutside) {
  EXPECT_FALSE(gravest(0));
  EXPECT_EQ(gravest(bit(Reason::samples)), Reason::samples);
  EXPECT_EQ(gravest(static_cast<Reasons>(bit(Reason::samples) | bit(Reason::structure))), Reason::structure);
  EXPECT_EQ(gravest(static_cast<Reasons>((1u << kReasonNames.size()) - 1u)), Reason::unseen_light);
}

TEST(Reasons, EachHasItsPlaceAndItsWords) {
  std::set<Reason> placed;
  std::set<std::string_view> words;
  for (const Reason reason : reasons_by_gravity()) {
    placed.insert(reason);
    words.insert(words_of(reason));
    EXPECT_EQ(gravest(bit(reason)), reason);
  }
  EXPECT_EQ(placed.size(), kReasonNames.size());
  EXPECT_EQ(words.size(), kReasonNames.size());
}

}  // namespace
}  // namespace ifov::sampling::test_reason_words
