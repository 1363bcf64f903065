#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "io/library/library_table.h"
#include "io/library/material_library.h"
#include "io/library/material_plot.h"
#include "io/library/material_text.h"
#include "io/spectra/csv_spectrum.h"
#include "io/spectra/ecostress.h"
#include "io/spectra/sample_spectrum.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io {
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
      EXPECT_NE(one.origin.find("Licence"), std::string::npos) << material.name;
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
  EXPECT_GT(red_edge(curve("leaf, red maple").reflectance), 0.6);
  EXPECT_LT(red_edge(curve("grass, wild oat, dry").reflectance), 0.5);
  EXPECT_LT(std::abs(red_edge(curve("asphalt, street").reflectance)), 0.1);
  EXPECT_GT(curve("snow, fine").reflectance.at(0.55), 0.95);
  EXPECT_LT(curve("snow, fine").reflectance.at(1.65), 0.3);
  EXPECT_GT(curve("snow, fine").reflectance.at(1.3), 1.5 * curve("snow, coarse").reflectance.at(1.3));
  EXPECT_LT(curve("water, tap").reflectance.at(1.65), 0.03);
  EXPECT_GT(curve("water, tap").emissivity().at(11.0), 0.98);
  EXPECT_GT(curve("sand, brown quartz").reflectance.at(9.0),
            3 * curve("sand, brown quartz").reflectance.at(11.5));
  EXPECT_GT(curve("brick, red").reflectance.at(0.66), 2 * curve("brick, red").reflectance.at(0.45));
  EXPECT_LT(curve("aluminium, weathered").emissivity().at(10.0), 0.1);
  // The published figure of this sample, which is dark for a metal; the library says so.
  EXPECT_NEAR(curve("steel, galvanised").reflectance.at(10.1), 0.049629, 1e-3);
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

TEST(MaterialLibrary, FiguresKeepTheSamplesBandMeans) {
  const auto grass =
      test::truth_file("spectra/ecostress/vegetation.tree.acer.rubrum.vswir.acru-1-13.ucsb.asd.spectrum.txt");
  const auto thermal = test::truth_file(
      "spectra/ecostress/vegetation.tree.acer.rubrum.tir.acru-1-13.ucsb.nicolet.spectrum.txt");
  if (!grass || !thermal) GTEST_SKIP() << "reference data not found: spectra/ecostress";
  const radiometry::Spectrum sample =
      join(read_ecostress(*grass).reflectance, read_ecostress(*thermal).reflectance);
  const radiometry::Spectrum& figures = curve("leaf, red maple").reflectance;
  for (double um = 0.36; um < 2.48; um += 0.01)  // bands of 20 nm
    EXPECT_NEAR(radiometry::integral(figures, um - 0.01, um + 0.01) / 0.02,
                radiometry::integral(sample, um - 0.01, um + 0.01) / 0.02, 1e-3)
        << um;
  for (double um = 8.0; um < 13.0; um += 0.1)
    EXPECT_NEAR(radiometry::integral(figures, um, um + 0.2) / 0.2,
                radiometry::integral(sample, um, um + 0.2) / 0.2, 1e-3)
        << um;
}

TEST(MaterialLibrary, FindsAndSuggests) {
  const MaterialLibrary& library = material_library();
  EXPECT_EQ(library.find("GRASS, Lawn").name, "grass, lawn");
  EXPECT_EQ(message_of([&] { library.find("gras, lawn"); }),
            "the library has no material 'gras, lawn'; did you mean 'grass, lawn'?");
  EXPECT_EQ(message_of([&] { library.find("lawn"); }),
            "the library has no material 'lawn'; near it: 'grass, lawn' and 'grass, lawn, sparse'");
  EXPECT_EQ(message_of([&] { library.find("unobtainium"); }),
            "the library has no material 'unobtainium'; 'ifov materials' lists them all");
  EXPECT_EQ(library.search("tennis court").front()->name, "cinder, red");
  EXPECT_EQ(library.search("").size(), library.materials().size());
  const LibraryMaterial& brick = library.find("brick, red");
  EXPECT_EQ(brick.curve_named("0412uuubrk"), 1u);
  EXPECT_EQ(message_of([&] { brick.curve_named("0412UUUBRX"); }),
            "the material 'brick, red' has no curve '0412UUUBRX'; did you mean '0412UUUBRK'? It has "
            "'0097UUUBRK' and "
            "'0412UUUBRK'");
  EXPECT_EQ(message_of([&] { brick.curve_numbered(3); }),
            "the material 'brick, red' has no curve 3; it has 1 to 2");
}

TEST(MaterialLibrary, TheTableOfACurveIsReadBackByTheCsvReader) {
  const LibraryMaterial& maple = material_library().find("leaf, red maple");
  const std::array<std::size_t, 1> first{0};
  const TextFile text("maple.csv", material_csv(maple, first));
  CsvSpectrumOptions options;
  options.value_name = "transmittance_1";
  const radiometry::Spectrum read = parse_csv_spectrum(text, options);
  ASSERT_EQ(read.values().size(), maple.curves[0].reflectance.values().size());
  EXPECT_NEAR(read.at(0.86), maple.curves[0].transmittance->at(0.86), 1e-9);
}

TEST(MaterialLibrary, DrawsAPicture) {
  const LibraryMaterial& maple = material_library().find("leaf, red maple");
  const std::array<std::size_t, 1> first{0};
  const std::string png = plot_material(maple, first);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
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
}  // namespace ifov::io
