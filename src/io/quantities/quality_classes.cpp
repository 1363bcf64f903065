#include "io/quantities/quality_classes.h"

#include "core/format.h"

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

void add_classes(EnviHeader& header) {
  std::string names, colours;
  for (std::size_t k = 0; k < kQualityClasses; ++k) names += format("{}{}", k > 0 ? ", " : "", class_name(k));
  for (const Rgb c : class_colours())
    colours += format("{}{}, {}, {}", colours.empty() ? "" : ", ", c.r, c.g, c.b);
  header.is_classification = true;
  header.other["classes"] = format("{}", kQualityClasses);
  header.other["class names"] = names;
  header.other["class lookup"] = colours;
}

void add_bit_names(EnviHeader& header) {
  std::string names;
  for (std::size_t r = 0; r < sampling::kReasonNames.size(); ++r)
    names += format("{}{} {}", r > 0 ? ", " : "", 1u << r, sampling::kReasonNames[r]);
  header.other["reason bits"] = names;
}

}  // namespace ifov::io
