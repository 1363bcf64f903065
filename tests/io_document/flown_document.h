#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>

#include "document_maker.h"
#include "io/document/cameras/camera_settings.h"
#include "sensor/camera.h"

namespace ifov::io::test_platform {

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline const std::string kStraight =
    R"({"straight": {"frame": "scene", "position": ["0 m", "-10 m", "1 km"], "velocity": ["0 m/s", "50 m/s", "0 m/s"]}})";
inline const std::string kPushbroom =
    R"({"pushbroom": {"pixels": [21, 20], "field_of_view": "1 deg", "line_period": "20 ms"}})";

/// Documents of platforms, in a folder of their own.
class FlownDocument : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() /
        ("ifov_platforms_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  /// A document of a plane and a scanner; `more` are members beside the origin.
  std::string text(const std::string& platform, const std::string& camera = kPushbroom,
                   const std::string& origin = R"({"latitude": "52 deg", "longitude": "4.4 deg"})",
                   const std::string& time = R"("time": "2026-06-21T11:00:00Z",)") const {
    return "{\"ifov\": 1, " + time + "\n\"scene\": {\"origin\": " + origin +
           ",\n\"materials\": {\"a\": {\"reflectance\": 0.2}}, \"objects\": [{\"plane\": {}, \"material\": \"a\"}]},\n" +
           (platform.empty() ? std::string() : "\"platform\": " + platform + ",\n") +
           "\"sensor\": {\"camera\": " + camera +
           ",\n\"channels\": [{\"monochromatic\": {\"at\": \"0.6 um\"}}]}}";
  }

  Document document(const std::string& text) const {
    return parse_document(text, (folder_ / "a.json").string());
  }
  std::unique_ptr<sensor::Camera> camera(const Document& document) const {
    return document.sensor.camera.settings->build({document.scene.origin.offset_m, 0.0});
  }

  /// The first line of what is said, without the folder.
  std::string message(const std::string& text) const {
    try {
      camera(document(text));
    } catch (const InputError& error) {
      std::string what = error.what();
      what = what.substr(0, what.find('\n'));
      for (std::size_t at = 0; (at = what.find(folder_.string() + "/")) != std::string::npos;)
        what.erase(at, folder_.string().size() + 1);
      return what;
    }
    return "taken";
  }

  std::filesystem::path folder_;
};

inline math::Point3 on_ground(const math::Ray& ray) {
  return ray.origin_m + ray.direction * (ray.origin_m.z / -ray.direction.z);
}

}  // namespace ifov::io::test_platform
