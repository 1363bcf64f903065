#include "io/atmosphere/modtran_json.h"

#include <cmath>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/json/json_adapter.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Type = DocumentNode::Type;

const DocumentNode* object_in(const DocumentNode& node, std::string_view key) {
  const DocumentNode* found = node.find(key);
  if (found != nullptr && found->type() != Type::object) found->fail_expected("an object");
  return found;
}

std::optional<double> number_in_object(const DocumentNode* object, std::string_view key) {
  const DocumentNode* node = object == nullptr ? nullptr : object->find(key);
  if (node == nullptr) return std::nullopt;
  if (node->type() != Type::number) node->fail_expected("a number");
  return node->number();
}

std::optional<int> integer_in_object(const DocumentNode* object, std::string_view key) {
  const std::optional<double> value = number_in_object(object, key);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value) || std::abs(*value) > 1e6)
    object->find(key)->fail_expected("a whole number");
  return static_cast<int>(*value);
}

/// MODTRAN takes its choices as words or as the numbers of its older versions.
std::string word_in_object(const DocumentNode* object, std::string_view key) {
  const DocumentNode* node = object == nullptr ? nullptr : object->find(key);
  if (node == nullptr) return {};
  if (node->type() == Type::number) return format("{}", node->number());
  if (node->type() != Type::text) node->fail_expected("a text");
  return node->text();
}

std::string amount_unit(const std::string& letter) {
  if (letter == "g" || letter == "G") return "g cm-2";
  if (letter == "a" || letter == "A") return "cm atm";
  return "scale";
}

std::optional<double> albedo_of(const std::string& surface) {
  constexpr std::string_view kFront = "LAMB_CONST_", kBack = "_PCT";
  if (!surface.starts_with(kFront) || !surface.ends_with(kBack)) return std::nullopt;
  const auto percent = number_in(
      std::string_view(surface).substr(kFront.size(), surface.size() - kFront.size() - kBack.size()));
  if (!percent || *percent < 0.0 || *percent > 100.0) return std::nullopt;
  return *percent / 100.0;
}

void read_air(const DocumentNode& input, ModtranCase& result) {
  const DocumentNode* air = object_in(input, "ATMOSPHERE");
  result.model = word_in_object(air, "MODEL");
  result.co2_ppm = number_in_object(air, "CO2MX");
  result.water_vapour = number_in_object(air, "H2OSTR");
  if (result.water_vapour) result.water_vapour_unit = amount_unit(word_in_object(air, "H2OUNIT"));
  result.ozone = number_in_object(air, "O3STR");
  if (result.ozone) result.ozone_unit = amount_unit(word_in_object(air, "O3UNIT"));
  const DocumentNode* aerosols = object_in(input, "AEROSOLS");
  result.aerosol = word_in_object(aerosols, "IHAZE");
  if (const auto visibility = number_in_object(aerosols, "VIS")) {
    if (*visibility > 0.0) result.visibility_km = visibility;
    if (*visibility < 0.0) result.aerosol_optical_depth_550 = -*visibility;
  }
}

void read_geometry(const DocumentNode& input, ModtranCase& result) {
  const DocumentNode* geometry = object_in(input, "GEOMETRY");
  result.sensor_altitude_km = number_in_object(geometry, "H1ALT");
  result.end_altitude_km = number_in_object(geometry, "H2ALT");
  if (const auto zenith = number_in_object(geometry, "OBSZEN")) result.zenith_rad = *zenith * math::kDegree;
  if (const auto azimuth = number_in_object(geometry, "TRUEAZ"))
    result.true_azimuth_rad = *azimuth * math::kDegree;
  result.day_of_year = integer_in_object(geometry, "IDAY");
  result.time_utc_h = number_in_object(geometry, "GMTIME");
  result.sun_option = integer_in_object(geometry, "IPARM");
  result.parameter_1 = number_in_object(geometry, "PARM1");
  result.parameter_2 = number_in_object(geometry, "PARM2");
}

void read_spectrum(const DocumentNode& input, ModtranCase& result) {
  const DocumentNode* spectral = object_in(input, "SPECTRAL");
  result.first = number_in_object(spectral, "V1");
  result.last = number_in_object(spectral, "V2");
  result.step = number_in_object(spectral, "DV");
  result.width = number_in_object(spectral, "FWHM");
  const std::string flags = word_in_object(spectral, "FLAGS");
  const char unit = flags.empty() ? ' ' : flags[0];
  result.spectral_unit = unit == 'N' || unit == 'n' ? "nm" : unit == 'M' || unit == 'm' ? "um" : "cm-1";
}

ModtranCase read_case(const DocumentNode& node) {
  if (node.type() != Type::object) node.fail_expected("an object with the key MODTRANINPUT");
  const DocumentNode* input = object_in(node, "MODTRANINPUT");
  if (input == nullptr) node.fail_expected("an object with the key MODTRANINPUT");
  ModtranCase result;
  result.name = word_in_object(input, "NAME");
  result.case_number = integer_in_object(input, "CASE").value_or(0);
  const DocumentNode* options = object_in(*input, "RTOPTIONS");
  result.run_mode = word_in_object(options, "IEMSCT");
  result.multiple_scattering = word_in_object(options, "IMULT");
  read_air(*input, result);
  read_geometry(*input, result);
  if (const DocumentNode* surface = object_in(*input, "SURFACE")) {
    result.ground_altitude_km = number_in_object(surface, "GNDALT");
    result.surface = word_in_object(object_in(*surface, "SURFP"), "CSALB");
    result.surface_albedo = albedo_of(result.surface);
  }
  read_spectrum(*input, result);
  return result;
}

}  // namespace

std::vector<ModtranCase> read_modtran_json(const std::filesystem::path& path) {
  return parse_modtran_json(read_input(path), path.string());
}

std::vector<ModtranCase> parse_modtran_json(std::string text, const std::string& file_name) {
  JsonRules rules;
  rules.comments = false;
  const DocumentTree tree = parse_json(std::move(text), file_name, rules);
  if (tree.root->type() != Type::object) tree.root->fail_expected("an object with the key MODTRAN");
  const DocumentNode* cases = tree.root->find("MODTRAN");
  if (cases == nullptr) tree.root->fail_expected("an object with the key MODTRAN");
  if (cases->type() != Type::list || cases->items().empty()) cases->fail_expected("a list of cases");
  std::vector<ModtranCase> result;
  for (const DocumentNode& each : cases->items()) result.push_back(read_case(each));
  return result;
}

}  // namespace ifov::io
