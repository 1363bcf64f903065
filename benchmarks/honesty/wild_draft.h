#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/random_stream.h"
#include "honesty/wild_scene.h"

namespace ifov::benchmarks {

inline constexpr double kReach_px = 22.0;  ///< beyond all that the image and its halo see

/// A document in the making: a camera that looks down on a plane, straight or aslant, from afar or from near, light, channels, a PSF and
/// what is asked, all by chance; makers add materials and objects. Lengths of the makers are in pixels.
struct WildDraft {
  enum class Light { solar, thermal };

  WildDraft(RandomStream& random, Light light, std::string name, std::filesystem::path folder);

  RandomStream& random;
  Light regime;
  std::string name;
  std::filesystem::path folder;
  double gsd_m = 1.0;
  int size_px = 16;
  std::array<double, 2> centre_m{};
  double angle_deg = 0.0;
  double view_zenith_deg = 0.0, view_azimuth_deg = 0.0;  ///< from the ground to the sensor
  std::vector<std::string> materials, prototypes, objects;
  std::string light, atmosphere, camera, channels, psf, sampling;
  math::Vec3 towards_sun{0.0, 0.0, 1.0};
  PlainHints hints;

  /// A pinhole camera instead, in the direction of the other and with its GSD in the middle of the image, 0.8 to 20 images away.
  void look_from_near(RandomStream& chance);

  /// A point so many pixels east, north and up of the middle of the image, as documents have it.
  std::string point(double x_px, double y_px, double z_px) const;
  math::Point3 place(double x_px, double y_px, double z_px) const;
  std::string length(double px) const;

  void material(const std::string& what, const std::string& body);
  void grey(const std::string& what, double reflectance);  ///< reflects, emits nothing
  void warm(const std::string& what, double emissivity, double temperature_k);
  /// One that suits the light, reflectances of 0.02 to 0.7 or temperatures of 270 to 330 K.
  void surface(const std::string& what);
  void ground();  ///< a plane at z = 0 of a material of its own
  void box(std::array<double, 3> low_px, std::array<double, 3> high_px, const std::string& what);
  void sphere(std::array<double, 3> centre_px, double radius_px, const std::string& what,
              const char* shape = "sphere");
  void polygon(const std::vector<std::array<double, 3>>& corners_px, const std::string& what);

  /// A length in step with the pixels or their thirds in half of the cases, near `px`.
  double in_step(double px);

  /// Writes a raster of 32-bit floats that GDAL reads by its name (ENVI), band after band from the north-west.
  void raster(const std::string& file, int columns, int rows, const std::vector<float>& values) const;

  std::string text(const std::string& kind) const;
};

}  // namespace ifov::benchmarks
