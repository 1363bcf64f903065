#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "io/document/detector_document.h"
#include "io/library/sensor_presets.h"

namespace ifov::io {
namespace {

std::string message_of(const std::string& line) {
  try {
    parse_sensor_presets("table.txt", "sensor: a\n" + line + "\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SensorPresets, MistakesInTablesAreLocated) {
  const auto says = [](const std::string& line, const std::string& message) {
    const std::string found = message_of(line);
    EXPECT_EQ(found.find("table.txt:2"), 0U) << found;
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  says("optic: {}", "there is no key 'optic'");
  says("about", "expected 'key: value'");
  says("band: b from 1", "expected NAME from|bell UM UM, and snr RATIO RADIANCE, nedt K AT_K or efficiency");
  says("band: b between 1 2", "expected 'bell' or 'from'; found 'between'");
  says("band: b from 1 -2", "'-2' is no number above 0");
  says("band: b from 1 2 net 0.1 300", "expected 'snr' or 'nedt'; found 'net'");
  says("band: b bell 1 2 share 0.5", "expected 'efficiency'; found 'share'");
  says("series: 1 2 3", "expected FROM TO COUNT FWHM");
  says("series: 1 2 1.5 0.1", "'1.5' is no number of channels from 2 on");
  says("series: 2 1 3 0.1", "'1' is not above '2'");
  says("noise: 1 0.1 2", "expected UM RADIANCE, two of them or more");
  says("noise: 2 0.1 1 0.1", "'1' is not above the wavelength before it");
  says("optics: {\"f_number\": }", "JSON:1:");
  EXPECT_EQ(message_of("band: b from 1 2"), "none");
}

TEST(SensorPresets, SeriesHaveThePartOfTheNoiseThatTheyNeed) {
  const auto presets =
      parse_sensor_presets("t",
                           "sensor: a\nground: 2 km\nseries: 1 1.5 3 0.1\nseries: 1.6 2 2 0.1\n"
                           "noise: 0.9 1 1.2 2 1.55 3 1.8 4 3 5\n");
  ASSERT_EQ(presets.size(), 1U);
  EXPECT_EQ(presets[0].channel_count(), 5);
  EXPECT_EQ(presets[0].noise_text(), "NEdL");
  EXPECT_DOUBLE_EQ(presets[0].range_um().first, 0.95);
  EXPECT_DOUBLE_EQ(presets[0].range_um().second, 2.05);
  const std::string text = preset_text(presets[0]);
  EXPECT_NE(text.find(R"("wavelength": ["0.9 um", "1.2 um", "1.55 um"])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("wavelength": ["1.55 um", "1.8 um", "3 um"])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("gsd": "2 km")"), std::string::npos) << text;
}

TEST(SensorPresets, WhatADocumentSaysOfOpticsCountsBefore) {
  OpticsDocument preset, own;
  preset.aperture_m = 0.1, preset.f_number = 4.0, preset.obscuration = 0.3, preset.temperature_k = 290.0;
  own.temperature_k = 280.0;
  OpticsDocument both = preset.under(own);
  EXPECT_EQ(both.aperture_m, 0.1);
  EXPECT_EQ(both.f_number, 4.0);
  EXPECT_EQ(both.obscuration, 0.3);
  EXPECT_EQ(both.temperature_k, 280.0);
  own.focal_length_m = 0.2;  // with the preset's f-number and aperture it would be said three times
  both = preset.under(own);
  EXPECT_FALSE(both.aperture_m.has_value());
  EXPECT_FALSE(both.f_number.has_value());
  EXPECT_EQ(both.focal_length_m, 0.2);
}

}  // namespace
}  // namespace ifov::io
