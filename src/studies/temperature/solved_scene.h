#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "session/solved/second_pass.h"
#include "thermal/surface_balance.h"

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

struct StudyOptions;

/// A document that is loaded, to ask its points how warm they are, and to solve for them in full beside it.
class SolvedScene {
 public:
  /// Keeps the document in the study's folder, by this name.
  SolvedScene(const io::Document& document, const std::string& name, const StudyOptions& options);
  ~SolvedScene();

  const thermal::OutdoorsSeries& series() const;
  double half_width_k() const;  ///< that is stated of the image, without what surfaces about points add
  double half_width_k(std::size_t material) const;
  /// Of a material that is solved; null of another.
  const exposure::SolvedSurface* surface(std::size_t material) const;
  geometry::SurfacePoint met_by(math::Point3 from_m, math::Vec3 direction) const;
  geometry::SurfacePoint from_above(double x_m, double y_m) const {
    return met_by({x_m, y_m, 500.0}, {0.0, 0.0, -1.0});
  }
  static constexpr std::size_t kNone = ~std::size_t{0};
  /// The material of a point whose temperature is solved; kNone: none is.
  std::size_t solved_material(const geometry::SurfacePoint& point) const;

  /// A surface of a material solved alone. `stand`: as it stands; the terrain is the document's.
  double full_k(std::size_t material, thermal::Stand stand, std::vector<double> visibility,
                std::vector<double> free_sky = {}) const;
  double full_k(std::size_t material, thermal::Stand stand, const thermal::OutdoorsSeries& series,
                std::vector<double> visibility, std::vector<double> free_sky = {}) const;
  /// A point that is solved in full with the surfaces about it, each solved in full by itself, against what images make of these (session/solved/second_pass.h).
  session::BesideOff beside_off(std::size_t material, const geometry::SurfacePoint& point, std::uint64_t key,
                                const exposure::SolvedSurface::Exposure& exposure, double full_k) const;
  double whole_half_width_k(std::size_t material) const;  ///< with what is about points
  /// The same material under other weather, in a scene in which nothing came or went.
  std::unique_ptr<const exposure::SolvedSurface> surface_under(std::size_t material,
                                                               const thermal::OutdoorsSeries& series) const;

 private:
  struct Inside;
  std::unique_ptr<const Inside> inside_;
};

/// Mean of estimates of a point.
double mean_estimate_k(const exposure::SolvedSurface& surface, const geometry::SurfacePoint& point, int draws,
                       std::uint64_t seed);

}  // namespace ifov::studies
