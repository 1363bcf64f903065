#include <gtest/gtest.h>

#include <cmath>

#include "render/column_conversions.h"
#include "render/image_info.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/mosaic.h"
#include "sensor/spectrometer/column_responses.h"

namespace ifov::render {
namespace {

TEST(ColumnConversions, ABlackbodyHasItsTemperatureInEveryColumn) {
  const radiometry::Channel channel = radiometry::Channel::gaussian("warm", 10.0, 0.6);
  sensor::ChannelColumns columns;
  for (int i = 0; i < 12; ++i) {
    columns.centre_um.push_back(9.6 + 0.07 * i);
    columns.fwhm_um.push_back(0.6);
  }
  ImageInfo image;
  image.width_px = 12, image.height_px = 1;
  image.channels.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  image.channels[0].brightness = std::make_shared<const sensor::BrightnessScale>(channel);
  image.responses = std::make_shared<const sensor::ColumnResponses>(
      sensor::ColumnResponses::find(std::vector{channel}, std::vector{columns}));
  for (std::size_t k = 0; k < (*image.responses)[0].carried.size(); ++k)
    image.channels[0].toa_of_carried.push_back((*image.responses)[0].carried[k].centre_um);
  double by_channel_alone = 0.0;
  for (int i = 0; i < 12; ++i) {
    const radiometry::Channel own =
        sensor::moved(channel, columns.centre_um[static_cast<std::size_t>(i)], 0.6);
    for (const double kelvin : {150.0, 310.0, 900.0}) {
      const double radiance = radiometry::channel_planck_w_m2_sr_um(own, kelvin);
      EXPECT_NEAR(brightness_kelvin(image, 0, i, radiance), kelvin, 1e-5 * kelvin);
      by_channel_alone =
          std::max(by_channel_alone, std::abs(image.channels[0].brightness->kelvin(radiance) - kelvin));
    }
    // What is straight over the wavelength is so in sums.
    EXPECT_NEAR(toa_irradiance(image, 0, i), own.centre_um, 1e-3);
  }
  EXPECT_GT(by_channel_alone, 1.0);  // the planted fault: one response for all columns
  EXPECT_TRUE(std::isnan(brightness_kelvin(image, 0, 0, 0.0)));
}

TEST(ColumnConversions, PatternsAreToldRowByRow) {
  ImageInfo image;
  for (const char* name : {"red", "green", "blue"}) image.channels.push_back({name, 0.5, 0.1});
  image.mosaic = std::make_shared<const sensor::Mosaic>(sensor::Mosaic{2, 2, {0, 1, 1, 2}});
  EXPECT_EQ(mosaic_pattern(image), "(red, green), (green, blue)");
  EXPECT_EQ(image.mosaic->channel_at(5, 4), 1);
}

}  // namespace
}  // namespace ifov::render
