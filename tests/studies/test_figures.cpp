#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "io/synthetic_image.h"
#include "studies/common/figures.h"
#include "studies/common/report_figures.h"

namespace ifov::studies::test_figures {
namespace {

TEST(FigureTable, JudgesAndWrites) {
  FigureTable table;
  table.report("seconds", 1.5, "s", "time taken");
  table.at_most("samples", 180, 185, "samples", "to \"0.1 C\"");
  table.between("grid", 15876, 15876, 15876, "samples", "of the grid");
  EXPECT_TRUE(table.all_met());
  table.at_least("found", 0.5, 1.0, "", "share");
  EXPECT_FALSE(table.all_met());
  EXPECT_EQ(
      table.json(),
      "{\n"
      "  \"seconds\": {\n    \"value\": 1.5,\n    \"unit\": \"s\",\n    \"must\": \"\",\n    \"ok\": null,\n"
      "    \"meaning\": \"time taken\"\n  },\n"
      "  \"samples\": {\n    \"value\": 180,\n    \"unit\": \"samples\",\n    \"must\": \"<= 185\",\n    \"ok\": true,\n"
      "    \"meaning\": \"to \\\"0.1 C\\\"\"\n  },\n"
      "  \"grid\": {\n    \"value\": 15876,\n    \"unit\": \"samples\",\n    \"must\": \"= 15876\",\n    \"ok\": true,\n"
      "    \"meaning\": \"of the grid\"\n  },\n"
      "  \"found\": {\n    \"value\": 0.5,\n    \"unit\": \"\",\n    \"must\": \">= 1\",\n    \"ok\": false,\n"
      "    \"meaning\": \"share\"\n  }\n"
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

TEST(ReportPlot, LeavesOutWhatItsAxesCannotShow) {
  Plot plot;
  plot.title = "a < b";
  plot.x_log = true;
  plot.series = {{"line", "#d55e00", {0.0, 10.0, 1000.0}, {1.0, 2.0, 3.0}},
                 {"dots", "#888", {10.0}, {NAN}, true}};
  plot.levels = {{"truth", "#00703c", 2.0, 0.5}};
  const DrawnFigure drawn = draw(plot);
  EXPECT_TRUE(drawn.svg.starts_with("<?xml")) << drawn.svg.substr(0, 40);
  EXPECT_EQ(drawn.svg.find("nan"), std::string::npos);
  EXPECT_EQ(drawn.svg.find("inf"), std::string::npos);
  EXPECT_TRUE(drawn.pdf.starts_with("%PDF-"));
  EXPECT_EQ(draw(plot).pdf, drawn.pdf) << "the same bytes each time";
  plot.series[0].colour = "red";
  EXPECT_THROW(draw(plot), std::logic_error);
}

TEST(ReportFigures, AreShownAndKept) {
  ReportFigures figures;
  ImagePanel panel;
  panel.title = "Samples, grid 10 x 10: a long title that has to be wrapped because panels are narrow";
  panel.width = panel.height = 2;
  panel.values = {0, 1, 2, std::numeric_limits<double>::infinity()};
  EXPECT_NE(figures.add(panel).find("<img alt=\"Samples, grid"), std::string::npos);
  EXPECT_NE(figures.add(panel).find("src=\"data:image/svg+xml;base64,"), std::string::npos);
  Plot plot;
  plot.title = "a < b";
  plot.series = {{"one value", "#888", {1.0}, {2.0}}};
  EXPECT_NE(figures.add(plot).find("alt=\"a &lt; b\""), std::string::npos);
  const test::ScratchFolder folder("figures");
  std::vector<std::string> names;
  for (const auto& file : figures.write(folder.path())) {
    EXPECT_GT(std::filesystem::file_size(file), 500u);
    names.push_back(file.lexically_relative(folder.path()).string());
  }
  const std::string long_name = "figures/samples_grid_10_x_10_a_long_title_that_has_to_be_wrapped";
  EXPECT_EQ(names, (std::vector<std::string>{long_name + ".svg", long_name + ".pdf", long_name + "_2.svg",
                                             long_name + "_2.pdf", "figures/a_b.svg", "figures/a_b.pdf"}));
}

}  // namespace
}  // namespace ifov::studies::test_figures
