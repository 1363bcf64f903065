#include <gtest/gtest.h>

#include "sampling/intervals/quantiles.h"

namespace ifov::sampling::test_quantiles {
namespace {

TEST(Quantiles, NormalTable) {
  EXPECT_NEAR(two_sided_normal(0.95), 1.959963984540054, 1e-12);
  EXPECT_NEAR(two_sided_normal(0.5), 0.6744897501960817, 1e-12);
  EXPECT_NEAR(two_sided_normal(0.999999), 4.891638475698822, 1e-9);
  EXPECT_NEAR(two_sided_normal(0.1), 0.12566134685507402, 1e-12);
}

TEST(Quantiles, StudentTable) {
  EXPECT_NEAR(two_sided_student(0.95, 1), 12.706204736432095, 1e-9);
  EXPECT_NEAR(two_sided_student(0.95, 7), 2.364624251592785, 1e-10);
  EXPECT_NEAR(two_sided_student(0.99, 3), 5.840909309732855, 1e-9);
  EXPECT_NEAR(two_sided_student(0.95, 1e6), 1.959966, 2e-6);
}

TEST(Quantiles, TableAgreesWithFunction) {
  StudentTable table(0.9);
  EXPECT_EQ(table(5), two_sided_student(0.9, 5));
  EXPECT_EQ(table(5), two_sided_student(0.9, 5));
}

}  // namespace
}  // namespace ifov::sampling::test_quantiles
