#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "core/format.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/report/report.h"
#include "io/report/report_data.h"
#include "io/synthetic_image.h"

namespace ifov::io::test_report {
namespace {

using test::SyntheticImage;

std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 255u);
  }
  return bytes;
}

std::string element(const std::string& page, const std::string& id) {
  const auto at = page.find("id=\"" + id + "\">");
  if (at == std::string::npos) return {};
  const auto start = page.find('>', at) + 1;
  return page.substr(start, page.find("</script>", start) - start);
}

ReportInput views(const SyntheticImage& image) {
  const auto view = [&](int bands, auto value) {
    return RasterView{image.width, image.height, bands,
                      [&image, value](int y, int band, std::span<float> out) {
                        for (int x = 0; x < image.width; ++x)
                          out[static_cast<std::size_t>(x)] = value(x, y, band);
                      }};
  };
  ReportInput input;
  input.radiance = view(image.channels, [&image](int x, int y, int c) { return image.radiance(x, y, c); });
  input.half_width =
      view(image.channels, [&image](int x, int y, int c) { return image.half_width(x, y, c); });
  input.samples = view(3, [&image](int x, int y, int) { return static_cast<float>(image.samples(x, y)); });
  input.quality = view(4, [&image](int x, int y, int band) {
    return band == 0 ? (image.ratio(x, y) <= 1.0f ? 1.0f : 0.0f) : band == 3 ? 0.75f : image.ratio(x, y);
  });
  input.reasons = view(1, [&image](int x, int y, int) { return static_cast<float>(image.reasons(x, y)); });
  return input;
}

RunRecord record_of(const SyntheticImage& image) {
  RunRecord record{image.identity(), image.outcome(), image.info(), {}, {}};
  record.statistics.channels.resize(static_cast<std::size_t>(image.channels));
  return record;
}

TEST(Report, HalfWidthsThatAreNoNumbersAreNotOffered) {
  const SyntheticImage image{5, 5, 2};
  auto record = record_of(image);
  EXPECT_NE(make_report(record, views(image)).find("data-view=\"width\""), std::string::npos);
  for (auto& channel : record.statistics.channels) channel.largest_half_width = std::nan("");
  EXPECT_EQ(make_report(record, views(image)).find("data-view=\"width\""), std::string::npos);
}

TEST(Report, SaysWhyMapsOfSamplesShowTiles) {
  const SyntheticImage image{5, 5, 2};
  auto record = record_of(image);
  record.statistics.halo_samples = 0;
  EXPECT_EQ(make_report(record, views(image)).find("edges of tiles"), std::string::npos);
  record.statistics.halo_samples = 12300;
  EXPECT_NE(make_report(record, views(image)).find("12.3 k in all, are in no pixel's count"),
            std::string::npos);
}

TEST(Base64, PublishedExamples) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Report, EmbeddedValuesComeBackWithinHalfACode) {
  const SyntheticImage image{13, 9, 4};
  const std::string page = make_report(record_of(image), views(image));
  const DocumentTree tree = parse_json(element(page, "meta"), "json");
  const JsonView meta(tree);
  EXPECT_EQ(meta["width"].small_integer(), 13);
  EXPECT_EQ(meta["step"].small_integer(), 1);
  const std::string codes = decoded(element(page, "radiance"));
  ASSERT_EQ(codes.size(), 2u * 13 * 9 * 4);
  for (int c = 0; c < 4; ++c) {
    const double low = meta["rasters"]["radiance"]["low"].items()[static_cast<std::size_t>(c)].number(),
                 high = meta["rasters"]["radiance"]["high"].items()[static_cast<std::size_t>(c)].number();
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 13; ++x) {
        const std::size_t at = 2 * static_cast<std::size_t>((c * 9 + y) * 13 + x);
        const int code =
            static_cast<unsigned char>(codes[at]) + 256 * static_cast<unsigned char>(codes[at + 1]);
        EXPECT_NEAR(low + code * (high - low) / 65534, image.radiance(x, y, c),
                    (high - low) / 131000 + 1e-6 * high);
      }
  }
}

TEST(Report, NeedsNoNetworkAndCannotBeBrokenByItsDocument) {
  const SyntheticImage image{5, 5, 2};
  auto record = record_of(image);
  record.image.channels[0].name = "</script><script>alert(1)</script>";
  record.identity.document_text = "</pre><script>alert(2)</script>";
  const std::string page = make_report(record, views(image));
  for (const char* forbidden : {"src=", "href=", "@import", "fetch(", "url(http", "<script>alert"})
    EXPECT_EQ(page.find(forbidden), std::string::npos) << forbidden;
  EXPECT_NE(page.find("98.3 % of pixels"), std::string::npos);
  EXPECT_NE(page.find("A compact feature of 2 %"), std::string::npos);
}

TEST(Report, LargeImagesAreThinnedAndThePageSaysSo) {
  const SyntheticImage image{200, 120, 10};
  const std::string page = make_report(record_of(image), views(image), 100000);
  const DocumentTree tree = parse_json(element(page, "meta"), "json");
  const JsonView meta(tree);
  const int step = meta["step"].small_integer();
  EXPECT_GT(step, 1);
  EXPECT_LE(decoded(element(page, "radiance")).size() + decoded(element(page, "half_width")).size(), 100000u);
  EXPECT_NE(page.find("Preview: every " + std::to_string(step)), std::string::npos);
  double pixels = 0.0;  // histograms are of the whole image all the same
  for (const JsonView& n : meta["histograms"]["samples"]["counts"].items()) pixels += n.number();
  EXPECT_EQ(pixels, 200.0 * 120.0);
}

TEST(Report, WithoutAnAccuracyNothingIsSaidAboutLimits) {
  const SyntheticImage image{5, 5, 2};
  auto record = record_of(image);
  record.identity.accuracy_asked.clear();
  record.outcome.accuracy_statement.clear();
  ReportInput input = views(image);
  input.half_width = {};
  const std::string page = make_report(record, input);
  EXPECT_EQ(page.find("converged</span>"), std::string::npos);
  EXPECT_EQ(page.find("id=\"map-error\""), std::string::npos);
  EXPECT_EQ(page.find("data-view=\"width\""), std::string::npos);
}

/// Runs the page's own code: IFOV_TEST_BROWSER names a Chromium.
TEST(Report, ABrowserDrawsIt) {
  const char* browser = std::getenv("IFOV_TEST_BROWSER");
  if (browser == nullptr) GTEST_SKIP() << "IFOV_TEST_BROWSER does not name a browser";
  const test::ScratchFolder folder("browser");
  const SyntheticImage image{20, 10, 30};
  auto record = record_of(image);
  std::ofstream(folder.path() / "report.html") << make_report(record, views(image));
  const std::string command = format(
      "{} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking "
      "--disable-component-update --disable-sync --user-data-dir={}/profile --virtual-time-budget=5000 "
      "--dump-dom "
      "file://{}/report.html > {}/dom.html 2>/dev/null",
      browser, folder.path().string(), folder.path().string(), folder.path().string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string page = test::read_all(folder.path() / "dom.html");
  EXPECT_NE(page.find("data-ready=\"yes\""), std::string::npos);
  EXPECT_NE(page.find(format("Pixel (10, 5): ch5 = {:.4g} \u00b1 {:.4g}; {} samples",
                             image.radiance(10, 5, 4), image.half_width(10, 5, 4), image.samples(10, 5))),
            std::string::npos);
}

TEST(Histogram, CountsEveryFiniteValueOnce) {
  const std::vector<float> values{1, 2, 2, 3, NAN, 3, 3, 10};
  const RasterView view{4, 2, 1, [&](int line, int, std::span<float> out) {
                          std::copy_n(values.begin() + line * 4, 4, out.begin());
                        }};
  const Histogram whole = histogram(view, 0, 40, true);
  EXPECT_EQ(whole.counts, (std::vector<std::size_t>{1, 2, 3, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(whole.edges.front(), 0.5);
  EXPECT_EQ(whole.edges.back(), 10.5);
  const Histogram three = histogram(view, 0, 3);
  EXPECT_EQ(three.counts, (std::vector<std::size_t>{6, 0, 1}));
  EXPECT_FALSE(three.logarithmic);
}

TEST(Histogram, WideRangesAreLogarithmic) {
  const std::vector<float> values{1, 10, 100, 1000};
  const RasterView view{4, 1, 1,
                        [&](int, int, std::span<float> out) { std::copy_n(values.begin(), 4, out.begin()); }};
  const Histogram h = histogram(view, 0, 3);
  EXPECT_TRUE(h.logarithmic);
  EXPECT_NEAR(h.edges[1], 10.0, 1e-9);
  EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::size_t{0}), 4u);
}

}  // namespace
}  // namespace ifov::io::test_report
