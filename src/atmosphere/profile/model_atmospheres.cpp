#include <map>

#include "atmosphere/profile/profile.h"
#include "atmosphere/tables/table_text.h"
#include "core/error.h"
#include "core/names.h"

namespace ifov::data {
extern const std::string_view atmosphere_profiles;
}

namespace ifov::atmosphere {
namespace {

struct ModelAtmospheres {
  std::vector<std::string> names;
  std::map<std::string, Profile, std::less<>> profiles;
};

ModelAtmospheres read() {
  ModelAtmospheres models;
  constexpr std::size_t kColumns = 3 + kGasCount;
  for (const TableSection& section : parse_table_text(data::atmosphere_profiles)) {
    std::string name = section.words[0];
    for (std::size_t i = 1; i < section.words.size(); ++i) name += " " + section.words[i];
    Profile profile;
    profile.altitude_km = table_column(section, 0, kColumns);
    profile.pressure_hPa = table_column(section, 1, kColumns);
    profile.temperature_K = table_column(section, 2, kColumns);
    for (std::size_t g = 0; g < kGasCount; ++g)
      profile.mixing_ratio_ppmv[g] = table_column(section, 3 + g, kColumns);
    models.names.push_back(name);
    models.profiles.emplace(name, std::move(profile));
  }
  return models;
}

const ModelAtmospheres& models() {
  static const ModelAtmospheres all = read();
  return all;
}

}  // namespace

const std::vector<std::string>& model_atmosphere_names() { return models().names; }

const Profile& model_atmosphere(std::string_view name) {
  const auto found = models().profiles.find(name);
  if (found == models().profiles.end())
    throw InputError(format("'{}' is no model atmosphere; expected {}{}", name, list_names(models().names),
                            did_you_mean(name, models().names)));
  return found->second;
}

}  // namespace ifov::atmosphere
