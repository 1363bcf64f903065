#pragma once

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A plane mirror: all light leaves at the angle at which it came.
class Mirror final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// The one object: all mirrors of a surface add up.
  static const std::shared_ptr<const Bsdf>& shared();

  bool is_delta() const override { return true; }
  bool is_separable() const override { return true; }
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override;
  double pdf(const BsdfEvent&) const override { return 0.0; }
  UnitSquarePoint invert(const BsdfEvent&) const override { return {0.5, 0.5}; }
  double shape(const BsdfEvent&) const override { return 0.0; }
  /// An ideal mirror keeps all polarization: fields along s and p come back alike, up to their sign.
  bool polarizes() const override { return true; }
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;
};

}  // namespace ifov::materials
