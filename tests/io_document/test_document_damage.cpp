// Damaged documents: whatever the bytes, the answer is a document or a located InputError.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "document_maker.h"

namespace ifov::io::test_document_damage {
namespace {

std::uint64_t hash(std::uint64_t x) {  // the finalizer of SplitMix64
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30u)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27u)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31u);
}

/// One to four edits: a byte changed, removed, doubled, or a piece of the text copied elsewhere.
std::string damaged(std::uint64_t trial) {
  std::string text = test::kDocument;
  const std::uint64_t edits = 1 + hash(trial) % 4;
  for (std::uint64_t e = 0; e < edits; ++e) {
    const std::uint64_t draw = hash(trial * 16 + e + 1);
    const std::size_t at = draw % text.size();
    const std::size_t from = (draw >> 20u) % text.size();
    switch ((draw >> 50u) % 5) {
      case 0: text[at] = static_cast<char>(draw >> 40u); break;
      case 1: text.erase(at, 1 + (draw >> 44u) % 8); break;
      case 2: text.insert(at, 1, text[at]); break;
      case 3: text.insert(at, text.substr(from, (draw >> 44u) % 30)); break;
      default: text[at] = "{}[],:\"0-e/\\"[(draw >> 40u) % 12];
    }
  }
  return text;
}

TEST(DocumentDamage, EndsInADocumentOrALocatedError) {
  int refused = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    const std::string text = damaged(trial);
    try {
      parse_document(text, "a.json");
    } catch (const InputError& error) {
      ++refused;
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("a.json:")) << message;
      EXPECT_GE(error.position().line, 1) << message;
      EXPECT_GE(error.position().column, 1) << message;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_LT(refused, 3000);
}

TEST(DocumentDamage, EveryTruncationIsRefused) {
  const std::size_t end = test::kDocument.find_last_of('}');
  for (std::size_t length = 0; length <= end; length += 3) {
    EXPECT_THROW(parse_document(test::kDocument.substr(0, length), "a.json"), InputError) << length;
  }
}

}  // namespace
}  // namespace ifov::io::test_document_damage
