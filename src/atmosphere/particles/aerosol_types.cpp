#include "atmosphere/particles/aerosol_types.h"

#include <algorithm>

#include "atmosphere/particles/aerosol_components.h"
#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/particles/aerosol_phase_functions.h"
#include "atmosphere/particles/particles.h"
#include "core/error.h"
#include "core/names.h"

namespace ifov::atmosphere {
namespace {

constexpr double kUsualVisibility_km = 23.0;

const std::vector<AerosolType>& all_types() {
  static const std::vector<AerosolType> all = [] {
    std::vector<AerosolType> types{
        {"rural", "rural", kUsualVisibility_km},       {"urban", "urban", 5.0},
        {"maritime", "maritime", kUsualVisibility_km}, {"tropospheric", "tropospheric", 50.0},
        {"advective fog", "fog_advection", 0.2},       {"radiative fog", "fog_radiation", 0.5},
    };
    for (const std::string& composed : composed_aerosols()) {
      std::string name = composed;
      std::replace(name.begin(), name.end(), '_', ' ');
      types.push_back({std::move(name), composed, kUsualVisibility_km, true});
    }
    return types;
  }();
  return all;
}

/// One kind of LOWTRAN7's, at a humidity.
class TabulatedParticles : public Particles {
 public:
  TabulatedParticles(std::string_view kind, double humidity_percent)
      : optics_(kind, humidity_percent), phase_functions_(kind, humidity_percent) {}
  AerosolProperties properties(double wavelength_um) const override { return optics_.at(wavelength_um); }
  PhaseFunction phase_function(double wavelength_um) const override {
    return phase_functions_.at(wavelength_um);
  }

 private:
  AerosolOptics optics_;
  AerosolPhaseFunctions phase_functions_;
};

}  // namespace

const std::vector<std::string>& aerosol_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const AerosolType& type : all_types()) all.push_back(type.name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& aerosol_types() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = aerosol_kinds();
    all.insert(all.begin(), "none");
    return all;
  }();
  return names;
}

const AerosolType& aerosol_type(const std::string& name) {
  for (const AerosolType& type : all_types())
    if (type.name == name) return type;
  throw InputError(format("'{}' is no aerosol type; expected {}{}", name, list_names(aerosol_types()),
                          did_you_mean(name, aerosol_types())));
}

std::shared_ptr<const Particles> particles_of(const AerosolType& type, double humidity_percent) {
  if (type.composed) return composed_aerosol(type.optics, humidity_percent);
  return tabulated_particles(type.optics, humidity_percent);
}

std::shared_ptr<const Particles> tabulated_particles(std::string_view kind, double humidity_percent) {
  return std::make_shared<const TabulatedParticles>(kind, humidity_percent);
}

}  // namespace ifov::atmosphere
