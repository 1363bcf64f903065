#include <gtest/gtest.h>

#include <limits>

#include "studies/figures.h"
#include "studies/svg_plot.h"

namespace ifov::studies {
namespace {

TEST(FigureTable, JudgesAndWrites) {
  FigureTable table;
  table.report("seconds", 1.5, "s", "time taken");
  table.at_most("samples", 180, 185, "samples", "to \"0.1 C\"");
  table.between("grid", 15876, 15876, 15876, "samples", "of the grid");
  EXPECT_TRUE(table.all_met());
  table.at_least("found", 0.5, 1.0, "", "share");
  EXPECT_FALSE(table.all_met());
  EXPECT_EQ(table.json(),
            "{\n"
            "  \"seconds\": {\"value\": 1.5, \"unit\": \"s\", \"must\": \"\", \"ok\": null, \"meaning\": "
            "\"time taken\"},\n"
            "  \"samples\": {\"value\": 180, \"unit\": \"samples\", \"must\": \"<= 185\", \"ok\": true, "
            "\"meaning\": "
            "\"to \\\"0.1 C\\\"\"},\n"
            "  \"grid\": {\"value\": 15876, \"unit\": \"samples\", \"must\": \"= 15876\", \"ok\": true, "
            "\"meaning\": \"of "
            "the grid\"},\n"
            "  \"found\": {\"value\": 0.5, \"unit\": \"\", \"must\": \">= 1\", \"ok\": false, \"meaning\": "
            "\"share\"}\n"
            "}\n");
  EXPECT_NE(table.text().find("samples           180  samples  <= 185   ok\n"), std::string::npos)
      << table.text();
  EXPECT_NE(table.html().find("class=\"missed\">NO"), std::string::npos);
}

TEST(FigureTable, NotANumberMeetsNothing) {
  FigureTable table;
  table.at_most("nothing", std::numeric_limits<double>::quiet_NaN(), 1.0, "", "");
  EXPECT_FALSE(table.all_met());
  EXPECT_NE(table.json().find("\"value\": null"), std::string::npos);
}

TEST(SvgPlot, ShowsSeriesAndLevels) {
  Plot plot;
  plot.title = "a < b";
  plot.x_log = true;
  plot.series = {{"line", "red", {0.0, 10.0, 1000.0}, {1.0, 2.0, 3.0}}};
  plot.levels = {{"truth", "green", 2.0, 0.5}};
  const std::string svg = svg_plot(plot);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("M70.00"), std::string::npos);  // the first point that a logarithm can show
}

TEST(SvgImage, HoldsABitmap) {
  ImagePanel panel;
  panel.width = panel.height = 2;
  panel.values = {0, 1, 2, std::numeric_limits<double>::infinity()};
  EXPECT_NE(svg_image(panel).find("data:image/bmp;base64,Qk0"), std::string::npos);
}

}  // namespace
}  // namespace ifov::studies
