#include <gtest/gtest.h>

#include <random>
#include <set>

#include "session/runs/probing.h"

namespace ifov::session::test_probing {
namespace {

/// What a probe of `pieces` of 1,000 pieces foretells, where each needs some chunks out of `needed` of 2,000.
double foretold(int pieces, int needed, int per_piece, unsigned seed = 5) {
  std::set<int> made;
  Probing probing(
      {.columns = 50, .rows = 20, .pixels = 16000.0, .surroundings = 1.0}, [&] { return made.size(); },
      nullptr);
  std::mt19937 random(seed);
  sampling::TileResult tile;
  tile.reset({0, 0, 4, 4}, 1, false);
  for (int k = 0; k < pieces; ++k) {
    EXPECT_TRUE(probing.next().has_value());
    for (int n = 0; n < per_piece; ++n)
      made.insert(static_cast<int>(random() % static_cast<unsigned>(needed)));
    probing.write(tile);
  }
  return probing.chunks(2000);
}

TEST(Probing, ForetellsChunksThatItHasNotMet) {
  double half = 0.0, most = 0.0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    half += foretold(30, 400, 10, seed);  // meets half of them
    const double found = foretold(60, 400, 10, seed);
    EXPECT_GT(found, 400.0 / 1.5);
    EXPECT_LT(found, 400.0 * 1.5);
    most += found;
  }
  EXPECT_NEAR(half / 100, 400.0, 40.0);
  EXPECT_NEAR(most / 100, 400.0, 12.0);
  EXPECT_NEAR(foretold(100, 400, 10), 400.0, 10.0);  // nearly all
  EXPECT_NEAR(foretold(100, 1, 1), 1.0, 1e-9);       // one large chunk
  EXPECT_GT(foretold(8, 1000000, 20), 1000.0);       // each piece meets others
}

}  // namespace
}  // namespace ifov::session::test_probing
