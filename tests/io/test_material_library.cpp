#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "io/document/product_words.h"
#include "io/figures/material_plot.h"
#include "io/library/library_table.h"
#include "io/library/material_library.h"
#include "io/library/material_text.h"
#include "io/library/usual_scattering.h"
#include "io/spectra/csv_spectrum.h"
#include "io/spectra/usgs.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_material_library {
namespace {

const LibraryCurve& curve(const std::string& material, int number = 1) {
  const LibraryMaterial& found = material_library().find(material);
  return found.curves[found.curve_numbered(number)];
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MaterialLibrary, HoldsWhatScenesNeed) {
  const MaterialLibrary& library = material_library();
  EXPECT_GE(library.materials().size(), 40u);
  std::set<std::string> names, groups;
  std::size_t curves = 0, with_transmittance = 0;
  for (const LibraryMaterial& material : library.materials()) {
    EXPECT_TRUE(names.insert(material.name).second) << material.name;
    groups.insert(material.group());
    curves += material.curves.size();
    EXPECT_FALSE(material.about.empty()) << material.name;
    std::set<std::string> curve_names;
    for (const LibraryCurve& one : material.curves) {
      EXPECT_TRUE(curve_names.insert(one.name).second) << material.name << " " << one.name;
      EXPECT_NEAR(one.reflectance.first_um(), 0.35, 1e-12) << material.name;
      EXPECT_NEAR(one.reflectance.last_um(), 14.0, 1e-12) << material.name;
      EXPECT_GE(one.reflectance.minimum(), 0.0);
      EXPECT_LE(one.reflectance.maximum(), 1.0);
      EXPECT_FALSE(one.sample.empty());
      ASSERT_FALSE(one.origins.empty()) << material.name;
      for (const std::string& origin : one.origins)
        EXPECT_NE(origin.find("Licence"), std::string::npos) << material.name;
      EXPECT_GE(one.emissivity().minimum(), 0.0);
      if (!one.transmittance) continue;
      ++with_transmittance;
      EXPECT_EQ(one.transmittance->at(3.0), 0.0);
      for (std::size_t i = 0; i < one.reflectance.values().size(); ++i)
        EXPECT_LE(one.reflectance.values()[i] + one.transmittance->values()[i], 1.0 + 1e-4) << material.name;
    }
  }
  EXPECT_EQ(groups, (std::set<std::string>{"vegetation", "soil", "water", "construction", "roof", "metal"}));
  EXPECT_GE(curves, 100u);
  EXPECT_GE(with_transmittance, 8u);
}

/// Every wavelength of every curve is either within what was measured or modelled, or flagged.
TEST(MaterialLibrary, EveryMaterialHasAUsualWayToScatter) {
  std::set<const UsualScattering*> used;
  for (const LibraryMaterial& material : material_library().materials()) {
    const UsualScattering* usual = usual_scattering_of(material.name);
    ASSERT_NE(usual, nullptr) << material.name;
    used.insert(usual);
  }
  for (const UsualScattering& row : usual_scattering()) EXPECT_TRUE(used.contains(&row)) << row.names;
  EXPECT_EQ(usual_scattering_of("wool"), nullptr);
}

TEST(MaterialLibrary, NothingUnmeasuredIsUnflagged) {
  for (const LibraryMaterial& material : material_library().materials())
    for (const LibraryCurve& one : material.curves)
      for (const double um : one.reflectance.wavelength_um()) {
        bool known = um >= one.first_um - 1e-3 && um <= one.last_um + 1e-3;
        for (const LentRange& range : one.lent)
          known = known || (um >= range.first_um - 1e-3 && um <= range.last_um + 1e-3);
        ASSERT_TRUE(known) << material.name << ", " << one.name << " at " << um;
      }
}

/// Features that textbooks name, so that no curve is swapped for another.
TEST(MaterialLibrary, CurvesLookLikeTheirNames) {
  const auto red_edge = [](const radiometry::Spectrum& s) {
    return (s.at(0.86) - s.at(0.66)) / (s.at(0.86) + s.at(0.66));
  };
  EXPECT_GT(red_edge(curve("grass, lawn").reflectance), 0.7);
  EXPECT_GT(red_edge(curve("leaf, aspen").reflectance), 0.6);
  EXPECT_LT(red_edge(curve("leaf, aspen, yellow").reflectance), 0.2);
  EXPECT_LT(red_edge(curve("grass, dry").reflectance), 0.3);
  EXPECT_LT(std::abs(red_edge(curve("asphalt, street").reflectance)), 0.1);
  EXPECT_GT(curve("snow, melting").reflectance.at(0.55), 0.8);
  EXPECT_LT(curve("snow, melting").reflectance.at(1.65), 0.03);
  EXPECT_GT(curve("snow, melting").reflectance.at(1.1), 1.2 * curve("snow, melting", 3).reflectance.at(1.1));
  EXPECT_LT(curve("water, pure").reflectance.at(1.65), 0.03);
  EXPECT_GT(curve("water, pure").emissivity().at(11.0), 0.98);
  EXPECT_GT(curve("water, swimming pool").reflectance.at(0.48),
            10 * curve("water, swimming pool").reflectance.at(0.9));
  EXPECT_LT(curve("soil, bare", 2).reflectance.at(0.65), 0.7 * curve("soil, bare").reflectance.at(0.65));
  EXPECT_GT(curve("sand, beach").reflectance.at(9.0), 3 * curve("sand, beach").reflectance.at(11.5));
  EXPECT_GT(curve("brick, red").reflectance.at(0.66), 2 * curve("brick, red").reflectance.at(0.45));
  EXPECT_GT(curve("tree crown, conifer").emissivity().at(11.0), 0.97);
  EXPECT_LT(curve("aluminium, stucco").emissivity().at(10.0), 0.2);
  EXPECT_LT(curve("aluminium, brushed").emissivity().at(10.0), 0.1);
}

/// P. B. Johnson and R. W. Christy, Phys. Rev. B 6 (1972) 4370: n, k of evaporated films at 1.14 and 3.5 eV
/// or so; of aluminium the reflectance that G. Hass gives (AIP Handbook 1972).
TEST(MaterialLibrary, PolishedMetalsReflectAsHandbooksSay) {
  EXPECT_NEAR(curve("aluminium, polished").reflectance.at(0.55), 0.915, 0.015);
  EXPECT_NEAR(curve("aluminium, polished").reflectance.at(0.83), 0.87, 0.02);
  EXPECT_NEAR(curve("aluminium, polished").reflectance.at(10.0), 0.987, 0.008);
  EXPECT_NEAR(curve("gold, polished").reflectance.at(0.45), 0.39, 0.04);
  EXPECT_NEAR(curve("gold, polished").reflectance.at(1.0), 0.98, 0.02);
  EXPECT_NEAR(curve("silver, polished").reflectance.at(0.6), 0.98, 0.02);
}

/// Mean of a table's column over a band, straight lines between its points.
double column_mean(const std::filesystem::path& path, const std::string& name, double scale, double first,
                   double last) {
  CsvSpectrumOptions options;
  options.value_name = name;
  options.unit = first > 100.0 ? WavelengthUnit::nanometres : WavelengthUnit::micrometres;
  options.scale = scale;
  const double to_um = first > 100.0 ? 1e-3 : 1.0;
  return radiometry::integral(read_csv_spectrum(path, options), first * to_um, last * to_um) /
         ((last - first) * to_um);
}

TEST(MaterialLibrary, FiguresKeepTheSamplesBandMeans) {
  const auto visible = test::truth_file("spectra/open/slum-london/LUMA_SLUM_SW.csv");
  const auto thermal = test::truth_file("spectra/open/slum-london/LUMA_SLUM_IR.csv");
  if (!visible || !thermal) GTEST_SKIP() << "reference data not found: spectra/open/slum-london";
  const radiometry::Spectrum& figures = curve("brick, red").reflectance;  // B013
  for (double um = 0.40; um < 2.48; um += 0.04)
    EXPECT_NEAR(radiometry::integral(figures, um, um + 0.02) / 0.02,
                column_mean(*visible, "B013", 0.01, 1e3 * um, 1e3 * um + 20.0), 1e-3)
        << um;
  for (double um = 8.1; um < 13.6; um += 0.4)
    EXPECT_NEAR(1.0 - radiometry::integral(figures, um, um + 0.2) / 0.2,
                column_mean(*thermal, "B013", 1.0, um, um + 0.2), 1e-3)
        << um;
}

/// USGS splib07a, Lawn_Grass GDS91: the reader of the program and the tool that made the tables agree.
TEST(MaterialLibrary, FiguresAreThoseOfTheUsgsReader) {
  const auto grass = test::truth_file("spectra/usgs7/splib07a_Lawn_Grass_GDS91_green_BECKa_AREF.txt");
  const auto wavelengths =
      test::truth_file("spectra/usgs7/splib07a_Wavelengths_BECK_Beckman_0.2-3.0_microns.txt");
  if (!grass || !wavelengths) GTEST_SKIP() << "reference data not found: spectra/usgs7";
  const radiometry::Spectrum sample = read_usgs(*grass, *wavelengths).values;
  const radiometry::Spectrum& figures = curve("grass, blades, pile").reflectance;
  for (double um = 0.42; um < 2.4; um += 0.05)
    EXPECT_NEAR(radiometry::integral(figures, um, um + 0.05), radiometry::integral(sample, um, um + 0.05),
                5e-5)
        << um;
}

/// Fresnel's equations for published n + ik: Hale and Querry's water at 10 um (1.218 + 0.0508i).
TEST(MaterialLibrary, WaterReflectsAsItsIndexSays) {
  const auto face = [](double n, double k) {
    return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  };
  EXPECT_NEAR(curve("water, pure").reflectance.at(10.0), face(1.218, 0.0508), 2e-4);
  EXPECT_NEAR(curve("water, pure").reflectance.at(0.55), face(1.333, 0.0), 2e-4);
  // Two faces of clear glass, n 1.52, without absorption: 2 r / (1 + r).
  const double r = face(1.52, 0.0);
  EXPECT_NEAR(curve("glass, window").reflectance.at(0.55), 2 * r / (1 + r), 3e-3);
}

TEST(MaterialLibrary, FindsAndSuggests) {
  const MaterialLibrary& library = material_library();
  EXPECT_EQ(library.find("GRASS, Lawn").name, "grass, lawn");
  EXPECT_EQ(message_of([&] { library.find("gras, lawn"); }),
            "the library has no material 'gras, lawn'; did you mean 'grass, lawn'?");
  EXPECT_EQ(message_of([&] { library.find("lawn"); }),
            "the library has no material 'lawn'; near it: 'grass, lawn', 'grass, lawn, sparse' and "
            "'grass, blades, pile'");
  EXPECT_EQ(message_of([&] { library.find("unobtainium"); }),
            "the library has no material 'unobtainium'; 'ifov materials' lists them all");
  EXPECT_EQ(
      message_of([&] { library.find("Water, lake"); }),
      "'Water, lake' is in the library no more, for its figures have no open licence; nearest to it is 'water, "
      "coastal'. A file of your own is read by \"ecostress\" or another key of spectra");
  EXPECT_EQ(library.search("train rail").size(), 0u);
  EXPECT_EQ(library.search("track rail").front()->name, "stone, granite");
  EXPECT_EQ(library.search("").size(), library.materials().size());
  const LibraryMaterial& brick = library.find("brick, red");
  EXPECT_EQ(brick.curve_named("b004"), 1u);
  EXPECT_EQ(message_of([&] { brick.curve_named("GDS355"); }),
            "the material 'brick, red' has no curve 'GDS355'; did you mean 'GDS350'? It has 'B013', 'B004', "
            "'GDS350' and 'GDS353'");
  EXPECT_EQ(message_of([&] { brick.curve_numbered(5); }),
            "the material 'brick, red' has no curve 5; it has 1 to 4");
}

TEST(MaterialLibrary, TheTableOfACurveIsReadBackByTheCsvReader) {
  const LibraryMaterial& leaf = material_library().find("leaf, aspen");
  const std::array<std::size_t, 1> first{0};
  const TextFile text("aspen.csv", material_csv(leaf, first));
  CsvSpectrumOptions options;
  options.value_name = "transmittance_1";
  const radiometry::Spectrum read = parse_csv_spectrum(text, options);
  ASSERT_EQ(read.values().size(), leaf.curves[0].reflectance.values().size());
  EXPECT_NEAR(read.at(0.86), leaf.curves[0].transmittance->at(0.86), 1e-9);
}

TEST(MaterialLibrary, DrawsAPicture) {
  if (const std::string why = why_not_built("png"); !why.empty()) GTEST_SKIP() << why;
  const LibraryMaterial& leaf = material_library().find("leaf, aspen");
  const std::array<std::size_t, 1> first{0};
  const std::string png = plot_material(leaf, first);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
}

/// What a document may still name leads to something that there is, and is not there itself.
TEST(MaterialLibrary, NamesOfEarlierLibrariesLeadOn) {
  const MaterialLibrary& library = material_library();
  std::set<std::string> names;
  for (const LibraryMaterial& material : library.materials())
    for (const std::string& name : material.instead_of) {
      EXPECT_FALSE(library.has(name)) << name;
      EXPECT_TRUE(names.insert(name).second) << name;
      EXPECT_NE(message_of([&] { library.find(name); }).find("'" + material.name + "'"), std::string::npos);
    }
  EXPECT_GE(names.size(), 30u);
}

TEST(MaterialLibrary, TablesThatAreNotWellFormedAreLocated) {
  const auto error_of = [](const std::string& text) {
    return message_of([&] { parse_library_table(TextFile("t.txt", text)); });
  };
  const std::string good =
      "grid: 1 1 3\norigin: a Paper. Licence: free.\n\nmaterial: m\nwords: g m\nabout: x\ncurve: c\nsample: "
      "s\nsource: a\n"
      "measured: 1 3\nreflectance: 1000 2000 3000\ntransmittance: 500\n";
  const std::vector<LibraryMaterial> parsed = parse_library_table(TextFile("t.txt", good));
  ASSERT_EQ(parsed.size(), 1u);
  EXPECT_DOUBLE_EQ(parsed[0].curves[0].reflectance.at(2.5), 0.25);
  EXPECT_DOUBLE_EQ(parsed[0].curves[0].transmittance->at(1.0), 0.05);
  EXPECT_DOUBLE_EQ(parsed[0].curves[0].transmittance->at(2.0), 0.0);
  EXPECT_EQ(error_of("grid: 1 1 3\nmaterial: m\ncurve: c\nreflectance: 1 2\n"),
            "t.txt:4: found 2 figures for 3 wavelengths\n  reflectance: 1 2");
  EXPECT_EQ(error_of("curve: c\n"), "t.txt:1: found no 'material' above\n  curve: c");
  EXPECT_EQ(error_of("material: m\ncurve: c\nsource: b\n"),
            "t.txt:3: no 'origin' is called 'b'\n  source: b");
  EXPECT_EQ(error_of("material: m\n"),
            "t.txt: the material 'm' has no words, no curve, or one without figures or source");
}

}  // namespace
}  // namespace ifov::io::test_material_library
