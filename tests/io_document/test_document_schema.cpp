#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "io/document/document.h"
#include "io/document/reading/record_walk.h"
#include "io/json/json_adapter.h"

namespace ifov::io::test_document_schema {
namespace {

TEST(DocumentSchema, ReferencePageIsTheOneThatTheTablesGive) {
  std::ifstream file(IFOV_SOURCE_DIR "/docs/formats/document.md");
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_TRUE(page == schema_markdown()) << "run: ifov schema --markdown > docs/formats/document.md";
}

TEST(DocumentSchema, IsJsonWithEveryRecord) {
  JsonRules rules;
  rules.comments = false;
  const DocumentTree tree = parse_json(schema_json(), "schema.json", rules);
  EXPECT_EQ(tree.root->find("$schema")->text(), "http://json-schema.org/draft-07/schema#");
  const auto records = records_within(document_description());
  EXPECT_EQ(tree.root->find("definitions")->members().size(), records.size());
  EXPECT_GT(records.size(), 50u);
}

TEST(DocumentSchema, EveryKeyIsExplained) {
  for (const ValueDescription* record : records_within(document_description())) {
    EXPECT_FALSE(record->doc.empty()) << record->name;
    for (const FieldDescription& field : record->fields) {
      EXPECT_FALSE(field.doc.empty()) << record->name << '.' << field.key;
      EXPECT_FALSE(field.value->expected.empty()) << record->name << '.' << field.key;
      EXPECT_FALSE(field.value->short_name.empty()) << record->name << '.' << field.key;
    }
  }
}

}  // namespace
}  // namespace ifov::io::test_document_schema
