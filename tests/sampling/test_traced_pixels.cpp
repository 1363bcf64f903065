#include <gtest/gtest.h>

#include <vector>

#include "sampling/accuracy/borders/traced_pixels.h"

namespace ifov::sampling::test_traced_pixels {
namespace {

using Flags = std::vector<std::uint8_t>;

TEST(TracedPixels, AreStirredByTracingAndByWhatTheyMayErr) {
  TracedPixels pixels(3, 100);
  Flags stirred;
  pixels.take_stirred(stirred);
  EXPECT_EQ(stirred, (Flags{1, 1, 1})) << "none has been looked at yet";
  pixels.take_stirred(stirred);
  EXPECT_EQ(stirred, (Flags{0, 0, 0}));
  pixels.stir(1);
  pixels.allow_variance(2, 0.25);
  pixels.allow_variance(0, 1.0);  // as it was
  pixels.take_stirred(stirred);
  EXPECT_EQ(stirred, (Flags{0, 1, 1}));
  pixels.take_stirred(stirred);
  EXPECT_EQ(stirred, (Flags{0, 0, 0}));
  EXPECT_DOUBLE_EQ(pixels.allowed_deviation(2), 0.5);
}

TEST(TracedPixels, AreAbandonedBeyondTheirBudgetOnce) {
  TracedPixels pixels(3, 100);
  pixels.limit_budget(1, 50.0);
  pixels.limit_budget(2, 500.0);  // budgets are lowered only
  pixels.forget_changes();
  pixels.abandon_beyond_budget(std::vector<std::uint32_t>{100, 51, 101});
  EXPECT_FALSE(pixels.abandoned(0));
  EXPECT_TRUE(pixels.abandoned(1));
  EXPECT_TRUE(pixels.abandoned(2));
  EXPECT_FALSE(pixels.changed(0));
  EXPECT_TRUE(pixels.changed(1));
  pixels.forget_changes();
  pixels.abandon_beyond_budget(std::vector<std::uint32_t>{100, 52, 102});
  EXPECT_FALSE(pixels.changed(1)) << "once is enough";
}

// What was sought leaves no sign of anything unknown.
TEST(TracedPixels, SignsCanBeTakenBack) {
  TracedPixels pixels(2, 100);
  pixels.note_suspect(0);
  pixels.note_followed(0, 3);
  pixels.note_followed(0, 2);
  const TracedPixels::Signs before = pixels.signs();
  pixels.note_suspect(1);
  pixels.note_followed(0, 5);
  pixels.set_signs(before);
  EXPECT_TRUE(pixels.suspect(0));
  EXPECT_FALSE(pixels.suspect(1));
  EXPECT_EQ(pixels.followed(0), 3);
  EXPECT_EQ(pixels.followed(1), 0);
}

}  // namespace
}  // namespace ifov::sampling::test_traced_pixels
