#include "cluster/nap.h"

#include <gtest/gtest.h>

namespace ifov::cluster {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(Nap, IsShortAfterAMessageAndFewTimesASecondLaterOn) {
  Nap nap;
  EXPECT_EQ(nap.next(milliseconds(5)), Nap::kShortest);
  microseconds since{0};
  int looks = 0;
  for (; since < milliseconds(1000); ++looks) {
    const microseconds length = nap.next(milliseconds(5));
    EXPECT_LE(length, since + 2 * Nap::kShortest);
    since += length;
  }
  EXPECT_LT(looks, 220);
  nap.restart();
  EXPECT_EQ(nap.next(milliseconds(5)), Nap::kShortest);
}

TEST(Nap, KeepsTheLimitOfTheMoment) {
  Nap nap;
  for (int k = 0; k < 20; ++k) nap.next(milliseconds(20));
  EXPECT_EQ(nap.next(milliseconds(1)), milliseconds(1));
  EXPECT_EQ(nap.next(milliseconds(20)), milliseconds(2));
}

}  // namespace
}  // namespace ifov::cluster
