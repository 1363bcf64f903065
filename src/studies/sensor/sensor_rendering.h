#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "math/vec3.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct CameraDocument;
struct Document;
struct ObjectDocument;
struct PlatformDocument;
}  // namespace ifov::io

namespace ifov::studies {

/// An image of one channel, row by row, as a run would write it.
struct SensorImage {
  int width = 0, height = 0;
  std::vector<double> radiance, half_width;  ///< W m-2 sr-1 um-1
  std::uint64_t samples = 0;
  double at(int x_px, int y_px) const {
    return radiance[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x_px)];
  }
};
/// Rendered as any other document; files that it names are in the study's folder.
SensorImage render_sensor(const io::Document& document, const StudyOptions& options);

/// Runs a document as `ifov render` does, into a folder of this name in the study's, which is made anew. Where its products are.
std::filesystem::path run_sensor(const io::Document& document, const std::string& name,
                                 const StudyOptions& options);
/// Values of a cube among products, as float: [line][sample][band].
struct CubeValues {
  int width = 0, height = 0, bands = 0;
  std::vector<float> values;
  double at(int x_px, int y_px, int band) const {
    return static_cast<double>(values[(static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width) +
                                       static_cast<std::size_t>(x_px)) *
                                          static_cast<std::size_t>(bands) +
                                      static_cast<std::size_t>(band)]);
  }
};
CubeValues read_product(const std::filesystem::path& folder, const std::string& quantity);
/// Draws the noise of so many seeds, from that of the study on, on a run's radiance into another folder; the cubes.
std::vector<std::filesystem::path> draw_noise(const std::filesystem::path& run,
                                              const std::filesystem::path& folder, int seeds, int threads,
                                              const StudyOptions& options);
/// Level ground at height 0 without end, of this material.
io::ObjectDocument level_ground(const std::string& material);
/// Asks for these products, by their words.
void ask_for(io::Document& document, std::initializer_list<const char*> products);

/// A camera at a height above (0, 0), level, north up.
io::CameraDocument frame_above(int width_px, int height_px, double height_m, double focal_length_m,
                               double pitch_m, double exposure_s = 0.0, double row_period_s = 0.0);
/// Has the object move straight on from there, at 0 s; it does not turn.
void carry(io::ObjectDocument& object, math::Point3 at_m, math::Vec3 velocity_m_s);

/// A camera that looks at (0, 0) from anywhere, north up.
io::CameraDocument frame_looking(int pixels, math::Point3 from_m, double focal_length_m, double pitch_m);

/// A line scanner over (0, 0) at 0 s, flying north, a line every 10 ms; of itself 5 km up, with pixels of 0.5 m.
struct ScannerFlight {
  int width_px = 24, lines = 32;
  double speed_m_s = 50.0;
  double element_length_px = 0.0;  ///< along the track, in pitches
  int stages = 1;
  double roll_rad = 0.0;               ///< amplitude
  double height_m = 5e3, step = 1e-4;  ///< pitch over focal length
  static constexpr double kPeriod_s = 0.01, kRollPeriod_s = 0.11;
  double roll_at(double time_s) const;
  /// Where the point (x, y) of the image looks, on level ground: west and north, metres. Its left wing is in the west, where x grows to;
  /// a right wing that is down turns the belly to the left.
  std::array<double, 2> ground_m(double x_px, double y_px) const;
  /// The other way: the image of a point above the ground.
  std::array<double, 2> image_px(math::Point3 point_m) const;
};
/// Gives the document this flight's platform and camera; a path with its rolling is written beside the study's files.
void fly(const ScannerFlight& flight, io::Document& document, const StudyOptions& options);

}  // namespace ifov::studies
