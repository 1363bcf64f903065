#include <gtest/gtest.h>

#include <cstdlib>

#include "cluster/launch.h"

namespace ifov::cluster::test_launch {
namespace {

class Launch : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  static void clear() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_NUM_TASKS"})
      unsetenv(name);
  }
};

TEST_F(Launch, AloneWithoutALauncher) { EXPECT_FALSE(is_one_of_several()); }

TEST_F(Launch, AsTheLauncherSays) {
  setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
  setenv("PMIX_RANK", "0", 1);
  EXPECT_FALSE(is_one_of_several());
  setenv("OMPI_COMM_WORLD_SIZE", "8", 1);
  EXPECT_TRUE(is_one_of_several());
  clear();
  setenv("PMI_SIZE", "2", 1);
  EXPECT_TRUE(is_one_of_several());
  clear();
  setenv("PMIX_RANK", "0", 1);
  setenv("SLURM_STEP_NUM_TASKS", "16", 1);
  EXPECT_TRUE(is_one_of_several());
  setenv("SLURM_STEP_NUM_TASKS", "1", 1);
  EXPECT_FALSE(is_one_of_several());
}

}  // namespace
}  // namespace ifov::cluster::test_launch
