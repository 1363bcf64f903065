#include "render/image_info.h"

namespace ifov::render {
namespace {

constexpr const char* kNumbers = "intervals hold the error of the air's numbers, not of its model";
constexpr const char* kNumbersAndModel = "intervals hold the error of the air's numbers and of its model";
constexpr const char* kUnderClouds =
    ", of clouds that of their particles: how far level clouds are from real ones is not known";
constexpr const char* kOfBands =
    ", which takes spectra behind the gas model for as wrong as the built-in bands";

}  // namespace

AirInIntervals air_in_intervals(const ImageInfo& image) {
  if (image.channels.empty() || !image.channels.front().air) return AirInIntervals::none;
  return image.channels.front().air->model_counted > 0.0 ? AirInIntervals::numbers_and_model
                                                         : AirInIntervals::numbers;
}

AirInIntervals air_in_intervals(const std::string& sentence) {
  return sentence.starts_with(kNumbersAndModel) ? AirInIntervals::numbers_and_model
         : sentence == kNumbers                 ? AirInIntervals::numbers
                                                : AirInIntervals::none;
}

std::string what_intervals_hold(const ImageInfo& image) {
  switch (air_in_intervals(image)) {
    case AirInIntervals::none: break;
    case AirInIntervals::numbers: return kNumbers;
    case AirInIntervals::numbers_and_model: {
      const AtmosphereHalfWidth& air = *image.channels.front().air;
      return std::string(kNumbersAndModel) + (air.model_under_clouds > 0.0 ? kUnderClouds : "") +
             (air.model_of_bands > 0.0 ? kOfBands : "");
    }
  }
  return {};
}

}  // namespace ifov::render
