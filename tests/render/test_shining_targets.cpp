// What shines, put together by place.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "render/unseen/shining_targets.h"

namespace ifov::render::test_shining_targets {
namespace {

std::vector<ShiningTarget> row(int count) {
  std::vector<ShiningTarget> targets;
  for (int k = 0; k < count; ++k) {
    ShiningTarget target;
    target.centre_m = {3.0 * k, k % 7 * 1.0, 2.0};
    target.part.ball = {target.centre_m, 0.1 + 0.01 * (k % 5)};
    target.part.fill = 0.5;
    target.part.contrast = k;
    targets.push_back(target);
  }
  return targets;
}

double discs_m2(std::span<const ShiningTarget> targets) {
  double sum = 0.0;
  for (const ShiningTarget& target : targets)
    sum += target.part.fill * target.part.ball.radius_m * target.part.ball.radius_m;
  return sum;
}

TEST(ShiningTargets, FewStayThemselves) {
  const std::vector<ShiningTarget> few = put_together(row(10), 16);
  ASSERT_EQ(few.size(), 10u);
  EXPECT_EQ(few[3].centre_m.x, 9.0);
}

TEST(ShiningTargets, GroupsHoldAllOfTheirPartsAndFillAsMuch) {
  const std::vector<ShiningTarget> parts = row(1000), groups = put_together(parts, 16);
  ASSERT_EQ(groups.size(), 16u);
  EXPECT_NEAR(discs_m2(groups), discs_m2(parts), 1e-9 * discs_m2(parts));
  double brightest = 0.0;
  for (const ShiningTarget& group : groups) {
    brightest = std::max(brightest, group.part.contrast);
    EXPECT_LT(group.part.ball.radius_m, 120.0);  // of a row of 3 km
  }
  EXPECT_EQ(brightest, 999.0);
  for (const ShiningTarget& part : parts)
    EXPECT_TRUE(std::any_of(groups.begin(), groups.end(), [&](const ShiningTarget& group) {
      return length(part.centre_m - group.centre_m) + part.part.ball.radius_m <=
             group.part.ball.radius_m * (1.0 + 1e-12);
    })) << part.centre_m.x;
}

}  // namespace
}  // namespace ifov::render::test_shining_targets
