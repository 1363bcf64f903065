#include <gtest/gtest.h>

#include <vector>

#include "core/names.h"

namespace ifov::test_names {
namespace {

const std::vector<std::string> kShapes{"plane", "box", "sphere", "hemisphere", "cylinder", "disk"};

TEST(Names, EditDistanceCountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("center", "centre"), 1);
  EXPECT_EQ(edit_distance("Radius", "radius"), 0);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // optimal string alignment: no edit within a swap
}

TEST(Names, NearestNameForgivesOneEditInThreeLetters) {
  EXPECT_EQ(nearest_name("spehre", kShapes), "sphere");
  EXPECT_EQ(nearest_name("hemishere", kShapes), "hemisphere");
  EXPECT_EQ(nearest_name("planes", kShapes), "plane");
  EXPECT_EQ(nearest_name("BOX", kShapes), "box");
}

TEST(Names, NearestNameOffersNothingFarFetched) {
  EXPECT_EQ(nearest_name("torus", kShapes), "");
  EXPECT_EQ(nearest_name("", kShapes), "");
  EXPECT_EQ(nearest_name("xyz", kShapes), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), kShapes), "");
  const std::vector<std::string> one_letter{"m"};
  EXPECT_EQ(nearest_name("z", one_letter), "");
}

TEST(Names, DidYouMeanIsReadyForAMessage) {
  EXPECT_EQ(did_you_mean("cilinder", kShapes), "; did you mean 'cylinder'?");
  EXPECT_EQ(did_you_mean("torus", kShapes), "");
}

TEST(Names, ListsNamesAsASentence) {
  EXPECT_EQ(list_names({}), "");
  EXPECT_EQ(list_names(std::vector<std::string>{"a"}), "'a'");
  EXPECT_EQ(list_names(std::vector<std::string>{"a", "b", "c"}), "'a', 'b' or 'c'");
  EXPECT_EQ(list_names(std::vector<std::string>{"a", "b"}, "and"), "'a' and 'b'");
  EXPECT_EQ(list_names(kShapes, "or", 2), "'plane', 'box' and 4 more");
}

}  // namespace
}  // namespace ifov::test_names
