#include "session/facade/tile_quantities.h"

#include <cstddef>
#include <utility>

#include "core/error.h"
#include "core/names.h"
#include "io/quantities/quantity.h"
#include "io/quantities/radiance_quantities.h"
#include "io/run_state/run_plan.h"
#include "sampling/tile.h"

namespace ifov::session {
namespace {

std::vector<std::string> bands_of(const io::Quantity& quantity, const render::ImageInfo& image) {
  std::vector<std::string> names;
  switch (quantity.bands) {
    case io::Quantity::Bands::materials: return image.materials;
    case io::Quantity::Bands::named: return {quantity.band_names.begin(), quantity.band_names.end()};
    case io::Quantity::Bands::channels:
      for (const render::ChannelInfo& channel : image.channels) names.push_back(channel.name);
      break;
    case io::Quantity::Bands::stokes:
      for (const char* component : {"I", "Q", "U", "V"})
        for (const render::ChannelInfo& channel : image.channels)
          names.push_back(format("{} {}", component, channel.name));
      break;
  }
  return names;
}

/// Those of a plan that there is something for, without the radiance.
io::QuantitySet told_by(const io::RunPlan& plan) {
  io::QuantitySet told = plan.made_cubes();
  told.remove(io::quantities::kRadiance);
  return told;
}

}  // namespace

/// Keeps what is put, because it is gone afterwards.
class QuantityValues::Kept final : public io::ValueSink {
 public:
  Kept(QuantityValues& all, QuantityDescription description)
      : all_(all), description_(std::move(description)) {}
  void put(std::span<const float> values) override { keep(values); }
  void put(std::span<const double> values) override { keep(values); }
  void put(std::span<const std::uint32_t> values) override { keep(values); }
  void put(std::span<const std::uint16_t> values) override { keep(values); }
  void put(std::span<const std::uint8_t> values) override { keep(values); }

 private:
  template <class Value>
  void keep(std::span<const Value> values) {
    const std::span<const std::byte> bytes = std::as_bytes(values);
    const auto& kept = all_.bytes_.emplace_back(bytes.begin(), bytes.end());
    all_.spans_.push_back(
        {std::move(description_), std::span(reinterpret_cast<const Value*>(kept.data()), values.size())});
  }

  QuantityValues& all_;
  QuantityDescription description_;
};

io::QuantitySet quantities_named(const std::vector<std::string>& words) {
  io::QuantitySet named;
  for (const std::string& word : words) {
    if (word == "all") return io::QuantitySet::all();
    const io::Quantity* const quantity = io::find_quantity(word);
    if (quantity == nullptr) {
      std::vector<std::string> choices{"all"};
      for (const io::Quantity* known : io::all_quantities()) choices.emplace_back(known->name);
      throw InputError(format("quantities: found '{}'; expected {}{}", word, list_names(choices),
                              did_you_mean(word, choices)));
    }
    named.add(*quantity);
  }
  return named;
}

AskedQuantities::AskedQuantities(const io::RunPlan& plan) : plan_(plan) {
  for (const io::Quantity* quantity : told_by(plan))
    descriptions_.push_back({std::string(quantity->name), std::string(quantity->what),
                             quantity->unit.empty() ? plan.image.radiance_unit : std::string(quantity->unit),
                             bands_of(*quantity, plan.image)});
}

QuantityValues AskedQuantities::of(const sampling::TileResult& tile) const {
  QuantityValues values;
  std::size_t k = 0;
  for (const io::Quantity* quantity : told_by(plan_)) {
    QuantityValues::Kept kept(values, descriptions_[k++]);
    quantity->values({tile, plan_.image, plan_.identity.acquisition}, kept);
  }
  return values;
}

}  // namespace ifov::session
