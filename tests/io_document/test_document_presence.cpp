// When objects are there: as it is read and written, and its messages.
#include <gtest/gtest.h>

#include "core/format.h"
#include "document_maker.h"
#include "io/document/document.h"
#include "io/document/presence_document.h"

namespace ifov::io::test_document_presence {
namespace {

const std::string kBall = "\"name\": \"ball\",";

std::string with_present(const std::string& present) { return kBall + " \"present\": " + present + ","; }

std::string message(const std::string& present) { return test::message_with(kBall, with_present(present)); }

TEST(DocumentPresence, IsReadInOrderAndWritten) {
  const Document document = parse_document(
      test::document_with(
          kBall,
          with_present(
              R"([["2026-06-21T12:00+02:00", "2026-06-21T17:30:00.5Z"], ["2026-06-20", "2026-06-20T08:30Z"]])")),
      "a.json");
  const PresenceDocument& present = *document.scene.objects[1].present;
  ASSERT_EQ(present.intervals.size(), 2u);
  EXPECT_EQ(geodesy::format_utc(present.intervals[0].end), "2026-06-20T08:30:00.000Z");
  EXPECT_EQ(geodesy::format_utc(present.intervals[1].begin), "2026-06-21T10:00:00.000Z");
  EXPECT_FALSE(document.scene.objects[0].present);
  const Document again = parse_document(document_text(document, "a.json"), "a.json");
  EXPECT_EQ(geodesy::format_utc(again.scene.objects[1].present->intervals[1].end),
            "2026-06-21T17:30:00.500Z");
}

TEST(DocumentPresence, Messages) {
  EXPECT_NE(
      message(R"([["2026-06-21T12:00", "2026-06-21T17:00Z"]])")
          .find(
              "a.json:18:38: 'scene.objects[1].present[0][0]': found the time '2026-06-21T12:00'; expected ISO 8601 with a "
              "zone"),
      std::string::npos)
      << message(R"([["2026-06-21T12:00", "2026-06-21T17:00Z"]])");
  EXPECT_NE(
      message(R"([["2026-06-21T12:00Z", "2026-06-21T11:00Z"]])")
          .find(
              "'scene.objects[1].present[0]' ends at 2026-06-21T11:00:00.000Z, which is not after it begins, "
              "2026-06-21T12:00:00.000Z"),
      std::string::npos)
      << message(R"([["2026-06-21T12:00Z", "2026-06-21T11:00Z"]])");
  const std::string overlap =
      message(R"([["2026-06-21T12:00Z", "2026-06-21T17:00Z"], ["2026-06-21T16:00Z", "2026-06-21T18:00Z"]])");
  EXPECT_NE(
      overlap.find(
          "'scene.objects[1].present[1]', 2026-06-21T16:00:00.000Z to 2026-06-21T18:00:00.000Z, overlaps "
          "another interval, 2026-06-21T12:00:00.000Z to 2026-06-21T17:00:00.000Z: join them"),
      std::string::npos)
      << overlap;
  EXPECT_NE(overlap.find("a.json:18:"), std::string::npos) << overlap;  // where it is written
  EXPECT_NE(message("[]").find("'scene.objects[1].present'"), std::string::npos) << message("[]");
  // Intervals that touch are no mistake.
  EXPECT_NO_THROW(
      parse_document(test::document_with(kBall, with_present(R"([["2026-06-21T12:00Z", "2026-06-21T13:00Z"],
                                                 ["2026-06-21T13:00Z", "2026-06-21T14:00Z"]])")),
                     "a.json"));
}

TEST(DocumentPresence, NeedsATimeAndNoPrototype) {
  std::string text =
      test::document_with(kBall, with_present(R"([["2026-06-21T12:00Z", "2026-06-21T17:00Z"]])"));
  const std::string time = "\"time\": \"2026-06-21T17:00:00Z\",";
  text.replace(text.find(time), time.size(), "");
  const auto fault = [](const std::string& document) -> std::string {
    try {
      parse_document(document, "a.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(fault(text).find("what is there for a time only needs the document's 'time'"), std::string::npos)
      << fault(text);
  const std::string leaf = "\"radius\": \"1 m\"}, \"material\": \"leaf\"";
  const std::string part =
      test::document_with(leaf, leaf + R"(, "present": [["2026-06-21T12:00Z", "2026-06-21T17:00Z"]])");
  EXPECT_NE(
      fault(part).find("a part of a prototype cannot have times of its own; give 'present' to the copies"),
      std::string::npos)
      << fault(part);
}

}  // namespace
}  // namespace ifov::io::test_document_presence
