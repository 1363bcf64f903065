#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "io/products/quantity_header.h"
#include "io/quantities/converted_quantities.h"
#include "io/quantities/geometry_quantities.h"
#include "io/quantities/identity_quantities.h"
#include "io/quantities/location_quantities.h"
#include "io/quantities/mosaic_quantities.h"
#include "io/quantities/part_quantities.h"
#include "io/quantities/polarization_quantities.h"
#include "io/quantities/quality_quantities.h"
#include "io/quantities/quantity_set.h"
#include "io/quantities/radiance_quantities.h"
#include "io/quantities/share_quantities.h"
#include "io/quantities/sunlight_quantities.h"
#include "io/quantities/temperature_quantity.h"
#include "io/synthetic_image.h"
#include "sensor/detector/mosaic.h"
#include "truth/gsd.h"
#include "truth/identity.h"
#include "truth/location.h"
#include "truth/orientation.h"
#include "truth/pixel_fluxes.h"
#include "truth/pixel_temperature.h"
#include "truth/range.h"
#include "truth/sky_view.h"
#include "truth/sunlight.h"
#include "truth/temperature.h"
#include "truth/time.h"
#include "truth/view_angles.h"

namespace ifov::io::test_quantities {
namespace {

using test::SyntheticImage;

/// How many values of which type it was given.
class Counting final : public ValueSink {
 public:
  void put(std::span<const float> values) override { take(values, EnviType::float32); }
  void put(std::span<const double> values) override { take(values, EnviType::float64); }
  void put(std::span<const std::uint32_t> values) override { take(values, EnviType::uint32); }
  void put(std::span<const std::uint16_t> values) override { take(values, EnviType::uint16); }
  void put(std::span<const std::uint8_t> values) override { take(values, EnviType::byte); }
  std::size_t count = 0;
  int calls = 0;
  EnviType type = EnviType::int16;

 private:
  template <class Value>
  void take(std::span<const Value> values, EnviType of) {
    count = values.size(), type = of, ++calls;
  }
};

TEST(Quantities, RowsAreWhatTheyWrite) {
  const SyntheticImage image{9, 7, 5};
  const sampling::TileResult tile = image.tile({0, 0, 8, 7});
  render::ImageInfo info = image.info();
  info.mosaic = std::make_shared<const sensor::Mosaic>(sensor::Mosaic{2, 1, {0, 1}});
  std::set<std::string_view> names;
  for (const Quantity* quantity : all_quantities()) {
    EXPECT_TRUE(names.insert(quantity->name).second) << quantity->name;
    EXPECT_EQ(find_quantity(quantity->name), quantity);
    EXPECT_FALSE(quantity->what.empty());
    const bool radiance =
        quantity->bands == Quantity::Bands::stokes || quantity->needs.mosaic ||
        (quantity->is_spectral() && !quantity->needs.stokes && quantity->name.find("transmittance") != 0 &&
         quantity->name.find("radiance_per_nm") != 0 && !quantity->needs.emissivity &&
         !quantity->needs.sunlight && !quantity->needs.responses);
    EXPECT_EQ(quantity->unit.empty(), radiance) << quantity->name;
    EXPECT_EQ(quantity->band_names.empty(), quantity->bands != Quantity::Bands::named) << quantity->name;
    Counting sink;
    quantity->values({tile, info, {}}, sink);
    EXPECT_EQ(sink.calls, 1) << quantity->name;
    EXPECT_EQ(sink.type, quantity->type) << quantity->name;
    EXPECT_EQ(sink.count, 56u * static_cast<std::size_t>(quantity->band_count(info))) << quantity->name;
    const EnviHeader header = header_of(*quantity, info, image.identity(), "");
    EXPECT_EQ(header.bands, quantity->band_count(info));
    EXPECT_EQ(header.band_names.size(), static_cast<std::size_t>(header.bands)) << quantity->name;
    EXPECT_EQ(header.data_units, quantity->unit.empty() ? info.radiance_unit : quantity->unit);
  }
  EXPECT_EQ(find_quantity("radiances"), nullptr);
}

TEST(Quantities, EachIsInTheDocumentation) {
  std::ifstream file(IFOV_SOURCE_DIR "/docs/formats/products.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const Quantity* quantity : all_quantities())
    EXPECT_NE(page.str().find("_" + std::string(quantity->name) + ".img"), std::string::npos)
        << quantity->name;
}

TEST(QuantitySet, KeepsTheOrderOfTheTable) {
  const QuantitySet one{&quantities::kLocation, &quantities::kRadiance},
      same{&quantities::kRadiance, &quantities::kLocation};
  EXPECT_TRUE(one == same);
  EXPECT_EQ(*one.begin(), &quantities::kRadiance);
  QuantitySet all = QuantitySet::all();
  EXPECT_EQ(all.size(), all_quantities().size());
  all.add(quantities::kRadiance);
  EXPECT_EQ(all.size(), all_quantities().size());
  all.remove(quantities::kRadiance);
  EXPECT_FALSE(all.has(quantities::kRadiance));
}

TEST(QuantitySet, UsualOnesLeaveOutWhatTheMapTells) {
  EXPECT_TRUE(usual_quantities(false).has(quantities::kLocation));
  EXPECT_FALSE(usual_quantities(true).has(quantities::kLocation));
  EXPECT_FALSE(usual_quantities(true).has(quantities::kStandardError));
  EXPECT_FALSE(usual_quantities(true).has(quantities::kStokes));
  EXPECT_TRUE(usual_quantities(true, true).has(quantities::kStokes));
}

TEST(QuantitySet, OnlyWhatThereIsSomethingForIsPossible) {
  render::ImageInfo image = SyntheticImage{4, 4, 2}.info();
  EXPECT_FALSE(possible_quantities(QuantitySet::all(), image).has(quantities::kAtmosphereHalfWidth));
  image.channels[1].air.emplace();
  EXPECT_FALSE(possible_quantities(QuantitySet::all(), image).has(quantities::kDolp));
  image.stokes = true;
  EXPECT_FALSE(possible_quantities(QuantitySet::all(), image).has(quantities::kToaReflectance));
  image.channels[1].toa_irradiance = 1200.0;
  EXPECT_FALSE(possible_quantities(QuantitySet::all(), image).has(quantities::kMosaic));
  image.mosaic = std::make_shared<const sensor::Mosaic>(sensor::Mosaic{2, 1, {0, 1}});
  EXPECT_FALSE(possible_quantities(QuantitySet::all(), image).has(quantities::kThermalHalfWidth));
  image.solved = true;
  EXPECT_EQ(possible_quantities(QuantitySet::all(), image).size(), all_quantities().size());
  image.materials.clear();
  image.stokes = false;
  image.channels[1].toa_irradiance = 0.0;
  image.mosaic = nullptr;
  const QuantitySet bare = possible_quantities(QuantitySet::all(), image, false);
  EXPECT_TRUE(bare == QuantitySet({&quantities::kRadiance,
                                   &quantities::kRadiancePerNm,
                                   &quantities::kBandRadiance,
                                   &quantities::kPhotonRadiance,
                                   &quantities::kBrightnessTemperature,
                                   &quantities::kSamples,
                                   &quantities::kQuality,
                                   &quantities::kReasons,
                                   &quantities::kQualityClass,
                                   &quantities::kLocation,
                                   &quantities::kTrueLocation,
                                   &quantities::kViewAngles,
                                   &quantities::kTemperature,
                                   &quantities::kPixelTemperature,
                                   &quantities::kFluxes,
                                   &quantities::kRange,
                                   &quantities::kNormal,
                                   &quantities::kSlope,
                                   &quantities::kGsd,
                                   &quantities::kTime,
                                   &quantities::kSunAngles,
                                   &quantities::kShadow,
                                   &quantities::kSkyView,
                                   &quantities::kObjectClass,
                                   &quantities::kInstance,
                                   &quantities::kEmissivity,
                                   &quantities::kEmittedRadiance,
                                   &quantities::kSunRadiance,
                                   &quantities::kSkyRadiance,
                                   &quantities::kSceneRadiance,
                                   &quantities::kPathRadiance,
                                   &quantities::kTransmittance}));
  EXPECT_TRUE(possible_quantities({}, image).has(quantities::kRadiance));
}

TEST(QuantitySet, WhatTheyNeedIsNoted) {
  EXPECT_EQ(collectors_of(QuantitySet::all()),
            (std::vector{&truth::kLocation, &truth::kTrueLocation, &truth::kViewAngles, &truth::kTemperature,
                         &truth::kPixelTemperature, &truth::kPixelFluxes, &truth::kRange, &truth::kNormal,
                         &truth::kSlope, &truth::kGsd, &truth::kTime, &truth::kSunAngles, &truth::kShadow,
                         &truth::kSkyView, &truth::kMaterial, &truth::kInstance}))
      << "objects and instances come of one";
  EXPECT_TRUE(collectors_of({&quantities::kRadiance}).empty());
}

/// Keeps what it was given.
class Classes final : public ValueSink {
 public:
  void put(std::span<const float>) override { FAIL(); }
  void put(std::span<const double>) override { FAIL(); }
  void put(std::span<const std::uint32_t>) override { FAIL(); }
  void put(std::span<const std::uint16_t> given) override { values.assign(given.begin(), given.end()); }
  void put(std::span<const std::uint8_t>) override { FAIL(); }
  std::vector<int> values;
};

TEST(Quantities, ObjectsOfTheDocumentAreClasses) {
  render::ImageInfo image = SyntheticImage{5, 1, 2}.info();
  image.objects = {"lawn", "empty list", "trees, {tall}", "lamps"};
  image.first_of_objects = {0, 1, 1, 41};
  sampling::TileResult tile;
  tile.reset({0, 0, 5, 1}, 2, false);
  tile.layers.push_back(test::layer_of<std::uint32_t>(truth::kInstance.name, 1, {0, 1, 2, 41, 42}));
  Classes sink;
  quantities::kObjectClass.values({tile, image, {}}, sink);
  EXPECT_EQ(sink.values, (std::vector{0, 1, 3, 3, 4}));
  EnviHeader header;
  quantities::kObjectClass.complete_header(header, image);
  EXPECT_TRUE(header.is_classification);
  EXPECT_EQ(header.other["classes"], "5");
  EXPECT_EQ(header.other["class names"], "nothing, lawn, empty list, trees; (tall), lamps");
  const std::string colours = header.other["class lookup"];
  EXPECT_EQ(std::count(colours.begin(), colours.end(), ','), 14);
  EXPECT_EQ(colours.substr(0, 8), "0, 0, 0,");
}

TEST(Quantities, TheDominantMaterialHasTheLargestShare) {
  const render::ImageInfo image = SyntheticImage{3, 1, 2}.info();
  sampling::TileResult tile;
  tile.reset({0, 0, 3, 1}, 2, false);
  tile.abundances = {
      {0, 0, 0.3f, 0.1f}, {0, 2, 0.7f, 0.1f}, {1, 1, 0.5f, 0.1f}, {1, 2, 0.5f, 0.1f}, {2, 0, 0.0f, 0.1f}};
  Classes dominant, count;
  quantities::kDominantMaterial.values({tile, image, {}}, dominant);
  quantities::kMaterialCount.values({tile, image, {}}, count);
  EXPECT_EQ(dominant.values, (std::vector{3, 2, 0})) << "the first of equals; none where none has a share";
  EXPECT_EQ(count.values, (std::vector{2, 2, 0}));
}

}  // namespace
}  // namespace ifov::io::test_quantities
