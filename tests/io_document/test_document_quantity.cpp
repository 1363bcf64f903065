#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "io/document/schema/quantity.h"

namespace ifov::io::test_document_quantity {
namespace {

double in_si(const Dimension& dimension, std::string_view text) {
  const auto parts = split_quantity(text);
  if (!parts) return std::numeric_limits<double>::quiet_NaN();
  const Unit* unit = dimension.find(parts->unit);
  return unit == nullptr ? std::numeric_limits<double>::infinity()
                         : parts->number * unit->factor + unit->offset;
}

TEST(DocumentQuantity, Splits) {
  const auto parts = split_quantity("  -1.5e3 W m-2 sr-1 um-1 ");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->number, -1500.0);
  EXPECT_EQ(parts->unit, "W m-2 sr-1 um-1");
  EXPECT_EQ(split_quantity("2%")->unit, "%");
  EXPECT_EQ(split_quantity("+.5 m")->number, 0.5);
  EXPECT_EQ(split_quantity("5. m")->number, 5.0);
  EXPECT_EQ(split_quantity("7")->unit, "");
}

TEST(DocumentQuantity, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "m", "- 1 m", "+-1 m", "--1 m", "nan m", "inf m", "1e999 m", ".m", "e5 m"}) {
    EXPECT_FALSE(split_quantity(text)) << text;
  }
}

TEST(DocumentQuantity, Converts) {
  EXPECT_NEAR(in_si(kTemperature, "20 degC"), 293.15, 1e-12);
  EXPECT_NEAR(in_si(kTemperature, "212 degF"), 373.15, 1e-12);
  EXPECT_NEAR(in_si(kTemperature, "-40 degF"), 233.15, 1e-12);
  EXPECT_NEAR(in_si(kWavelength, "550 nm"), 0.55, 1e-15);
  EXPECT_EQ(in_si(kWavelength, "8.5 \u00B5m"), 8.5);
  EXPECT_EQ(in_si(kWavelength, "8.5 \u03BCm"), 8.5);
  EXPECT_NEAR(in_si(kAngle, "180 deg"), 3.14159265358979, 1e-14);
  EXPECT_EQ(in_si(kLength, "1 ft"), 0.3048);
  // 1 microflick: 1e-6 W / (1e-4 m2 sr 1e-3 um) = 10 W m-2 sr-1 um-1.
  EXPECT_NEAR(in_si(kRadiance, "1 uW cm-2 sr-1 nm-1"), 1e-6 / (1e-4 * 1e-3), 1e-12);
  EXPECT_EQ(in_si(kRadiance, "1 mW m-2 sr-1 nm-1"), 1.0);
  EXPECT_EQ(in_si(kRadiance, "1 W/m2/sr/um"), in_si(kRadiance, "1 W m^-2 sr^-1 um^-1"));
}

TEST(DocumentQuantity, PatternsAgreeWithTheReader) {
  const std::regex any(quantity_pattern(kLength, Sign::any));
  const std::regex positive(quantity_pattern(kLength, Sign::positive));
  const std::regex not_negative(quantity_pattern(kLength, Sign::not_negative));
  const auto readable = [](const std::string& text) {
    const auto parts = split_quantity(text);
    return parts && kLength.find(parts->unit) != nullptr;
  };
  for (const std::string text : {"1 m",    "1m",      " 1 km ", "-1 m",  "+1 m",   ".5 m",  "5. m",
                                 "1e-3 m", "1E+3 um", "0 m",    "0.0 m", "0e5 m",  "- 1 m", "1",
                                 "m",      "1 meter", "1 m m",  "1,5 m", "0x10 m", "1e m",  "1.2.3 m"}) {
    EXPECT_EQ(std::regex_match(text, any), readable(text)) << text;
    const auto parts = split_quantity(text);
    EXPECT_EQ(std::regex_match(text, positive), readable(text) && parts->number > 0.0) << text;
    const bool signless = text.find('-') != 0;
    EXPECT_EQ(std::regex_match(text, not_negative), readable(text) && signless) << text;
  }
}

TEST(DocumentQuantity, EveryUnitIsMatchedByItsPattern) {
  for (const Dimension* dimension :
       {&kLength, &kWavelength, &kAngle, &kTemperature, &kTemperatureDifference, &kSunDistance, &kPixels,
        &kPercent, &kReflectance, &kRadiance, &kIrradiance, &kDuration, &kFrequency, &kElectrons,
        &kDarkCurrent, &kGain}) {
    const std::regex pattern(quantity_pattern(*dimension, Sign::any));
    for (const Unit& unit : dimension->units) {
      const std::string text = "1.5 " + std::string(unit.spelling);
      EXPECT_TRUE(std::regex_match(text, pattern)) << text;
      EXPECT_TRUE(std::isfinite(in_si(*dimension, text))) << text;
    }
    EXPECT_TRUE(std::regex_match(std::string(dimension->example), pattern)) << dimension->example;
  }
}

}  // namespace
}  // namespace ifov::io::test_document_quantity
