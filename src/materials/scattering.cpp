#include "materials/scattering.h"

#include <array>

#include "materials/lambertian.h"
#include "materials/mirror.h"

namespace ifov::materials {
namespace {

const Lambertian kLambertian;
const Mirror kMirror;

struct Row {
  ScatteringEntry entry;
  const Scattering* object;
};

// In the order of ScatteringKind.
const std::array kRows{
    Row{{ScatteringKind::lambertian, "lambertian", "the same radiance to all sides"}, &kLambertian},
    Row{{ScatteringKind::mirror, "mirror", "a plane mirror"}, &kMirror},
};

}  // namespace

std::span<const ScatteringEntry> scattering_entries() {
  static const auto entries = [] {
    std::array<ScatteringEntry, kRows.size()> list;
    for (std::size_t i = 0; i < kRows.size(); ++i) list[i] = kRows[i].entry;
    return list;
  }();
  return entries;
}

const Scattering& scattering(ScatteringKind kind) { return *kRows[static_cast<std::size_t>(kind)].object; }

}  // namespace ifov::materials
