#pragma once

#include <optional>
#include <vector>

#include "geometry/surface_piece.h"
#include "transport/emitter_tree.h"

namespace ifov::transport {

class SpectralScene;

/// Which surface assignments of a scene emit so much more than the rest of it, in some channel, that scattered paths alone would find
/// their light by luck. A surface assignment is sought where it may be brighter than `kContrast` times both the light that falls on
/// the scene (a white surface under Sun and sky) and the emission of the median surface, by area; and where some surface
/// that scatters would show at least `kShown` of its own radiance and that light more if it saw nothing else; or where its material
/// says so and it emits at all. Lamps need no more than `kShown` of that contrast.
/// A thing of contrast C that fills the share f of what a surface sees adds C f to it, and is met by one path in 1/f: what adds 1 % is
/// met by one in 100 C.
struct EmitterChoice {
  static constexpr double kContrast = 2.0;
  static constexpr double kShown = 0.1;
  /// From here on what is left to chance is so rare and bright that no few paths tell of it.
  static constexpr double kOutshining = 20.0;

  explicit EmitterChoice(const SpectralScene& scene) : EmitterChoice(scene, kContrast, true) {}

  /// The same for what is sought in mirrors: of another contrast, whatever else would show of it.
  struct InMirrors {
    double contrast;
  };
  EmitterChoice(const SpectralScene& scene, InMirrors mirrors)
      : EmitterChoice(scene, mirrors.contrast, false) {}

  bool any() const { return any_; }
  /// Whether a surface assignment is wanted and so bright that pixels have to be told if it is not sought.
  bool outshines(std::uint32_t assignment) const {
    return wanted_[assignment] && (contrast_[assignment] > kOutshining || said_[assignment]);
  }
  bool lamp(std::uint32_t assignment) const { return lamp_[assignment]; }
  /// Whether a surface assignment is wanted, but a material of it says that its light be left to chance.
  bool declined(std::uint32_t assignment) const { return declined_[assignment]; }
  const geometry::WantedMaterials& wanted() const { return wanted_; }  ///< by surface assignment
  /// Whether what a surface assignment emits changes from point to point.
  bool mapped(std::uint32_t assignment) const { return mapped_[assignment]; }
  /// Groups of channels in which what is wanted shares out its light about alike.
  std::size_t group_count() const { return groups_; }
  /// A scale of radiance over the channels of each group in which a surface assignment is wanted, for a spectrum of emission in
  /// nodes: the mean of shares of the brightest.
  GroupedRadiance brightness(std::uint32_t assignment, const float* emission) const;
  /// At most, of a surface assignment.
  const GroupedRadiance& brightest(std::uint32_t assignment) const { return brightest_[assignment]; }
  /// How many times as bright a surface assignment may be as white under Sun and sky and as the median surface, in some channel; 0
  /// of one that is not wanted.
  double contrast(std::uint32_t assignment) const { return contrast_[assignment]; }
  /// What contrasts are with, by channel, W m-2 sr-1 um-1; NaN where nothing is wanted in any case.
  const std::vector<double>& usual() const { return usual_; }
  /// What a surface assignment emits at most, by channel, W m-2 sr-1 um-1.
  std::vector<double> highest(std::uint32_t assignment) const;

 private:
  EmitterChoice(const SpectralScene& scene, double contrast, bool shown);
  std::vector<double> channels(const float* nodes) const;
  void list_surfaces();
  void find_contrasts(double contrast, bool shown);
  void group_channels();
  GroupedRadiance grouped(std::uint32_t assignment, const std::vector<double>& by_channel) const;

  /// What a surface assignment may be somewhere.
  struct Surface {
    std::uint32_t assignment = 0;
    std::optional<bool> said;                      // materials::Material::emitter
    std::vector<double> hottest, coldest, albedo;  // by channel
    bool events = false, lamp = false;
  };
  const SpectralScene& scene_;
  bool any_ = false;
  geometry::WantedMaterials wanted_;
  std::vector<bool> mapped_, declined_, said_, lamp_;
  std::vector<double> contrast_;              // by surface assignment
  std::vector<std::vector<bool>> wanted_in_;  // by surface assignment and channel
  std::vector<GroupedRadiance> brightest_;
  std::size_t groups_ = 1;
  std::vector<std::size_t> group_of_;  // by channel
  std::vector<Surface> surfaces_;
  std::vector<double> unit_;   // radiance of brightness 1, by channel
  std::vector<double> usual_;  // of white under Sun and sky, or of the median surface
};

}  // namespace ifov::transport
