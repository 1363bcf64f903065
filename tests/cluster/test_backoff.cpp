#include <gtest/gtest.h>

#include "cluster/backoff.h"

namespace ifov::cluster::test_backoff {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(Backoff, IsShortAfterAMessageAndFewTimesASecondLaterOn) {
  Backoff backoff;
  EXPECT_EQ(backoff.next(milliseconds(5)), Backoff::kShortest);
  microseconds since{0};
  int looks = 0;
  for (; since < milliseconds(1000); ++looks) {
    const microseconds length = backoff.next(milliseconds(5));
    EXPECT_LE(length, since + 2 * Backoff::kShortest);
    since += length;
  }
  EXPECT_LT(looks, 220);
  backoff.restart();
  EXPECT_EQ(backoff.next(milliseconds(5)), Backoff::kShortest);
}

TEST(Backoff, KeepsTheLimitOfTheMoment) {
  Backoff backoff;
  for (int k = 0; k < 20; ++k) backoff.next(milliseconds(20));
  EXPECT_EQ(backoff.next(milliseconds(1)), milliseconds(1));
  EXPECT_EQ(backoff.next(milliseconds(20)), milliseconds(2));
}

}  // namespace
}  // namespace ifov::cluster::test_backoff
