#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "io/document/cameras/camera_settings.h"

namespace ifov::io {

template <class V>
struct SchemaType;

/// A kind of camera, by its key in sensor.camera.
struct CameraModel {
  std::string_view key;   ///< "frame"
  std::string_view what;  ///< for the reference page: "a perspective camera"
  /// The table of its keys.
  SchemaType<std::shared_ptr<const CameraSettings>> (*type)() = nullptr;
};

/// Settings of any kind read as such.
template <class Settings, class Base = CameraSettings>
SchemaType<std::shared_ptr<const Base>> settings_type(const SchemaType<Settings>& type) {
  return converted<std::shared_ptr<const Base>>(
      type, [](Settings settings) { return std::make_shared<const Settings>(std::move(settings)); },
      [](const std::shared_ptr<const Base>& settings) {
        const auto* own = dynamic_cast<const Settings*>(settings.get());
        return own != nullptr ? std::optional(*own) : std::nullopt;
      });
}

/// All kinds, in the order of the reference page.
std::span<const CameraModel* const> camera_models();

}  // namespace ifov::io
