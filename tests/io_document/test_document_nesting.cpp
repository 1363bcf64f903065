// Prototypes of prototypes in a document, and what must not be.
#include <gtest/gtest.h>

#include <string>

#include "document_maker.h"

namespace ifov::io::test_document_nesting {
namespace {

const std::string kTree =
    R"("tree": [{"sphere": {"center": ["0 m", "0 m", "2 m"], "radius": "1 m"}, "material": "leaf"}])";

TEST(DocumentNesting, PrototypesHoldCopiesOfOthersInAnyOrder) {
  const Document document =
      test::parsed_with(kTree, R"("wood": [{"instances": {"of": "grove", "binary": "groves.ifovinst"}}],
      "grove": [{"instance": {"of": "tree"}}, {"instances": {"of": "tree", "csv": "trees.csv"}}],
      )" + kTree);
  const auto& prototypes = document.scene.prototypes;
  ASSERT_EQ(prototypes.size(), 3u);
  for (const PrototypeDocument& prototype : prototypes) {
    if (prototype.name != "wood") continue;
    const auto& many = std::get<InstancesShape>(prototype.objects.at(0).shape);
    EXPECT_EQ(many.of.name, "grove");
    EXPECT_EQ(many.binary->path, "folder/groves.ifovinst");
  }
}

TEST(DocumentNesting, APrototypeCannotHoldItself) {
  const std::string direct = test::message_with(kTree, R"("tree": [{"instance": {"of": "tree"}}])");
  EXPECT_NE(direct.find("the prototype 'tree' holds itself: 'tree' holds 'tree'"), std::string::npos)
      << direct;
  const std::string round = test::message_with(
      kTree, R"("tree": [{"instance": {"of": "branch"}}], "branch": [{"instance": {"of": "twig"}}],
      "twig": [{"instance": {"of": "branch"}}])");
  EXPECT_NE(round.find("holds itself: "), std::string::npos) << round;
  EXPECT_NE(round.find("'twig' holds 'branch'"), std::string::npos) << round;
  EXPECT_NE(round.find("^"), std::string::npos) << round;
}

TEST(DocumentNesting, UnknownPrototypesAreNamed) {
  const std::string message = test::message_with(kTree, R"("tree": [{"instance": {"of": "leaves"}}])");
  EXPECT_NE(message.find("there is no prototype 'leaves'"), std::string::npos) << message;
}

}  // namespace
}  // namespace ifov::io::test_document_nesting
