// What is written reads back as it was, and looks as people like to read it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/json/json_writer.h"

namespace ifov::io::test_json_writer {
namespace {

using Look = JsonWriter::Layout;

std::string one(const auto& value) {
  JsonWriter json(Look::compact);
  json.value(value);
  return json.written();
}

std::string sample(Look look) {
  JsonWriter json(look);
  json.object([&] {
    json.member("name", "a");
    json.member("list", std::vector<int>{1, 2, 3});
    json.member("none", std::vector<int>());
    json.list("rows", [&] {
      json.value(std::vector<double>{0.5, 1.0});
      json.null();
      json.object([] {});
    });
    json.object("inner", [&] { json.member("right", true); });
  });
  return json.written();
}

TEST(JsonWriter, HasTwoLooks) {
  EXPECT_EQ(sample(Look::compact),
            R"({"name":"a","list":[1,2,3],"none":[],"rows":[[0.5,1],null,{}],"inner":{"right":true}})");
  EXPECT_EQ(sample(Look::indented),
            "{\n"
            "  \"name\": \"a\",\n"
            "  \"list\": [1, 2, 3],\n"
            "  \"none\": [],\n"
            "  \"rows\": [\n"
            "    [0.5, 1],\n"
            "    null,\n"
            "    {}\n"
            "  ],\n"
            "  \"inner\": {\n"
            "    \"right\": true\n"
            "  }\n"
            "}\n");
}

TEST(JsonWriter, NumbersAreTheShortestThatReadBack) {
  EXPECT_EQ(one(0.1), "0.1");
  EXPECT_EQ(one(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(one(5e-324), "5e-324");
  EXPECT_EQ(one(9007199254740993.0), "9007199254740992");
  EXPECT_EQ(one(-0.0), "-0.0");
  EXPECT_EQ(one(0.1f), "0.1");
  EXPECT_EQ(one(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(one(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  for (const double value :
       {1e22, 1.7976931348623157e308, 2.2250738585072014e-308, 1.0 / 3.0, -0.0, 1e15, 123456789012345680.0}) {
    const double back = parse_json(one(value), "a.json").root->number();
    EXPECT_EQ(back, value);
    EXPECT_EQ(std::signbit(back), std::signbit(value));
  }
  EXPECT_EQ(one(std::nan("")), "null");
  EXPECT_EQ(one(-HUGE_VAL), "null");
}

TEST(JsonWriter, TextsReadBack) {
  std::string text = "quote \" backslash \\ slash / \xC3\xA9 \xF0\x9F\x98\x80 \x7F";
  for (char c = 0; c < 0x20; ++c) text += c;
  EXPECT_EQ(parse_json(json_string(text), "a.json").root->text(), text);
  EXPECT_EQ(json_string("a\n\t\x01"), "\"a\\n\\t\\u0001\"");
}

TEST(JsonWriter, WritesWhatWasRead) {
  const std::string text = R"({"a":[1,2.5,[],{"b":null}],"c":{"d":"e","f":[true,"g"]}})";
  const DocumentTree tree = parse_json(text, "a.json");
  JsonWriter json(Look::compact);
  json.node(*tree.root);
  EXPECT_EQ(json.written(), text);
  JsonWriter other(Look::indented);
  other.node(*tree.root->find("c"), [](const DocumentNode& node) { return node.key() + "!"; });
  EXPECT_EQ(other.written(), "{\n  \"d\": \"d!\",\n  \"f\": [true, \"!\"]\n}\n");
}

TEST(JsonView, LooksThroughWhatMayBeMissing) {
  const DocumentTree tree = parse_json(R"({"a": {"b": [1, "x"], "n": null}, "yes": true})", "a.json");
  const JsonView root(tree);
  EXPECT_EQ(root["a"]["b"].items()[0].integer(), 1);
  EXPECT_EQ(root["a"]["b"].items()[1].text(), "x");
  EXPECT_TRUE(root["yes"].boolean());
  EXPECT_FALSE(root["a"]["n"].is_there());
  EXPECT_FALSE(root["no"]["way"].is_there());
  EXPECT_EQ(root["no"]["way"].text(), "?");
  EXPECT_EQ(root["a"].text(""), "");
  EXPECT_EQ(root["yes"].number(), 0.0);
  EXPECT_TRUE(root["a"].items().empty());
}

}  // namespace
}  // namespace ifov::io::test_json_writer
