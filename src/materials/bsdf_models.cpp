#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/error.h"
#include "core/names.h"
#include "materials/bsdf/boundary/film.h"
#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/boundary/slab.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/hapke.h"
#include "materials/bsdf/lambertian.h"
#include "materials/bsdf/leaf/leaf.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/oren_nayar.h"
#include "materials/bsdf/polarized/facet_brdf.h"
#include "materials/bsdf/polarized/maignan.h"
#include "materials/bsdf/ross_li.h"
#include "materials/bsdf/rough_conductor.h"
#include "materials/bsdf/rough_dielectric.h"
#include "materials/bsdf/roujean.h"
#include "materials/bsdf/rpv.h"
#include "materials/bsdf/sea/sea.h"
#include "materials/bsdf/snow.h"
#include "materials/bsdf/tabulated.h"
#include "materials/bsdf/ward.h"

namespace ifov::materials {
namespace {

constexpr std::array kModels{&Lambertian::kModel,
                             &Mirror::kModel,
                             &OrenNayar::kModel,
                             &RossLi::kModel,
                             &Roujean::kModel,
                             &Rpv::kModel,
                             &Hapke::kModel,
                             &Snow::kModel,
                             &Tabulated::kModel,
                             &RoughConductor::kModel,
                             &RoughDielectric::kModel,
                             &Ward::kModel,
                             &smooth::kModel,
                             &RoughBoundary::kModel,
                             &slab::kModel,
                             &film::kModel,
                             &Sea::kModel,
                             &Leaf::kModel,
                             &FacetBrdf::kPriestGermer,
                             &FacetBrdf::kMaxwellBeard,
                             &FacetBrdf::kShellTarget,
                             &Maignan::kModel};

template <class Value>
const Value& value_of(const BsdfInputs& inputs, std::string_view key) {
  for (const auto& [known, value] : inputs.values)
    if (known == key)
      if (const Value* found = std::get_if<Value>(&value)) return *found;
  throw std::logic_error(format("a BSDF model asks for '{}', which it has not declared", key));
}

}  // namespace

bool BsdfInputs::has(std::string_view key) const {
  return std::any_of(values.begin(), values.end(), [&](const auto& value) { return value.first == key; });
}

double BsdfInputs::number(std::string_view key) const { return value_of<double>(*this, key); }

const radiometry::Spectrum& BsdfInputs::spectrum(std::string_view key) const {
  return value_of<radiometry::Spectrum>(*this, key);
}

const std::string& BsdfInputs::word(std::string_view key) const { return value_of<std::string>(*this, key); }
const MeasuredBrdf& BsdfInputs::brdf(std::string_view key) const {
  return value_of<MeasuredBrdf>(*this, key);
}

const BsdfParameter* BsdfModel::first_needed() const {
  const auto needed = std::find_if(parameters.begin(), parameters.end(), [](const BsdfParameter& p) {
    return p.default_json.empty() && !p.optional;
  });
  return needed == parameters.end() ? nullptr : &*needed;
}

std::span<const BsdfModel* const> bsdf_models() { return kModels; }

const BsdfModel& bsdf_model(std::string_view key) {
  std::vector<std::string> keys;
  for (const BsdfModel* model : kModels) {
    if (model->key == key) return *model;
    keys.emplace_back(model->key);
  }
  const std::string hint = did_you_mean(key, keys);
  throw InputError(format("there is no scattering model '{}'{} {}", key,
                          hint.empty() ? "; there are" : hint + " There are",
                          list_names(keys, "and", keys.size())));
}

}  // namespace ifov::materials
