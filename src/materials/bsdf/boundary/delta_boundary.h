#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "materials/bsdf/bsdf.h"

namespace ifov::materials {

/// A boundary that is smooth: light is reflected as by a mirror, and comes through straight or refracted, in shares that depend on
/// angle and wavelength. The shares are spectra at some angles (boundary_rows), all reflected ones before all transmitted ones.
class DeltaBoundary final : public Bsdf {
 public:
  struct Properties {
    std::size_t rows = 0;
    bool transmits = false;
    Passage passage = Passage::none;
    /// Of `into` and `out_of`: the index of the medium by which directions are bent, real and above 0. Shares are told by the angle
    /// outside the medium.
    double index = 1.0;
    std::optional<radiometry::Spectrum> absorption = std::nullopt;  ///< of the medium, 1/m
    std::shared_ptr<const Bsdf> behind = nullptr;
    /// Elements of its Mueller matrices (boundary_polarization, rows_beside() of the rows), made when they are asked for; of `out_of`
    /// with the index of the medium behind them, by which light that is reflected totally is retarded.
    std::function<std::vector<radiometry::Spectrum>()> polarization = {};
  };
  DeltaBoundary(std::vector<radiometry::Spectrum> shares, Properties properties);

  bool is_delta() const override { return true; }
  bool may_transmit() const override { return properties_.transmits; }
  Passage passage() const override { return properties_.passage; }
  std::shared_ptr<const Bsdf> behind() const override { return properties_.behind; }
  double bending_index() const override { return properties_.index; }
  const radiometry::Spectrum* absorption() const override {
    return properties_.absorption ? &*properties_.absorption : nullptr;
  }
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override;
  double pdf(const BsdfEvent&) const override { return 0.0; }
  UnitSquarePoint invert(const BsdfEvent&) const override { return {0.5, 0.5}; }
  double shape(const BsdfEvent&) const override { return 0.0; }
  double grey(const BsdfEvent&) const override { return 1.0; }
  std::span<const radiometry::Spectrum> spectra() const override { return shares_; }
  /// By `outgoing` and side alone.
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* share) const override;
  bool polarizes() const override { return static_cast<bool>(properties_.polarization); }
  std::span<const radiometry::Spectrum> polarization_spectra() const override;
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  /// The cosine outside by which shares are told; `total`: light is reflected totally within.
  double outside_cosine(const BsdfEvent& event, bool& total) const;
  void turn_totally(const BsdfEvent& event, const float* index, std::size_t count,
                    const MuellerRows& rows) const;

  std::vector<radiometry::Spectrum> shares_;
  mutable std::once_flag made_;
  mutable std::vector<radiometry::Spectrum> polarization_;
  Properties properties_;
};

/// The direction on the other side of a surface that light from `towards` comes from, both away from the surface (unit); `normal` on
/// the side of `towards`, `ratio` the index there over the index here. Zero where it is reflected totally.
math::Vec3 refracted(math::Vec3 towards, math::Vec3 normal, double ratio);

}  // namespace ifov::materials
