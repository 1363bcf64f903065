#include <gtest/gtest.h>

#include "core/printable.h"

namespace ifov::test_printable {
namespace {

TEST(Printable, LeavesTextAlone) {
  EXPECT_EQ(printable("12 µm, 295 K\n\tline two: 山 \xF0\x9F\x8C\xB2"),
            "12 µm, 295 K\n\tline two: 山 \xF0\x9F\x8C\xB2");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, WritesControlCharactersOut) {
  EXPECT_EQ(printable("\x1b[2Jclean"), "\\x1b[2Jclean");
  EXPECT_EQ(printable("a\rb\bc\x07\x7f"), "a\\x0db\\x08c\\x07\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "\\x9b2J");  // the one-character form of ESC [
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, WritesOutWhatTurnsOrHidesText) {
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b"),
            "a\\u202eb");
  EXPECT_EQ(printable("a\xE2\x80\x8B"
                      "b\xEF\xBB\xBF"),
            "a\\u200bb\\ufeff");
  EXPECT_EQ(printable("\xE2\x81\xA6\xF3\xA0\x80\xA1"), "\\u2066\\ue0021");
}

TEST(Printable, WritesOutBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("a\xFF"
                      "b\xC3"),
            "a\\xffb\\xc3");
  EXPECT_EQ(printable("\xC0\x9B"), "\\xc0\\x9b");           // an escape character by two bytes too many
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");  // half of a pair of UTF-16
}

TEST(Printable, CutsLongMessages) {
  const std::string shown = printable_message(std::string(100000, 'x'));
  EXPECT_EQ(shown, std::string(8192, 'x') + "…");
  EXPECT_EQ(printable_message(std::string(8192, 'x')), std::string(8192, 'x'));
  EXPECT_EQ(printable("µµµ", 3), "µµ…");
}

}  // namespace
}  // namespace ifov::test_printable
