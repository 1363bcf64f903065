#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ifov::session {

/// What solved temperatures may be off by, beside what rays into the past do not tell: measured at points that the camera sees, and at some made up of materials that it hardly sees, each solved
/// in full by itself against what its class makes of the same exposure. Kelvins.
struct TemperatureErrors {
  struct OfMaterial {
    double points = 0.0, rms_k = 0.0, step_k = 0.0;
    /// Root mean square of points of a past unlike most: half lit, or where things came and went; the larger.
    double unsettled_k = 0.0;
    /// Likewise of what is made of surfaces about points: of those that the camera sees, and that rays meet going on.
    double beside_k = 0.0, met_beside_k = 0.0;
    double ground_k = 0.0;  ///< largest, of the wind where nothing below faces up and ground lies beside
    double other_side_k =
        0.0;  ///< largest, of thin sheets whose other side is outdoors and left out; or by what the faces of one differ
    /// Of what two standard deviations hold, 95.45 %: Student's t of as many points times the root mean square, or twice that of those that were chosen, and twice the steps'. What the ground
    /// and the other side make uncertain comes on top, as it is no matter of chance.
    double half_width_k() const;
    double whole_half_width_k() const;  ///< seen or met, the larger
    /// Of the points, those seen; more, of `beside_k`, `met_beside_k`.
    int seen = 0, beside = 0, met_beside = 0;
  };
  int points = 0, made_up = 0, unsettled = 0;
  bool mirrors = false;              ///< some material is not Lambertian
  double rms_k = 0.0, bias_k = 0.0;  ///< root mean square and mean, of the material of the largest half-width
  std::string material;              ///< its name
  double unsettled_k = 0.0;          ///< likewise, of those that were chosen
  double beside_k = 0.0;             ///< likewise, of what is about them
  double worst_k = 0.0;
  double step_k = 0.0;                     ///< of the steps of time, by those of twice the length
  double lowest_m = 0.0, highest_m = 0.0;  ///< above ground, of those that the camera sees
  int on_nothing = 0;                      ///< points of `ground_k`
  double ground_k = 0.0;                   ///< the largest
  int free_standing = 0;                   ///< points of `other_side_k`
  double other_side_k = 0.0;               ///< the largest
  double across_k = 0.0;                   ///< largest, by which a face of a sheet of two is off
  std::string free_material;               ///< of which that is
  std::string weather;  ///< by which they are solved, and what stood in for what it does not tell

  std::map<std::uint32_t, OfMaterial> by_material{};  ///< by its number

  /// Of the material where it is largest; where there are mirrors and the like, which may show any of it, wherever that is.
  double half_width_k() const;
  std::string statement() const;
};

}  // namespace ifov::session
