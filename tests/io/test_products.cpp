#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "io/document/output_document.h"
#include "io/document/product_words.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/product_parts/sha256.h"
#include "io/products/envi_reader.h"
#include "io/products/geotiff.h"
#include "io/products/netcdf.h"
#include "io/quantities/location_quantities.h"
#include "io/quantities/quality_classes.h"
#include "io/quantities/quality_quantities.h"
#include "io/quantities/temperature_quantity.h"
#include "io/written_image.h"
#include "sampling/intervals/bounded_error.h"
#include "truth/location.h"
#include "truth/view_angles.h"

namespace ifov::io::test_products {
namespace {

using namespace written_image;

TEST(ProductFormats, HaveTheWordsOfDocuments) {
  std::vector<std::string> named;
  for (const ProductFormat* format : all_product_formats())
    if (!format->name.empty()) named.emplace_back(format->name);
  const std::vector<std::string> words(product_words().begin(), product_words().end());
  EXPECT_EQ(named, words);
  EXPECT_TRUE(product_formats(words).has(formats::kGeotiff));
  EXPECT_FALSE(product_formats(std::vector<std::string>{"envi"}).has(formats::kGeotiff));
  EXPECT_THROW(product_formats(std::vector<std::string>{"tiff"}), std::logic_error);
  EXPECT_EQ(product_formats(OutputDocument().formats).list(), usual_product_formats().list());
}

TEST(ProductWriter, OddSizesInAnyTileOrder) {
  const struct {
    SyntheticImage image;
    int side;
  } cases[] = {{{37, 23, 7}, 16}, {{1, 1, 1}, 16},   {{64, 16, 17}, 16},
               {{5, 130, 3}, 64}, {{130, 5, 33}, 7}, {{256, 9, 19}, 16}};
  for (const auto& c : cases)
    for (const std::uint64_t seed : {1u, 2u}) {
      const ScratchFolder folder("order");
      write_image(c.image, options_in(folder.path()), shuffled(c.image.tiles(c.side), seed));
      expect_all_cubes(c.image, folder.path());
    }
}

TEST(ProductWriter, TilesOfUnequalRowsAreWrittenSegmentBySegment) {
  const SyntheticImage image{20, 12, 5};
  const ScratchFolder folder("uneven");
  write_image(image, options_in(folder.path()),
              {{0, 0, 8, 12}, {8, 0, 20, 5}, {8, 5, 14, 12}, {14, 5, 20, 12}});
  expect_all_cubes(image, folder.path());
}

TEST(ProductWriter, SameBytesFromAnyNumberOfThreads) {
  const SyntheticImage image{61, 47, 9};
  const ScratchFolder one("threads1"), seven("threads7");
  const RunRecord a = write_image(image, options_in(one.path()), image.tiles(16));
  const RunRecord b = write_image(image, options_in(seven.path()), shuffled(image.tiles(16), 9), 7);
  ASSERT_EQ(a.files.size(), b.files.size());
  for (std::size_t i = 0; i < a.files.size(); ++i)
    EXPECT_EQ(a.files[i].sha256, b.files[i].sha256) << a.files[i].path;
  for (const auto& name : names_in(one.path()))
    EXPECT_EQ(test::read_all(one.path() / name), test::read_all(seven.path() / name)) << name;
}

/// All that is made of cubes is the same, and so are the figures that are told of them.
TEST(ProductWriter, InterleavesDifferInTheOrderOfValuesAlone) {
  const SyntheticImage image{61, 47, 9};
  const ScratchFolder bil("bil");
  ProductOptions options = options_in(bil.path());
  options.formats.add(formats::kGeotiff);
  options.formats.add(formats::kNetcdf);
  write_image(image, options, image.tiles(16));
  for (const std::string word : {"bsq", "bip"}) {
    const ScratchFolder folder("interleave");
    options.folder = folder.path();
    options.interleave = word;
    write_image(image, options, shuffled(image.tiles(16), 3), 3);
    expect_all_cubes(image, folder.path());
    EXPECT_EQ(names_in(folder.path()), names_in(bil.path()));
    for (const std::string& name : names_in(folder.path())) {
      const std::string ours = test::read_all(folder.path() / name);
      std::string others = test::read_all(bil.path() / name);
      if (name.ends_with(".hdr")) {
        ASSERT_NE(ours.find("\ninterleave = " + word + "\n"), std::string::npos) << name;
        others.replace(others.find("interleave = bil"), 16, "interleave = " + word);
      }
      if (name.ends_with("_report.html")) {
        EXPECT_NE(ours.find("ENVI (" + word + ")"), std::string::npos);
        continue;  // which lists files with their checksums
      }
      if (name.ends_with("_run.json")) {
        const DocumentTree record = parse_json(ours, "run.json"), other = parse_json(others, "run.json");
        EXPECT_EQ(JsonView(record)["image"]["interleave"].text(), word);
        EXPECT_EQ(JsonView(other)["image"]["interleave"].text(), "bil");
        for (const char* const figure : {"mean", "standard_deviation", "largest_half_width"})
          EXPECT_EQ(JsonView(record)["channels"].items()[4][figure].number(),
                    JsonView(other)["channels"].items()[4][figure].number());
        for (const JsonView& file : JsonView(record)["files"].items()) {
          const std::string bytes = test::read_all(folder.path() / file["name"].text());
          Sha256 whole;
          whole.update(bytes.data(), bytes.size());
          EXPECT_EQ(file["sha256"].text(), whole.digest()) << file["name"].text();
          if (file["name"].text() == "demo_radiance.img") {
            EXPECT_EQ(file["what"].text(), "radiance, 9 channels, ENVI (" + word + ")");
          }
        }
        continue;
      }
      if (name == "demo_radiance.img") {
        EXPECT_NE(ours, others);
      }
      if (!name.ends_with(".img") || EnviReader(folder.path() / name).header().bands == 1) {
        EXPECT_EQ(ours, others) << name;
      }
    }
  }
}

TEST(ProductWriter, HeaderSaysWhatItIs) {
  const SyntheticImage image{6, 4, 3};
  const ScratchFolder folder("header");
  write_image(image, options_in(folder.path()), image.tiles(16));
  const EnviHeader h = EnviReader(folder.path() / "demo_radiance.img").header();
  EXPECT_EQ(h.interleave, EnviInterleave::bil);
  EXPECT_FALSE(h.big_endian);
  EXPECT_EQ(h.wavelength, (std::vector<double>{0.4, 1.45, 2.5}));
  EXPECT_EQ(h.fwhm, (std::vector<double>{0.01, 0.01, 0.01}));
  EXPECT_EQ(h.wavelength_units, "Micrometers");
  EXPECT_EQ(h.band_names, (std::vector<std::string>{"ch1", "ch2", "ch3"}));
  EXPECT_EQ(h.data_units, "W m-2 sr-1 um-1");
  EXPECT_EQ(h.map_info, (std::vector<std::string>{"Arbitrary", "1", "1", "1000.000000", "2000.000000", "0.5",
                                                  "0.5", "units=Meters"}));
  for (const char* word : {"ifov 0.1.0", "seed 42", "1 % of radiance", "98.3 % of pixels"})
    EXPECT_NE(h.description.find(word), std::string::npos) << word << " in " << h.description;
  EXPECT_EQ(EnviReader(folder.path() / "demo_samples.img").header().data_type, EnviType::uint32);
}

TEST(ProductWriter, RunRecordHoldsFiguresAndChecksums) {
  const SyntheticImage image{33, 21, 4};
  const ScratchFolder folder("record");
  ProductOptions options = options_in(folder.path());
  options.formats.add(formats::kGeotiff);
  write_image(image, options, image.tiles(8));

  const DocumentTree record = parse_json(test::read_all(folder.path() / "demo_run.json"), "run.json");
  const JsonView root(record);
  EXPECT_EQ(root["document"]["text"].text(), image.identity().document_text);
  EXPECT_EQ(root["seed"].natural(), 42u);
  EXPECT_EQ(root["cost"]["samples"]["halo"].natural(), 5 * image.tiles(8).size());
  double sum = 0.0, squares = 0.0, widest = 0.0;
  std::uint64_t samples = 0, converged = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      sum += image.radiance(x, y, 2);
      squares += std::pow(image.radiance(x, y, 2), 2);
      widest = std::max<double>(widest, image.half_width(x, y, 2));
      samples += image.samples(x, y);
      converged += image.ratio(x, y) <= 1.0f;
    }
  const double n = image.width * image.height, mean = sum / n;
  EXPECT_NEAR(root["channels"].items()[2]["mean"].number(), mean, 1e-7 * mean);
  EXPECT_NEAR(root["channels"].items()[2]["standard_deviation"].number(),
              std::sqrt(squares / n - mean * mean), 1e-5);
  EXPECT_NEAR(root["channels"].items()[2]["largest_half_width"].number(), widest, 1e-7 * widest);
  EXPECT_EQ(root["cost"]["samples"]["total"].natural(), samples);
  EXPECT_EQ(root["cost"]["rays"]["primary"].natural(), samples);
  EXPECT_EQ(root["accuracy"]["pixels_converged"].natural(), converged);
  const JsonView by_reason = root["accuracy"]["pixels_by_reason"];
  for (const std::string_view name : sampling::kReasonNames) EXPECT_TRUE(by_reason[name].is_number()) << name;
  EXPECT_EQ(by_reason["samples"].natural(), root["accuracy"]["pixels"].natural() - converged);
  EXPECT_GT(by_reason["unseen light"].natural(), 0u);
  EXPECT_LT(by_reason["unseen light"].natural(), by_reason["samples"].natural());
  EXPECT_EQ(by_reason["air"].natural(), 0u);
  const std::size_t pictures = why_not_built("png").empty() ? 1 : 0;
  ASSERT_EQ(root["files"].items().size(), 22u + pictures);  // 17 cubes, GeoTIFF, style, picture, report
  for (const JsonView& file : root["files"].items()) {
    const std::string bytes = test::read_all(folder.path() / file["name"].text());
    Sha256 whole;
    whole.update(bytes.data(), bytes.size());
    EXPECT_EQ(file["bytes"].natural(), bytes.size());
    EXPECT_EQ(file["sha256"].text(), whole.digest()) << file["name"].text();
  }
}

TEST(ProductWriter, HalfWidthsAreSaidByWhatMakesThem) {
  const SyntheticImage image{8, 8, 2};
  const ScratchFolder folder("parts");
  ProductWriter writer(options_in(folder.path()), image.identity());
  render::ImageInfo info = image.info();
  // 0.1 of the path and 0.2 % of surfaces above a path radiance of 2; of it, 0.04 and 0.1 % by the nodes.
  info.channels[1].air = render::AtmosphereHalfWidth{0.1, 0.002, 0.0, 2.0, 0.0, 0.0, 0.04, 0.001, 0.0};
  writer.begin(info);
  writer.write(image.tile({0, 0, 8, 8}));
  const RunRecord record = writer.finish(image.outcome());
  EXPECT_FALSE(record.statistics.channels[0].parts);
  const ChannelStatistics& s = record.statistics.channels[1];
  ASSERT_TRUE(s.parts);
  EXPECT_NEAR(s.parts->nodes, 0.04 + 0.001 * (s.mean - 2.0), 1e-12);
  EXPECT_NEAR(s.parts->air, 0.06 + 0.001 * (s.mean - 2.0), 1e-12);
  const sampling::BoundedError joint(image.identity().confidence);
  EXPECT_NEAR(joint.half_width(s.parts->sampling, s.parts->air + s.parts->nodes), s.mean_half_width, 1e-9);
  EXPECT_GT(s.parts->sampling, 0.0);
  const std::string page = test::read_all(folder.path() / "demo_report.html");
  EXPECT_NE(page.find("<th>Mean by sampling</th><th>by the air</th><th>by nodes</th>"), std::string::npos);
  const DocumentTree tree = parse_json(test::read_all(folder.path() / "demo_run.json"), "json");
  const JsonView root(tree);
  EXPECT_FALSE(root["channels"].items()[0]["mean_half_width_parts"].is_there());
  EXPECT_NEAR(root["channels"].items()[1]["mean_half_width_parts"]["nodes"].number(), s.parts->nodes, 1e-6);
  EXPECT_NEAR(root["channels"].items()[1]["air_half_width"]["nodes"]["surface"].number(), 0.001, 1e-9);
}

TEST(ProductWriter, ValuesThatAreNotFiniteAreCounted) {
  const SyntheticImage image{8, 8, 2};
  const ScratchFolder folder("nan");
  ProductWriter writer(options_in(folder.path()), image.identity());
  writer.begin(image.info());
  auto tile = image.tile({0, 0, 8, 8});
  tile.mean[0] = std::nanf("");
  tile.half_width[1] = INFINITY;
  writer.write(tile);
  const RunRecord record = writer.finish(image.outcome());
  EXPECT_EQ(record.statistics.channels[0].not_finite, 1u);
  EXPECT_TRUE(std::isfinite(record.statistics.channels[0].mean));
  EXPECT_TRUE(std::isfinite(record.statistics.channels[1].mean_half_width));
}

TEST(ProductWriter, ProductsCanBeLeftAway) {
  const SyntheticImage image{9, 9, 2};
  const ScratchFolder folder("few");
  write_image(image, options_in(folder.path()), image.tiles(16));
  ProductOptions options = options_in(folder.path());
  options.cubes = {&quantities::kSamples, &quantities::kQuality, &quantities::kReasons,
                   &quantities::kQualityClass};
  options.formats = {};
  write_image(image, options, image.tiles(16));  // and what the first run left under these names goes
  EXPECT_EQ(
      names_in(folder.path()),
      (std::vector<std::string>{"demo_quality.img", "demo_quality.img.hdr", "demo_quality_class.img",
                                "demo_quality_class.img.hdr", "demo_radiance.img", "demo_radiance.img.hdr",
                                "demo_radiance.qml", "demo_reasons.img", "demo_reasons.img.hdr",
                                "demo_run.json", "demo_samples.img", "demo_samples.img.hdr"}));
}

TEST(ProductWriter, TilesWithoutVariancesMakeTheSameCubes) {
  const SyntheticImage image{20, 11, 3};
  const ScratchFolder whole("with_variances"), bare("without_variances");
  ProductOptions options = options_in(whole.path());
  options.cubes = usual_quantities(true);
  write_image(image, options, image.tiles(8));
  options.folder = bare.path();
  ProductWriter writer(options, image.identity());
  writer.begin(image.info());
  for (const auto& rect : image.tiles(8)) {
    sampling::TileResult tile = image.tile(rect);
    tile.drop_variances();
    writer.write(tile);
  }
  writer.finish(image.outcome());
  EXPECT_EQ(names_in(whole.path()), names_in(bare.path()));
  for (const std::string& name : names_in(whole.path()))
    if (name.ends_with(".img")) {
      EXPECT_EQ(test::read_all(whole.path() / name), test::read_all(bare.path() / name)) << name;
    }
}

TEST(ProductWriter, PlacesAreWrittenInMapCoordinates) {
  const SyntheticImage image{7, 5, 1};
  const ScratchFolder folder("places");
  ProductOptions options = options_in(folder.path());
  options.cubes = {&quantities::kLocation, &quantities::kViewAngles};
  RunIdentity identity = image.identity();
  identity.acquisition.origin_on_map_m = {477000.0, 5474000.0, 100.0};
  ProductWriter writer(options, identity);
  writer.begin(image.info());
  for (const auto& rect : image.tiles(4)) {
    sampling::TileResult tile = image.tile(rect);
    std::vector<double> positions;
    std::vector<float> angles;
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) {
        positions.insert(positions.end(),
                         {x == 0 ? std::nan("") : x + 0.001953125, x == 0 ? std::nan("") : 500.0 * y, 0.0});
        angles.insert(angles.end(), {x == 0 ? std::nanf("") : 45.0f + 0.25f * static_cast<float>(y),
                                     180.25f - static_cast<float>(x)});
      }
    tile.layers.push_back(test::layer_of(truth::kLocation.name, 3, positions));
    tile.layers.push_back(test::layer_of(truth::kViewAngles.name, 2, angles));
    writer.write(tile);
  }
  writer.finish(image.outcome());
  const EnviReader places(folder.path() / "demo_location.img"),
      angles(folder.path() / "demo_view_angles.img");
  EXPECT_EQ(places.header().data_type, EnviType::float64);
  const std::string bytes = test::read_all(folder.path() / "demo_location.img");
  double easting = 0.0;
  std::memcpy(&easting, bytes.data() + 8 * (3 * 7 * 1 + 2), 8);
  EXPECT_EQ(easting, 477002.001953125);
  std::vector<float> line(7);
  angles.read(1, 0, line);
  EXPECT_TRUE(std::isnan(line[0]));
  EXPECT_EQ(line[2], 45.25f);
  angles.read(1, 1, line);
  EXPECT_EQ(line[2], 178.25f);
}

TEST(ProductWriter, WrongTilesAreBugs) {
  const SyntheticImage image{10, 10, 2};
  const ScratchFolder folder("wrong");
  ProductWriter writer(options_in(folder.path()), image.identity());
  EXPECT_THROW(writer.write(image.tile({0, 0, 4, 4})), std::logic_error);
  writer.begin(image.info());
  EXPECT_THROW(writer.write(image.tile({8, 8, 12, 12})), std::logic_error);
  auto tile = image.tile({0, 0, 4, 4});
  tile.samples.pop_back();
  EXPECT_THROW(writer.write(tile), std::logic_error);
}

}  // namespace
}  // namespace ifov::io::test_products
