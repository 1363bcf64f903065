#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/document/sensor_document.h"
#include "math/vec3.h"

namespace ifov::sensor {
class Camera;
struct ReadOut;
}  // namespace ifov::sensor

namespace ifov::io {

struct PlatformFlight;
struct FocalPlane;
struct SensitiveSide;

/// Where the scene is that a camera looks at.
struct CameraSite {
  math::Vec3 offset_m;                                 ///< of coordinates in the document; to be subtracted
  double highest_m = 0.0;                              ///< z of the highest surface, scene frame
  double lowest_m = 0.0;                               ///< of the lowest
  std::uint64_t seed = 1;                              ///< of what is drawn by chance
  std::optional<std::array<double, 2>> period_m = {};  ///< after which the scene repeats along x and y
  const class SceneMaps* maps = nullptr;               ///< that paths may lie on; null: none
};

/// What a document says of a camera, and what is asked of it. Never changed; changes are copies.
class CameraSettings {
 public:
  virtual ~CameraSettings() = default;

  /// Throws InputError for settings that make no camera.
  virtual std::unique_ptr<sensor::Camera> build(const CameraSite& site) const = 0;

  /// For descriptions: "frame, 64 x 48 pixels, ..." Positions are said shifted, behind the name of their `axes`.
  virtual std::string description(math::Vec3 shift_m, std::string_view axes) const = 0;

  /// The same field of view in fewer pixels, at most so many along each side.
  virtual std::shared_ptr<const CameraSettings> shrunk(int longest_px) const = 0;

  /// The same camera with its optical axis from another direction: angles of the direction from the scene to the
  /// sensor, azimuth clockwise from north.
  virtual std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const = 0;

  /// z at which rays start, as the document says it; none where it does not.
  virtual std::optional<double> start_height_m() const { return std::nullopt; }

  /// What the size of a diffraction pattern in pixels follows from; none where there is no such thing.
  struct Optics {
    double focal_length_m = 0.0, pitch_m = 0.0;
  };
  virtual std::optional<Optics> optics() const { return std::nullopt; }

  /// Its elements, where each has a place of its own in the field.
  virtual std::optional<FocalPlane> focal_plane() const;
  /// What a table tells of its elements' sides; none where none does. InputError with its place in the table, SystemError.
  virtual std::optional<SensitiveSide> sensitive_side() const;

  /// The same camera on the document's platform, of which `by` is null where the document has none; null: it stays as it is.
  /// InputError where a platform is missing, lacks what it needs, or would carry a camera that stands still.
  virtual std::shared_ptr<const CameraSettings> carried_by(std::shared_ptr<const PlatformFlight> by) const;

  /// When light falls on its image, seconds after the document's instant.
  struct Exposed {
    double from_s = 0.0, to_s = 0.0;
  };
  virtual Exposed exposed() const { return {}; }

  virtual sensor::ReadOut read_out() const;  ///< which detector elements make which pixels, and when
  /// Whether sweeps of a mirror or an antenna that turns make the image.
  virtual bool sweeps() const { return false; }
  /// What the image is made of where it is pictures below each other, "sweep" or "row"; empty: it is one picture.
  virtual std::string_view made_of() const { return {}; }

  /// The platform that carries it; null: none.
  virtual const PlatformFlight* carrier() const { return nullptr; }

  /// What a user should know of the settings, one sentence each.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// The settings where they are a T, else null.
template <class T>
const T* camera_as(const CameraDocument& camera) {
  return dynamic_cast<const T*>(camera.settings.get());
}

}  // namespace ifov::io
