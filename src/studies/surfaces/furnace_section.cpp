#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/round_primitives.h"
#include "radiometry/planck.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/surfaces/surface_rendering.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kFurnace_um = 10.0;
constexpr double kFurnaceMost = 1e-3;
constexpr int kFurnacePixels = 24;
/// Models of targets whose lobes are narrower are refused (transport finds their light by chance alone).
constexpr double kNarrowestFacets = 0.11;
constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

std::vector<StudySurface> furnace_surfaces(bool quick) {
  std::vector<StudySurface> list;
  const std::vector<double> widths =
      quick ? std::vector{0.02, 0.2, 1.0} : std::vector{0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0};
  for (const double width : widths) {
    const std::string roughness = format("roughness={:g}", width);
    list.push_back(
        {format("rough_conductor_{:g}", width), "rough_conductor", {"n=2", "k=3", roughness}, "1"});
    list.push_back({format("rough_dielectric_{:g}", width), "rough_dielectric", {roughness}, "0.5"});
    list.push_back({format("ward_{:g}", width), "ward", {"specular=0.2", roughness}, "0.4"});
    if (width < kNarrowestFacets) continue;
    const std::string slope = format("slope={:g}", width / std::numbers::sqrt2);
    list.push_back({format("priest_germer_{:g}", width), "priest_germer", {"n=2", "k=3", slope}, "0.1"});
    list.push_back({format("maxwell_beard_{:g}", width),
                    "maxwell_beard",
                    {"n=1.5", "k=0.1", slope, "tau=10 deg", "omega=20 deg"},
                    "0.1"});
    list.push_back({format("shell_target_{:g}", width),
                    "shell_target",
                    {"n=1.5", "k=0.1", slope, "tau=10 deg", "omega=20 deg"},
                    "0.1"});
  }
  list.insert(
      list.end(),
      {{"lambertian", "lambertian", {}, "0.6"},
       {"mirror", "mirror", {}, "0.6"},
       {"oren_nayar", "oren_nayar", {"slope=30 deg"}, "0.7"},
       {"ross_li", "ross_li", {"f_vol=0.1", "f_geo=0.01"}, "0.3"},
       {"roujean", "roujean", {"k1=0.02", "k2=0.3"}, "0.3"},
       {"rpv", "rpv", {"k=0.8", "asymmetry=-0.1"}, "0.2"},
       {"hapke", "hapke", {"b0=0.3", "roughness=15 deg"}, "0.6"},
       {"snow", "snow", {"grain=0.3 mm"}, "1"},
       {"sea", "sea", {"wind=7"}, "0"},
       {"smooth", "smooth", {"n=2", "k=1", "over=absorber"}, "1"},
       {"maignan", "maignan", {"coefficient=5", "ndvi=0.3"}, "0.3"},
       {"table", "table", {"file=furnace_table.csv"}, "1"},
       {"film", "film", {"n=2.2", "k=0.5", "thickness=0.8 um", "substrate_n=3", "substrate_k=2"}, "1"},
       {"slab", "slab", {"n=1.5", "k=1e-4", "thickness=5 mm"}, "1", true},
       {"leaf", "leaf", {"reflectance_beyond=0.3", "transmittance_beyond=0.2"}, "1", true}});
  return list;
}

void write_furnace_table(const std::filesystem::path& folder) {
  std::string rows;
  for (int light_deg = 0; light_deg <= 80; light_deg += 10)
    for (int view_deg = 0; view_deg <= 80; view_deg += 10)
      for (const int azimuth_deg : {0, 90, 180})
        for (const int um : {9, 11})
          rows += format(
              "{},{},{},{},{:.9g}\n", light_deg, view_deg, azimuth_deg, um,
              (0.3 + 0.4 * std::cos(light_deg * kDegree) * std::cos(view_deg * kDegree)) / std::numbers::pi);
  write_file(folder / "furnace_table.csv", rows);
}

FurnaceRoom render_furnace(const StudySurface& surface, const StudyOptions& options, int paths_across,
                           double ball_k) {
  io::Document document =
      nadir_document(square_camera(kFurnacePixels, 0.6, {-3.0, -2.0, 1.5}, {4.0, 3.0, 0.0}), "thermal",
                     kFurnace_um, grid_sampling(paths_across), options.seed);
  io::MaterialDocument tested = material_of(surface), ball = black("ball", {ball_k, {}});
  tested.temperature = io::TemperatureDocument{kFurnace_k, {}};
  ball.spectrum.source = io::ConstantSpectrum{0.5};
  document.scene.materials = {tested, ball};
  io::MaterialDocument wall = tested;
  if (surface.sheet) {
    wall = material_of({"", "rough_conductor", {"n=2", "k=3", "roughness=0.1"}, "1", false});
    wall.name = "wall";
    wall.temperature = tested.temperature;
    document.scene.materials.push_back(wall);
  }
  io::BoxPrimitive box;
  box.low_m = {-5.0, -4.0, 0.0};
  box.high_m = {5.0, 4.0, 3.0};
  io::SpherePrimitive sphere;
  sphere.centre_m = {1.5, 1.0, 0.9};
  sphere.radius_m = 0.8;
  document.scene.objects = {object_of(box, wall.name), object_of(sphere, ball.name)};
  if (surface.sheet) {
    io::DiskPrimitive sheet;
    sheet.centre_m = {0.0, -0.2, 1.2};
    sheet.normal = {1.0, 0.4, 0.3};
    sheet.radius_m = 0.9;
    document.scene.objects.push_back(object_of(sheet, tested.name));
  }
  const SurfaceImage image = render_surface(document, options);
  double sum = 0.0, squares = 0.0;
  const double planck = radiometry::planck_w_m2_sr_um(kFurnace_um, kFurnace_k);
  for (const float value : image.radiance) {
    sum += static_cast<double>(value) / planck;
    squares += std::pow(static_cast<double>(value) / planck, 2);
  }
  const double count = static_cast<double>(image.radiance.size()), mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

ReportSection furnace_section(const StudyOptions& options) {
  ReportSection section;
  section.title = "Closed warm rooms";
  section.text = format(
      "A room with walls of one surface and a grey ball, all at {:g} K, must look like a black body wherever one looks: what a "
      "surface emits and what it reflects belong together (Kirchhoff). Mean over the image in units of Planck's law; it may be off by "
      "0.1 % and three standard errors.",
      kFurnace_k);
  write_furnace_table(options.output_folder);
  double least_sure = 0.0;
  for (const StudySurface& surface : furnace_surfaces(options.is_quick())) {
    const FurnaceRoom room = render_furnace(surface, options, options.is_quick() ? 12 : 30);
    least_sure = std::max(least_sure, room.standard_error);
    section.figures.at_most(
        "furnace_" + surface.label, std::max(0.0, std::abs(room.mean - 1.0) - 3.0 * room.standard_error),
        kFurnaceMost, "",
        format("room of {}: {:.5f} of Planck's law, standard error {:.5f}; off by more than three of these",
               surface.label, room.mean, room.standard_error));
  }
  section.figures.at_most("furnace_standard_error", least_sure, 2e-3, "",
                          "largest standard error of these rooms");
  return section;
}

}  // namespace ifov::studies
