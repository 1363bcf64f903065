// The low-level parser: the public JSON test suite, positions, limits, and damaged texts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "../support/truth_data.h"
#include "io/json/json_adapter.h"

namespace ifov::io::test_document_json {
namespace {

using Type = DocumentNode::Type;

JsonRules plain_json() {
  JsonRules rules;
  rules.comments = false;
  rules.unique_keys = false;
  rules.max_depth = 600;
  return rules;
}

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string message_of(const std::string& text, const JsonRules& rules = {}) {
  try {
    parse_json(text, "a.json", rules);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DocumentJson, AgreesWithTheJsonTestSuite) {
  const auto archive = test::truth_file("malformed/json-test-parsing.tar.gz");
  if (!archive) GTEST_SKIP() << "reference data not found: malformed/json-test-parsing.tar.gz";
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "ifov_json_suite";
  std::filesystem::create_directories(folder);
  const std::string unpack = "tar -xzf '" + archive->string() + "' -C '" + folder.string() + "'";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  int rejected = 0, accepted = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json") continue;
    const bool accepts = message_of(read_all(entry.path()), plain_json()) == "accepted";
    if (name.starts_with("n_")) {
      EXPECT_FALSE(accepts) << name;
      ++rejected;
    } else if (name.starts_with("y_")) {
      EXPECT_TRUE(accepts) << name;
      ++accepted;
    }
  }
  std::filesystem::remove_all(folder);
  EXPECT_GT(rejected, 150);
  EXPECT_GT(accepted, 80);
}

TEST(DocumentJson, KnowsWhereValuesAndKeysStand) {
  const DocumentTree tree =
      parse_json("// note\n{\"a\": [1, 2.5],\n \"\xC3\xA9\": /* x */ {\"b\" : \"c\"}}", "f.json");
  const DocumentNode& root = *tree.root;
  ASSERT_EQ(root.members().size(), 2u);
  const DocumentNode& list = *root.find("a");
  EXPECT_EQ(list.items()[0].type(), Type::number);
  EXPECT_TRUE(list.items()[0].is_integer());
  EXPECT_EQ(list.items()[1].number(), 2.5);
  EXPECT_FALSE(list.items()[1].is_integer());
  EXPECT_EQ(list.items()[1].path(), "a[1]");
  EXPECT_EQ(list.items()[1].position().line, 2);
  EXPECT_EQ(list.items()[1].position().column, 11);
  EXPECT_EQ(list.key_position().column, 2);
  const DocumentNode& object = *root.find("\xC3\xA9");
  EXPECT_EQ(object.position().line, 3);
  EXPECT_EQ(object.position().column, 15);  // characters, not bytes
  EXPECT_EQ(object.key_position().column, 2);
  EXPECT_EQ(object.find("b")->path(), "\xC3\xA9.b");
}

TEST(DocumentJson, RemembersWhatWasRead) {
  const DocumentTree tree = parse_json("{\"used\": [1], \"idle\": {\"x\": 1}}", "f.json");
  EXPECT_EQ(tree.root->find("used")->items().size(), 1u);
  EXPECT_FALSE(tree.root->members()[1].was_read());
  EXPECT_THROW(reject_unread(*tree.root), InputError);
  EXPECT_NE(tree.root->find("idle")->find("x"), nullptr);
  EXPECT_NO_THROW(reject_unread(*tree.root));
}

TEST(DocumentJson, ReadingAsAnotherTypeIsABug) {
  const DocumentTree tree = parse_json("{\"a\": 1.5}", "f.json");
  EXPECT_THROW(tree.root->find("a")->text(), std::logic_error);
  EXPECT_THROW(tree.root->find("a")->integer(), std::logic_error);
  EXPECT_THROW(tree.root->find("a")->find("b"), std::logic_error);
}

TEST(DocumentJson, BoundsSizesBeforeTakingMemory) {
  JsonRules rules;
  rules.max_bytes = 10;
  EXPECT_EQ(message_of("[1,2,3,4,5,6]", rules),
            "a.json: the document has 13 bytes, more than the 10 allowed");
  rules = {};
  rules.max_values = 4;
  EXPECT_EQ(message_of("[1,2,3,4,5]", rules),
            "a.json:1:8: the document has more than 4 values\n"
            "    1 | [1,2,3,4,5]\n"
            "      |        ^");
  EXPECT_EQ(message_of(std::string(100000, '[')).substr(0, 61),
            "a.json:1:65: lists and objects are nested more than 64 deep\n ");
}

TEST(DocumentJson, SyntaxErrorsSayWhatIsExpected) {
  EXPECT_EQ(
      message_of("{\"a\": 1,}"),
      "a.json:1:9: expected a key in double quotes or '}' (no comma may stand before a closing bracket)\n"
      "    1 | {\"a\": 1,}\n"
      "      |         ^");
  EXPECT_EQ(message_of("{\"a\": 1\n \"b\": 2}"),
            "a.json:2:2: expected ',' or '}' after a value of an object\n"
            "    2 |  \"b\": 2}\n"
            "      |  ^");
  EXPECT_EQ(message_of("[1 2]"),
            "a.json:1:4: expected ',' or ']' after a value of a list\n"
            "    1 | [1 2]\n"
            "      |    ^");
  EXPECT_EQ(message_of("{\"a\" 1}"),
            "a.json:1:6: expected ':' after the key\n"
            "    1 | {\"a\" 1}\n"
            "      |      ^");
  EXPECT_EQ(message_of("[1,]"),
            "a.json:1:4: expected a value (no comma may stand before a closing bracket)\n"
            "    1 | [1,]\n"
            "      |    ^");
  EXPECT_EQ(message_of("{} {}"),
            "a.json:1:4: expected nothing more after the end of the document\n"
            "    1 | {} {}\n"
            "      |    ^");
  EXPECT_EQ(message_of("{\"a\": 1, \"a\": 2}"),
            "a.json:1:10: the key 'a' is given twice\n"
            "    1 | {\"a\": 1, \"a\": 2}\n"
            "      |          ^");
  EXPECT_EQ(message_of("{\"a\": 1 m}"),
            "a.json:1:9: unexpected 'm'; texts and keys stand in double quotes: \"...\"\n"
            "    1 | {\"a\": 1 m}\n"
            "      |         ^");
  EXPECT_EQ(message_of("{\"a\": 1m}"),
            "a.json:1:7: this is not a number as JSON writes it; a value with a unit is a text: \"1.5 m\"\n"
            "    1 | {\"a\": 1m}\n"
            "      |       ^");
  EXPECT_EQ(message_of("{'a': 1}"),
            "a.json:1:2: texts and keys stand in double quotes: \"...\"\n"
            "    1 | {'a': 1}\n"
            "      |  ^");
  EXPECT_EQ(message_of("{\"a\": \"b\n}"),
            "a.json:1:7: this text does not end on its line: '\"' is missing\n"
            "    1 | {\"a\": \"b\n"
            "      |       ^");
  EXPECT_EQ(message_of("{} /* no end"),
            "a.json:1:4: this comment does not end: '*/' is missing\n"
            "    1 | {} /* no end\n"
            "      |    ^");
  EXPECT_EQ(message_of("[1e400]").substr(0, 11), "a.json:1:2:");
  EXPECT_EQ(message_of("[\"\\ud800\"]"),
            "a.json:1:3: half of a surrogate pair; both halves must be written\n"
            "    1 | [\"\\ud800\"]\n"
            "      |   ^");
}

TEST(DocumentJson, TheFirstMistakeCounts) {
  EXPECT_EQ(message_of("{\"a\": 1 \"b\": 01, 'c'").substr(0, 55),
            "a.json:1:9: expected ',' or '}' after a value of an obj");
  EXPECT_EQ(message_of("[1, -]").substr(0, 46), "a.json:1:5: this is not a number as JSON write");
  EXPECT_EQ(message_of("[true, nul, 1m]").substr(0, 29), "a.json:1:8: unexpected 'nul';");
  EXPECT_EQ(message_of("{\"b\": 1, \"a\": 1, \"b\": 2, \"a\": 2}").substr(0, 41),
            "a.json:1:18: the key 'b' is given twice\n ");
  EXPECT_EQ(message_of("{\"a\": 1, // \"\n /* , */ \"b\" 2}").substr(0, 37),
            "a.json:2:14: expected ':' after the k");
}

TEST(DocumentJson, ANulIsACharacterAsOthers) {
  using namespace std::string_literals;
  EXPECT_EQ(message_of("// \0\n[/* \0 */]"s), "accepted");
  EXPECT_EQ(message_of("[]\0[]"s).substr(0, 32), "a.json:1:3: unexpected character");
  EXPECT_EQ(message_of("[\"a\0\"]"s).substr(0, 34), "a.json:1:4: a control character wi");
}

TEST(DocumentJson, HalvesOfSurrogatePairsAreNoCharacters) {
  for (const char* const text : {"\"\\udc00\"", "\"\\uDfFf\"", "\"\\ud83dx\"", "\"\\ud83d\\u0041\""})
    EXPECT_EQ(message_of(text).substr(0, 40), "a.json:1:2: half of a surrogate pair; bo") << text;
  EXPECT_EQ(message_of("\"\\ud83d\\ude00\\\\udc00 \\n\\ude00\"").substr(0, 30),
            "a.json:1:24: half of a surroga");
  EXPECT_EQ(parse_json("\"\\ud7ff\\ue000\\ud83d\\ude00\"", "a.json").root->text(),
            "\xED\x9F\xBF\xEE\x80\x80\xF0\x9F\x98\x80");
}

TEST(DocumentJson, NumbersAreTakenAsWritten) {
  const DocumentTree tree = parse_json(
      "[9223372036854775807, 9223372036854775808, -9223372036854775808, 9007199254740993.0, -0, -0.0, 1e-400, 4.9e-324, 1.0]",
      "a.json");
  const auto& items = tree.root->items();
  EXPECT_EQ(items[0].integer(), INT64_MAX);
  EXPECT_FALSE(items[1].is_integer());
  EXPECT_EQ(items[1].number(), 0x1p63);
  EXPECT_EQ(items[2].integer(), INT64_MIN);
  EXPECT_EQ(items[3].number(), 9007199254740992.0);
  EXPECT_TRUE(items[4].is_integer());
  EXPECT_TRUE(std::signbit(items[5].number()));
  EXPECT_EQ(items[6].number(), 0.0);
  EXPECT_EQ(items[7].number(), 5e-324);
  EXPECT_FALSE(items[8].is_integer());
  for (const char* const text : {"1e309", "-1e309", "1e99999999999999999999"})
    EXPECT_EQ(message_of(text).substr(0, 35), "a.json:1:1: this number is too larg") << text;
}

TEST(DocumentJson, ATextCutShortSaysWhatWasOpen) {
  EXPECT_EQ(
      message_of("{\"a\": [1, {\"b\": 2,\n  \"c\": \n"),
      "a.json:2:7: the file ends here, within the object 'a[1]' that begins at 1:11; still to close: }]}\n"
      "    2 |   \"c\": \n"
      "      |       ^");
  EXPECT_EQ(message_of("{\"a\": [1, -"),
            "a.json:1:12: the file ends here, within a value that begins at 1:11 in the list 'a' that begins "
            "at 1:7; "
            "still to close: ]}\n"
            "    1 | {\"a\": [1, -\n"
            "      |            ^");
  EXPECT_EQ(message_of("\"abc"),
            "a.json:1:5: the file ends here, within a text that begins at 1:1; still to close: \"\n"
            "    1 | \"abc\n"
            "      |     ^");
  // A mistake before the end counts first.
  EXPECT_EQ(message_of("{\"a\": [1 2, {").substr(0, 62),
            "a.json:1:10: expected ',' or ']' after a value of a list\n    1");
  const std::string whole =
      R"({"a": [true, false, null, -1.5e-3, {"ä€😀": "\u00e4\ud83d\ude00\n"}], "b": {}, "c": []})";
  ASSERT_EQ(message_of(whole), "accepted");
  for (std::size_t length = 1; length < whole.size(); ++length)
    EXPECT_NE(message_of(whole.substr(0, length)).find("the file ends here, within"), std::string::npos)
        << whole.substr(0, length);
  EXPECT_EQ(message_of("// \xC3").substr(0, 38), "a.json:1:4: the text is not UTF-8 here");
}

TEST(DocumentJson, ExcerptsShowTheWindowAboutTheCaret) {
  const std::string message = message_of("{" + std::string(300, ' ') + "x" + std::string(300, ' ') + "}");
  const std::size_t line = message.find('\n') + 1;
  const std::size_t caret_line = message.find('\n', line) + 1;
  const std::string excerpt = message.substr(line, caret_line - line - 1);
  const std::size_t caret = message.size() - 1 - caret_line;
  EXPECT_LE(excerpt.size(), 120u);
  EXPECT_EQ(excerpt[caret], 'x');
  EXPECT_EQ(message.back(), '^');
  EXPECT_TRUE(excerpt.ends_with("..."));
}

TEST(DocumentJson, ExcerptsReplaceWhatCannotBePrinted) {
  EXPECT_EQ(message_of("[\t\"\x01\"]"),
            "a.json:1:4: a control character within a text; write it as \\t or \\u00XX\n"
            "    1 | [ \" \"]\n"
            "      |    ^");
  EXPECT_EQ(message_of("[\"\xFF\"]"),
            "a.json:1:3: the text is not UTF-8 here\n"
            "    1 | [\"?\"]\n"
            "      |   ^");
}

}  // namespace
}  // namespace ifov::io::test_document_json
