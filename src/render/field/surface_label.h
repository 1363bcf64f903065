#pragma once

#include <cstdint>

#include "sampling/field.h"

namespace ifov::render {

/// How the Sun's disc is seen from a surface point, judged at fixed points of the disc.
enum class SunState : std::uint8_t { none = 0, lit = 1, penumbra = 2, shaded = 3 };

/// The fields of a label: what the hit is. Instance and patch wrap where they outgrow their bits; two patches that
/// share a label cost rays, never honesty.
struct SurfaceLabel {
  std::uint32_t instance = 0;  // 25 bits
  std::uint32_t patch = 0;     // 21 bits
  std::uint32_t material = 0;  // 15 bits, exact: by number in scene::TruthMaterials
  bool front = true;
  SunState sun = SunState::none;

  static constexpr std::uint32_t kSunOfSky = 1;  ///< "patch" of the sky where the Sun's disc stands
  static constexpr std::uint32_t kMoving = (1u << 25) - 1;  ///< "instance" of what may move
  static constexpr std::uint32_t kMaximumMaterials = (1u << 15) - 3;
  static constexpr std::uint32_t kBlend = (1u << 15) - 2;  ///< "material" of assignments that mix
  static constexpr std::uint32_t kSky = (1u << 15) - 1;    ///< "material" of a ray that met nothing

  constexpr sampling::Label pack() const {
    return (static_cast<std::uint64_t>(instance & 0x1ffffffu) << 39) |
           (static_cast<std::uint64_t>(patch & 0x1fffffu) << 18) |
           (static_cast<std::uint64_t>(material & 0x7fffu) << 3) | (static_cast<std::uint64_t>(front) << 2) |
           static_cast<std::uint64_t>(sun);
  }

  /// What shows several things, one after the other: no material of its own, and uneven as penumbras are.
  static constexpr sampling::Label moving() {
    return SurfaceLabel{kMoving, 0, kBlend, true, SunState::penumbra}.pack();
  }

  /// The label of the same hit in a state of MirrorLight, folded into the bits of the patch; `uneven` takes the highest.
  static constexpr sampling::Label with_mirrored(sampling::Label label, std::uint64_t state, bool uneven) {
    return (label ^ (state & 0xfffffu) << 18) | (uneven ? kUneven : 0);
  }
  static constexpr bool is_uneven(sampling::Label label, bool mirrors) {
    return (label & 3u) == static_cast<sampling::Label>(SunState::penumbra) ||
           (mirrors && (label & kUneven) != 0);
  }

  static constexpr sampling::Label kUneven = sampling::Label{1} << 38;
  static constexpr std::uint32_t kMaximumInstances = 1u << 25;
  static constexpr std::uint32_t instance_of(sampling::Label label) {
    return static_cast<std::uint32_t>(label >> 39);
  }
  static constexpr SunState sun_of(sampling::Label label) { return static_cast<SunState>(label & 3u); }
  static constexpr std::uint32_t material_of(sampling::Label label) {
    return static_cast<std::uint32_t>(label >> 3) & 0x7fffu;
  }
};

}  // namespace ifov::render
