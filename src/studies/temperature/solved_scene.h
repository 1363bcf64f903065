#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct Document;
struct ObjectDocument;
}  // namespace ifov::io

namespace ifov::studies {

/// Two days of June at 52 N, 5 E, hour by hour, in a file of the study's folder, by its name there: clear, with 2.5 m/s of wind; or
/// without Sun, in air of 290 K that hardly moves.
std::string write_june(const StudyOptions& options, bool sunny = true);

/// A scene of `road` (asphalt on soil) and `brick`, both solved and black, under that weather, seen from above. `hour`: "15:00".
io::Document solved_document(const std::string& weather, const std::string& hour, double step_s = 600.0);
io::ObjectDocument solved_ground();
io::ObjectDocument solved_box(math::Point3 low_m, math::Point3 high_m, const std::string& material);

/// The document as it is read again from the study's folder, where it is kept by this name.
io::Document kept_document(const io::Document& document, const std::string& name,
                           const StudyOptions& options);

/// A document that is loaded, to ask its points how warm they are, and to solve for them in full beside it.
class SolvedScene {
 public:
  /// Keeps the document in the study's folder, by this name.
  SolvedScene(const io::Document& document, const std::string& name, const StudyOptions& options);

  const session::Parts& parts() const { return session_.parts(); }
  const thermal::OutdoorsSeries& series() const { return about_.outdoors.series; }
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
  /// The same material under other weather, and what else stands about it.
  exposure::SolvedSurface surface_under(std::size_t material, const thermal::OutdoorsSeries& series) const;

 private:
  const session::ThermalMaterial& thermal(std::size_t material) const;

  session::Session session_;
  session::DocumentOutdoors about_;
  std::vector<std::unique_ptr<session::ThermalMaterial>> thermal_;  ///< by material; null: not solved
};

/// Mean of estimates of a point.
double mean_estimate_k(const exposure::SolvedSurface& surface, const geometry::SurfacePoint& point, int draws,
                       std::uint64_t seed);

}  // namespace ifov::studies
