#pragma once

#include <optional>
#include <span>
#include <vector>

#include "math/ray.h"
#include "math/transform.h"
#include "sampling/field.h"
#include "sensor/camera_axes.h"

namespace ifov::radiometry {
struct PolarizationFrame;
}

namespace ifov::sensor {

struct AlongTrack;
class FlyingFrameCamera;
class PictureStack;
class ViewListCamera;

/// How a camera stands in the scene while a line of its image is exposed.
struct CameraPose {
  CameraAxes axes;  ///< of rays that diverge, unit vectors; of parallel ones `down` lies on the ground
  /// Perspective centre, scene frame; none where rays are parallel: above all air.
  std::optional<math::Point3> position_m;
  double focal_length_m = 0.0, pitch_m = 0.0;  ///< 0 where rays are parallel
  double time_s = 0.0;  ///< middle of the line's exposure, after the document's instant

  /// Above z = 0 of the scene; none: above all air.
  std::optional<double> altitude_m() const {
    return position_m ? std::optional(position_m->z) : std::nullopt;
  }
};

/// Where the pixels of an image lie on the scene's plane z = 0, as squares of one size.
struct GroundGrid {
  math::Point3 upper_left_m;  ///< outer corner of the upper left pixel, scene frame
  double gsd_m = 0.0;         ///< side of a pixel
  double rotation_rad = 0.0;  ///< azimuth of the image's upward direction, clockwise from north

  /// The map transform: takes (x_px, y_px, 0) of the image frame to the scene's plane.
  math::Transform scene_from_image() const;
};

/// Instantaneous field of view: the angles that a pixel covers, rad; 0 where rays are parallel.
struct Ifov {
  double x_rad = 0.0, y_rad = 0.0;  ///< along image x and y
};

/// Where light that falls on a point of the focal plane comes from, and what follows from that: whoever needs height,
/// direction or scale of an image asks here. Frames: scene (ENU metres) for rays, image (pixels, x right, y down) for
/// points. A line is a y of the image frame, so that the middle of pixels' row j is j + 0.5; of a camera that stands still all lines are alike.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual int width_px() const = 0;
  virtual int height_px() const = 0;

  /// Rays through focal-plane points, from the camera towards the scene. A ray's time is that of its line (pose) and the point's own together.
  virtual void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const = 0;

  /// Image of a scene point; false where it is behind the camera.
  virtual bool project(math::Point3 position_m, sampling::FocalPoint& point) const = 0;

  /// Ground sample distance at a scene point, metres per pixel.
  virtual double gsd_m(math::Point3 position_m) const = 0;
  virtual CameraPose pose(double line_px) const = 0;
  virtual CameraAxes axes_at(const sampling::FocalPoint& point) const { return pose(point.y_px).axes; }

  virtual double exposure_s() const { return 0.0; }    ///< of a point; 0 where y alone tells when
  virtual double row_period_s() const { return 0.0; }  ///< from one row's exposure to the next's
  virtual const FlyingFrameCamera* flying() const { return nullptr; }  ///< itself where it is one
  virtual bool bends_sharply() const { return false; }  ///< smooth lines may have corners in the image
  bool moves_while_exposed() const { return flying() != nullptr && exposure_s() > 0.0; }
  /// What its pixels are spread over beside the optics, along image y by its motion and along x by elements that are swept.
  virtual AlongTrack along_track() const;
  virtual AlongTrack along_line() const;

  /// The camera where its platform reports it to be, by which places of its pixels are told; itself where its pose is known.
  virtual const Camera& reported() const { return *this; }

  /// Single views side by side, each to be sampled by itself, or pictures one below the other; null: it is one picture.
  virtual const ViewListCamera* view_list() const { return nullptr; }
  virtual const PictureStack* pictures() const { return nullptr; }

  /// None where pixels are no squares of one size on the ground.
  virtual std::optional<GroundGrid> ground_grid() const = 0;

  double middle_line_px() const { return 0.5 * height_px(); }

  /// The ray through one point.
  math::Ray ray(const sampling::FocalPoint& point) const;
  /// The ray through the middle of a line, or of the image.
  math::Ray middle_ray(double line_px) const { return ray({0.5 * width_px(), line_px}); }
  math::Ray middle_ray() const { return middle_ray(middle_line_px()); }

  /// Of a pixel in the middle of a line.
  virtual Ifov ifov(double line_px) const;

  /// Ground sample distance where the middle of a line meets level ground at a height (z); none where it does not look down at it.
  std::optional<double> line_gsd_m(double line_px, double ground_m = 0.0) const;
};

/// Middles of the cells of a grid over the whole image and `margin_px` more on each side, row by row.
std::vector<sampling::FocalPoint> grid_over(const Camera& camera, int columns, int rows,
                                            double margin_px = 0.0);

/// What the Stokes vector of light that reaches a point of the focal plane along a ray is about: x is the image's
/// x (`right`, made perpendicular to the optical axis), carried from the axis to the ray's direction as a rotationally
/// symmetric lens carries it, so that fields along the radius and across it stay such. y = k cross x is the image's upward direction on the axis.
radiometry::PolarizationFrame focal_frame(const Camera& camera, const sampling::FocalPoint& point,
                                          const math::Ray& ray);

/// Angle between the nadir and where a ray looks: 0 straight down, pi/2 level.
double nadir_angle_rad(const math::Ray& ray);

}  // namespace ifov::sensor
