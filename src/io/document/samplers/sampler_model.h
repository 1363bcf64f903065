#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "io/document/samplers/sampler_settings.h"

namespace ifov::io {

template <class V>
struct SchemaType;

/// A kind of sampler, by its key in `sampling`.
struct SamplerModel {
  std::string_view key;   ///< "grid"
  std::string_view what;  ///< for the reference page: "the same rays in every pixel"
  /// The table of its keys.
  SchemaType<std::shared_ptr<const SamplerSettings>> (*type)() = nullptr;
};

/// Settings of any kind read as such.
template <class Settings, class Base = SamplerSettings>
SchemaType<std::shared_ptr<const Base>> sampler_type(const SchemaType<Settings>& type) {
  return converted<std::shared_ptr<const Base>>(
      type, [](Settings settings) { return std::make_shared<const Settings>(std::move(settings)); },
      [](const std::shared_ptr<const Base>& settings) {
        const auto* own = dynamic_cast<const Settings*>(settings.get());
        return own != nullptr ? std::optional(*own) : std::nullopt;
      });
}

/// All kinds, in the order of the reference page.
std::span<const SamplerModel* const> sampler_models();

}  // namespace ifov::io
