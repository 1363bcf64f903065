#include "honesty/named_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"
#include "honesty/rows_scene.h"

namespace ifov::benchmarks {

namespace {

constexpr std::array<NamedScene, 27> kScenes{{{"crop_rows"},
                                              {"crop_rows_moved"},
                                              {"vineyard_1m"},
                                              {"vineyard_2m"},
                                              {"vineyard_3m"},
                                              {"vineyard_3m_psf"},
                                              {"vineyard_3m_turned"},
                                              {"rows_box_gaps"},
                                              {"rows_mesh_strips"},
                                              {"slab_gaps"},
                                              {"alley"},
                                              {"thin_wall"},
                                              {"panel_mesh"},
                                              {"panel_boxes"},
                                              {"hot_sphere"},
                                              {"facade"},
                                              {"chrome_ball"},
                                              {"mirror_hemisphere"},
                                              {"container_yard"},
                                              {"narrow_penumbra"},
                                              {"power_line"},
                                              {"mixture_temperatures"},
                                              {"wide_channel"},
                                              {"airy_edge"},
                                              {"rows_map_fine"},
                                              {"rows_boxes_fine"},
                                              {"rows_mesh_fine"}}};

/// Rows of the name, where it is one of them.
bool make_rows(std::string_view name, RowsScene& rows) {
  rows.form = RowsScene::Form::map;
  rows.tiled = true;
  rows.row = 0.05;
  rows.between = 0.3;
  if (name.starts_with("crop_rows")) {  // the soil on the thirds of every pixel, or beside them
    rows.pitch_m = 10.0;
    rows.gsd_m = 30.0;
    rows.duty = 0.9;
    rows.phase_m = name == "crop_rows" ? 0.5 : 0.0;
  } else if (name.starts_with("vineyard")) {
    rows.gsd_m = name[9] - '0';
    rows.duty = 0.3;
    rows.phase_m = 0.015;
    rows.psf_sigma_px = name.ends_with("psf") ? 0.5 : 0.0;
    rows.angle_deg = name.ends_with("turned") ? 0.05 : 0.0;
  } else if (name == "rows_box_gaps" || name == "rows_mesh_strips") {  // black roofs, 0.3 pixels apart
    rows.form = name == "rows_box_gaps" ? RowsScene::Form::boxes : RowsScene::Form::mesh;
    rows.tiled = rows.lit = false;
    rows.duty = 0.7;
    rows.phase_m = 0.32;
    rows.height_m = 0.5;
    rows.row = 320.0;
    rows.between = 280.0;
  } else if (name.ends_with("_fine")) {  // four to a pixel, nearly along it
    rows.form = name == "rows_map_fine"     ? RowsScene::Form::map
                : name == "rows_boxes_fine" ? RowsScene::Form::boxes
                                            : RowsScene::Form::mesh;
    rows.tiled = rows.form == RowsScene::Form::map;
    rows.pitch_m = 0.25;
    rows.duty = 0.85;
    rows.phase_m = 0.03;
    rows.angle_deg = 0.02;
  } else {
    return false;
  }
  return true;
}

void save(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void write_files(const std::filesystem::path& folder) {
  std::string mesh = "usemtl panel\n";
  for (int k = 0; k < 60; ++k) {  // tilted by 20 degrees to the south, chord 0.3 m, pitch 1 m
    const double south = -30.0 + k + 0.03, north = south + 0.3 * 0.9396926, foot = 0.3,
                 top = foot + 0.3 * 0.3420201;
    mesh += format("v -20 {0} {1}\nv 20 {0} {1}\nv 20 {2} {3}\nv -20 {2} {3}\nf {4} {5} {6} {7}\n", south,
                   foot, north, top, 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * k + 4);
  }
  save(folder / "panel_rows.obj", mesh);
  constexpr int kCells = 8;
  for (const bool rock : {false, true}) {
    std::string map = format("ncols {0}\nnrows {0}\nxllcorner -8\nyllcorner -8\ncellsize 2\n", kCells);
    for (int k = 0; k < kCells * kCells; ++k)
      map += format("{:.2f} ",
                    (rock ? 340.0 : 300.0) + (rock ? 40.0 : 10.0) * std::sin(1.3 * k + (rock ? 1.0 : 0.0)));
    save(folder / (rock ? "rock_k.asc" : "grass_k.asc"), map + "\n");
  }
  std::string shares;
  for (const bool rock : {false, true})
    for (int k = 0; k < 16; ++k) {
      const auto grass = static_cast<float>(0.1 + 0.8 * (k % 5) / 4.0);
      const float share = rock ? 1.0f - grass : grass;
      shares.append(reinterpret_cast<const char*>(&share), sizeof share);
    }
  save(folder / "shares.img", shares);
  save(
      folder / "shares.img.hdr",
      "ENVI\nsamples = 4\nlines = 4\nbands = 2\nheader offset = 0\ndata type = 4\ninterleave = bsq\nbyte order = 0\n");
}

PlainHints::Ball about_box(math::Point3 low, math::Point3 high) {
  return {low + 0.5 * (high - low), 0.5 * math::length(high - low) * (1.0 + 1e-6)};
}

/// As the documents have them.
PlainHints hints_of(std::string_view name) {
  PlainHints hints;
  if (name == "hot_sphere") hints.lamps = {{{0.3, 0.2, 6.0}, 0.15}};
  if (name == "facade") hints.around_mirrors = {about_box({-8.0, 0.04, 0.0}, {8.0, 0.04, 10.0})};
  if (name == "chrome_ball") hints.mirrors = {{{0.2, 0.1, 0.41}, 0.4}};
  if (name == "mirror_hemisphere") hints.mirrors = {{{0.3, 0.2, 0.0}, 2.0}};
  for (const PlainHints::Ball& ball : hints.mirrors)
    hints.around_mirrors.push_back({ball.centre_m, ball.radius_m * (1.0 + 1e-6)});
  if (name == "container_yard")
    hints.around_mirrors = {about_box({-5.0, -4.0, 0.0}, {-3.0, 2.0, 2.5}),
                            about_box({0.0, -3.0, 0.0}, {2.0, 3.0, 2.5}),
                            about_box({4.0, -4.0, 0.0}, {6.0, 2.0, 2.5})};
  return hints;
}

}  // namespace

std::span<const NamedScene> named_scenes() { return kScenes; }

WildScene named_scene(std::string_view name, const std::filesystem::path& folder) {
  WildScene scene;
  scene.kind = scene.name = name;
  RowsScene rows;
  if (make_rows(name, rows)) {
    scene.document = rows.write(folder, scene.name);
    scene.exact = rows.radiance();
    return scene;
  }
  std::ifstream file(std::filesystem::path(IFOV_SOURCE_DIR) / "benchmarks/honesty/scenes" /
                     (scene.name + ".json"));
  if (!file) throw std::runtime_error("no scene " + scene.name);
  std::stringstream text;
  text << file.rdbuf();
  write_files(folder);
  scene.document = text.str();
  scene.hints = hints_of(name);
  return scene;
}

std::vector<FigureRow> report_named_scenes(std::span<const std::string> names,
                                           const std::filesystem::path& folder, const Judging& judging,
                                           int threads) {
  constexpr double kLeastCoverage = 0.93, kMostFar = 0.005, kMostReference = 0.4;
  std::vector<NamedScene> chosen;
  for (const NamedScene& scene : kScenes)
    if (names.empty() || std::find(names.begin(), names.end(), scene.name) != names.end())
      chosen.push_back(scene);
  for (const std::string& name : names)
    if (std::none_of(kScenes.begin(), kScenes.end(), [&](const NamedScene& s) { return s.name == name; })) {
      std::string all;
      for (const NamedScene& s : kScenes) all += (all.empty() ? "" : ", ") + std::string(s.name);
      throw std::runtime_error(format("no named scene '{}': choose from {}", name, all));
    }

  std::vector<WildScene> scenes;  // before the threads: several share files
  for (const NamedScene& scene : chosen) scenes.push_back(named_scene(scene.name, folder));
  std::vector<JudgedScene> judged(chosen.size());
  parallel_for(static_cast<std::int64_t>(chosen.size()), threads, [&](std::int64_t k) {
    const auto place = static_cast<std::size_t>(k);
    Judging own = judging;
    if (!own.rows.empty()) own.rows /= scenes[place].name + ".csv";
    judged[place] = judge_scene(scenes[place], folder, own);
    std::printf("    %s\n", summary(judged[place]).c_str());
    std::fflush(stdout);
  });

  std::vector<FigureRow> rows;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const JudgedScene& scene = judged[k];
    const auto sure = static_cast<double>(std::max<std::int64_t>(1, scene.converged()));
    const double far = static_cast<double>(scene.far) / sure;
    const double converged =
        static_cast<double>(scene.converged()) / static_cast<double>(std::max<std::int64_t>(1, scene.values));
    const bool known = scene.exact || scene.reference <= kMostReference;
    rows.push_back({scene.name + "_coverage", json_number(scene.coverage()), "share of converged",
                    known ? ">= 0.93" : ">= 0.93, against a better reference",
                    known && scene.coverage() >= kLeastCoverage});
    rows.push_back({scene.name + "_far", json_number(far), "share of converged with |z| > 4", "< 0.005",
                    far < kMostFar});
    rows.push_back({scene.name + "_converged", json_number(converged), "share",
                    format(">= {}", chosen[k].least_converged), converged >= chosen[k].least_converged});
  }
  return rows;
}

}  // namespace ifov::benchmarks
