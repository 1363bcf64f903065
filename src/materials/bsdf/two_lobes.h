#pragma once

#include "materials/bsdf/bsdf.h"
#include "math/frame.h"
#include "sampling/random.h"

namespace ifov::materials {

/// A reflecting model that draws directions from two lobes, all of whose densities count wherever either has drawn. Directions are
/// in the frame of the model: z along the normal, x along its direction (facet_frame), both above the horizon.
class TwoLobes : public Bsdf {
 public:
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const final;
  double pdf(const BsdfEvent& event) const final;
  UnitSquarePoint invert(const BsdfEvent& event) const final;
  double seam(const BsdfEvent& view) const final;
  double grey(const BsdfEvent& event) const final;
  double lobe_share(const BsdfEvent& event) const final;
  double widened_lobe(const BsdfEvent& event, double slope) const final;

 protected:
  enum class Lobe { broad, narrow };
  /// `direction_rad`: of x from the tangent, counterclockwise as seen from outside.
  explicit TwoLobes(double direction_rad = 0.0);

  struct Directions {
    math::Vec3 out, in;
    bool are_above() const { return out.z > 0.0 && in.z > 0.0; }
  };
  math::Frame frame_of(const BsdfEvent& event) const;
  Directions directions_of(const BsdfEvent& event) const;

  /// How often the broad lobe is drawn, above 0 and below 1.
  virtual double broad_share(math::Vec3 out) const = 0;
  /// May lie below the horizon.
  virtual math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const = 0;
  virtual double density(Lobe lobe, const Directions& event) const = 0;
  virtual sampling::Point2 undraw(Lobe lobe, const Directions& event) const = 0;
  virtual double grey_bsdf(const Directions& event) const = 0;
  /// Of that, the narrow lobe's.
  virtual double narrow_grey(const Directions& event) const = 0;
  /// As widened_lobe().
  virtual double widened_grey(const Directions&, double /*slope*/) const { return 0.0; }

 private:
  double mixed_density(const Directions& event) const;
  double cos_direction_, sin_direction_;
};

}  // namespace ifov::materials
