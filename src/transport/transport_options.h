#pragma once

#include <cstdint>
#include <vector>

namespace ifov::transport {

class SeparateImages;

struct TransportOptions {
  /// Surfaces a path may scatter at: 0 emission and sky only, 1 adds direct sun; negative: no limit, paths end by Russian roulette without bias.
  int maximum_scatterings = -1;
  /// Whether light is sought from the scene's emitters, if it has any; the mean is the same without.
  bool seek_emitters = true;
  /// Whether rays are sent to narrow lobes for the sunlight that they throw on others; the mean is the same without.
  bool seek_lobes = true;
  /// Sunlight is sought by way of so many flat mirrors in turn, at most SunImages::kMostReflections; 0: none.
  int mirror_reflections = 8;
  /// Two kinds of sunlight are left out that paths otherwise find by chance, seldom and bright: glints on curved mirrors that the sensor
  /// sees directly, which are added separately (Glints), and what reaches a surface that scatters by mirrors that are not sought, which is marked (UnseenLight).
  bool sought_only = false;
  /// The Sun's disc where the sensor sees it with nothing between is left out, because it is added separately.
  bool sun_apart = false;
  /// Highlights of the Sun in narrow lobes that the sensor sees directly (SunLobes): as all other light; left out, because they are added separately
  /// (Highlights); or nothing else but them, for whoever adds them.
  enum class Highlights : std::uint8_t { found, left_out, alone };
  Highlights highlights = Highlights::found;
  /// Objects whose highlights are not left out all the same, sorted; null: none.
  const std::vector<std::uint32_t>* large_lobes = nullptr;
  /// Of these the ones whose highlights may be smaller than a pixel, sorted; null: none.
  const std::vector<std::uint32_t>* unsure_lobes = nullptr;
  /// By material, 0 to 1: the share of the open sky's light that the Lambertian surfaces which the sensor sees take from its integral, while what their
  /// paths find in it counts by the rest; the mean is the same for any share, and the variance least where it is the share that they see (a control variate). null: 0.
  const std::vector<float>* sky_shares = nullptr;
  /// Images in mirrors that are added separately: paths see through what they show; null: none.
  const SeparateImages* separate_images = nullptr;
  bool no_spectra = false;  ///< recorded is what any scene of these surfaces can make its light of
};

}  // namespace ifov::transport
