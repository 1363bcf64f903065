#include "io/quantities/quality_classes.h"

#include <string>
#include <vector>

#include "core/format.h"
#include "io/quantities/classes.h"

namespace ifov::io {

std::uint8_t class_of(sampling::Reasons reasons) {
  const auto reason = sampling::gravest(reasons);
  return reason ? static_cast<std::uint8_t>(static_cast<unsigned>(*reason) + 1u) : std::uint8_t{0};
}

std::string_view class_name(std::size_t quality_class) {
  return quality_class == 0 ? std::string_view("converged") : sampling::kReasonNames.at(quality_class - 1);
}

const std::array<Rgb, kQualityClasses>& class_colours() {
  static constexpr std::array<Rgb, kQualityClasses> kColours{{
      {222, 226, 230},  // converged
      {128, 134, 142},  // unjudged
      {51, 117, 188},   // samples
      {60, 60, 66},     // time
      {122, 178, 222},  // error
      {230, 159, 0},    // structure
      {204, 46, 40},    // unseen light
      {0, 140, 120},    // air
      {112, 190, 150},  // nodes
      {140, 104, 190},  // psf cut
      {214, 112, 168},  // edge
  }};
  return kColours;
}

void add_quality_classes(EnviHeader& header, const render::ImageInfo&) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kQualityClasses; ++k) names.emplace_back(class_name(k));
  add_classes(names, class_colours(), header);
}

void add_bit_names(EnviHeader& header, const render::ImageInfo&) {
  std::string names;
  for (std::size_t r = 0; r < sampling::kReasonNames.size(); ++r)
    names += format("{}{} {}", r > 0 ? ", " : "", 1u << r, sampling::kReasonNames[r]);
  header.other["reason bits"] = names;
}

}  // namespace ifov::io
