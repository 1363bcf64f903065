#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "io/photometry/ies.h"

namespace ifov::io::test_ies {
namespace {

const std::string kHead = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] somebody\n";

radiometry::LuminousIntensity read(const std::string& text) { return parse_ies(TextFile("lamp.ies", text)); }

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Ies, IntensitiesWithAllFactors) {
  const auto lamp =
      read(kHead + "TILT=NONE\n1 -1 2 3 2 1 2 0 0 0\n1.5 1 100\n0 45 90\n0 90\n10 20,30\n40 50\n60\n");
  EXPECT_DOUBLE_EQ(lamp.at(0.0, 0.0), 30.0);  // 10 cd x 2 x 1.5
  EXPECT_DOUBLE_EQ(lamp.highest(), 180.0);
}

TEST(Ies, TiltThatIsIncludedIsPassedOver) {
  const auto lamp =
      read("IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n1 1000 1 2 1 1 1 0 0 0\n1 1 100\n0 90\n0\n10 10\n");
  EXPECT_DOUBLE_EQ(lamp.at(0.5, 0.0), 10.0);
}

TEST(Ies, ErrorsSayWhereAndWhatWasExpected) {
  const std::string numbers = "1 -1 1 2 1 1 2 0 0 0\n1 1 100\n0 90\n0\n";
  EXPECT_NE(error_of("nothing\n").find("lamp.ies: found no line 'TILT='"), std::string::npos)
      << error_of("nothing\n");
  std::string text = error_of(kHead + "TILT=NONE\n" + numbers + "10 ten\n");
  EXPECT_NE(text.find("lamp.ies:9:4: found 'ten'; expected an intensity, at least 0 cd"), std::string::npos)
      << text;
  text = error_of(kHead + "TILT=NONE\n" + numbers + "10\n");
  EXPECT_NE(text.find("the file ends here; expected an intensity"), std::string::npos) << text;
  text = error_of(kHead + "TILT=NONE\n1 -1 1 2 1 2 2 0 0 0\n1 1 100\n0 90\n0\n1 1\n");
  EXPECT_NE(text.find("found type B; only type C (1) is read"), std::string::npos) << text;
  text = error_of(kHead + "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 100\n90 0\n0\n1 1\n");
  EXPECT_NE(text.find("vertical angles have to rise"), std::string::npos) << text;
  text = error_of(kHead + "TILT=NONE\n1 -1 1 1e9 1 1 2 0 0 0\n");
  EXPECT_NE(text.find("expected how many vertical angles"), std::string::npos) << text;
}

}  // namespace
}  // namespace ifov::io::test_ies
