#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ifov::atmosphere {

/// What is asked of the aerosol. Of visibility and optical thickness at most one is given; without either it
/// is 23 km.
struct AerosolDescription {
  std::string type = "rural";  ///< of the lowest 2 km; "none": no aerosol at any height
  std::optional<double> visibility_km;
  std::optional<double> aot550;  ///< vertical optical thickness at 550 nm, all heights
  std::string season;            ///< "spring-summer", "autumn-winter"; empty: that of the model atmosphere
  std::string stratosphere = "background";
};

const std::vector<std::string>& aerosol_types();        ///< with "none"
const std::vector<std::string>& stratosphere_states();  ///< with "background"

}  // namespace ifov::atmosphere
