#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/common/report_section.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct MaterialDocument;
}

/// The sections of the study of surfaces, and what each measures.
namespace ifov::studies {

/// A surface by its model's key and parameters as documents write them: {"roughness=0.1"}.
struct StudySurface {
  std::string label, model;
  std::vector<std::string> parameters;
  std::string reflectance;
  bool sheet = false;  ///< transmits: hangs in a room of other walls
};
/// Its material, called "surface".
io::MaterialDocument material_of(const StudySurface& surface);
/// All models that stand in closed rooms; lobes at roughness 0.02 to 1. `table` reads the file that write_furnace_table() writes.
std::vector<StudySurface> furnace_surfaces(bool quick);
/// A table of the BRDF (0.3 + 0.4 cos cos')/pi, which is reciprocal and darker the more aslant it is seen, at 9 and 11 um.
void write_furnace_table(const std::filesystem::path& folder);

/// Models of the registry over a grid of their parameters: samples against density, inverse of the warp, reciprocity.
ReportSection models_section(const StudyOptions& options);
ReportSection lobes_section(const StudyOptions& options);
ReportSection fresnel_section(const StudyOptions& options);

/// A closed room of one temperature whose walls are of a surface (of a sheet: of metal, with the sheet across the view): what a camera in it sees in units of Planck's radiance, and the
/// standard error of that mean. `ball_k`: of a grey ball in the room; any other temperature is a planted fault.
struct FurnaceRoom {
  double mean = 0.0, standard_error = 0.0;
};
inline constexpr double kFurnace_k = 300.0;
FurnaceRoom render_furnace(const StudySurface& surface, const StudyOptions& options, int paths_across,
                           double ball_k = kFurnace_k);
ReportSection furnace_section(const StudyOptions& options);

/// Mean-square slope of the sea out of its glint in an image under a point Sun in the zenith, as Cox and Munk (1954) found it in
/// photographs: density of slopes = 4 cos out cos in cos^4 tilt f/F, with F Fresnel's reflectance of sea water.
double slope_out_of_image(double wind_m_s, const StudyOptions& options, int pixels);
/// 0.003 + 0.00508 U, the sum of those along and across the wind.
double cox_munk_slope(double wind_m_s);
ReportSection sea_section(const StudyOptions& options);

ReportSection domes_section(const StudyOptions& options);
/// Samples a second of a suburb whose materials are all of one model against one of Lambertian materials.
ReportSection model_speed_section(const StudyOptions& options);

}  // namespace ifov::studies
