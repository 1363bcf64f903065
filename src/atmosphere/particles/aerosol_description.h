#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ifov::atmosphere {

/// At most one of visibility, optical thickness and own haze is given; without any the visibility is 23 km.
struct AerosolDescription {
  std::string type = "rural";  ///< of the lowest 2 km; "none": no aerosol at any height
  std::optional<double> visibility_km;
  std::optional<double> aot550;  ///< vertical optical thickness at 550 nm, all heights
  /// In place of that of `type`, below 10 km; of a mixture several.
  std::vector<std::shared_ptr<const struct ParticleLayer>> own = {};
  std::string season;  ///< "spring-summer", "autumn-winter"; empty: that of the model atmosphere
  std::string stratosphere = "background";  ///< "none": no aerosol of the tables above 10 km
  /// Besides, whatever the type; with a base, a top and no scale height.
  std::vector<std::shared_ptr<const struct ParticleLayer>> clouds = {};
};

const std::vector<std::string>& aerosol_types();        ///< with "none"
const std::vector<std::string>& stratosphere_states();  ///< with "background" and "none"

}  // namespace ifov::atmosphere
