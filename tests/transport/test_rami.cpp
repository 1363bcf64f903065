#include <gtest/gtest.h>

#include <cmath>

#include "support/truth_data.h"
#include "transport/rami_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_rami {
namespace {

using test::RamiScene;

constexpr const char* kFolder = "rami/het01";

/// Largest relative deviation from the published reflectance factors at some of their angles, and the largest relative
/// standard error of ours.
struct Comparison {
  double worst = 0.0, standard_error = 0.0;
  int angles = 0;
};

Comparison compare(const std::filesystem::path& folder, RamiScene::Fault fault,
                   std::vector<double> angles_deg, std::uint32_t paths) {
  const RamiScene scene(folder, fault);
  Comparison c;
  for (const std::vector<double>& row : RamiScene::numbers(folder / "expected_brf.csv", 2)) {
    if (std::find(angles_deg.begin(), angles_deg.end(), row[0]) == angles_deg.end()) continue;
    const RamiScene::Estimate e = scene.brf(row[0], paths);
    c.worst = std::max(c.worst, std::abs(e.brf / row[1] - 1.0));
    c.standard_error = std::max(c.standard_error, e.standard_error / e.brf);
    ++c.angles;
  }
  return c;
}

TEST(Rami, HeterogeneousCanopyWithinOnePercent) {
  const auto folder = test::truth_file(kFolder);
  if (!folder) GTEST_SKIP() << "reference data not found: " << kFolder;
  const Comparison c = compare(*folder, RamiScene::Fault::none, {-21.0, 61.0}, 1 << 15);
  EXPECT_EQ(c.angles, 2);
  EXPECT_LT(c.worst, 0.01);
  EXPECT_LT(c.standard_error, 0.002);
}

class RamiFault : public testing::TestWithParam<RamiScene::Fault> {};

TEST_P(RamiFault, PlantedFaultMissesOnePercent) {
  const auto folder = test::truth_file(kFolder);
  if (!folder) GTEST_SKIP() << "reference data not found: " << kFolder;
  const Comparison c = compare(*folder, GetParam(), {-61.0, -3.0}, 1 << 13);
  EXPECT_EQ(c.angles, 2);
  EXPECT_GT(c.worst, 0.01 + 4.0 * c.standard_error);
}

INSTANTIATE_TEST_SUITE_P(Faults, RamiFault,
                         testing::Values(RamiScene::Fault::one_sided, RamiScene::Fault::not_periodic,
                                         RamiScene::Fault::swapped));

}  // namespace
}  // namespace ifov::test_rami
