#include "session/runs/plan_assembly.h"

#include <filesystem>

#include "core/version.h"
#include "io/document/document.h"
#include "io/files/inputs.h"
#include "io/quantities/mosaic_quantities.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/scene_files.h"
#include "io/scene_cache/file_stamp.h"
#include "render/image_renderer.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "sensor/camera.h"
#include "sensor/view_list.h"
#include "session/assembly/geometry/object_classes.h"
#include "session/loaded/acquisition_assembly.h"
#include "session/loaded/parts.h"
#include "session/messages.h"

namespace ifov::session {
namespace {

const char* name_of(render::ErrorUnit unit) {
  switch (unit) {
    case render::ErrorUnit::kelvin: return "K";
    case render::ErrorUnit::radiance: return "radiance";
    case render::ErrorUnit::percent: return "%";
    case render::ErrorUnit::reflectance: return "reflectance";
    case render::ErrorUnit::polarization: return "DoLP";
    case render::ErrorUnit::noise: break;
  }
  return "noise";
}

}  // namespace

io::RunPlan assemble_plan(const Parts& parts, bool with_files) {
  const io::Document& document = parts.document;
  io::RunPlan plan;
  plan.identity.version = version();
  plan.identity.document_path = document.sources.file_name;
  plan.identity.document_text = *document.text;
  plan.identity.seed = document.seed;
  plan.identity.sampler = parts.plan.method;
  plan.identity.accuracy_asked = parts.plan.accuracy_asked;
  if (parts.tolerance) plan.identity.confidence = parts.tolerance->confidence();
  if (parts.plan.request) {
    plan.image_wide = parts.plan.request->image_wide;
    plan.error = parts.plan.request->error;
    plan.error_unit = name_of(parts.plan.request->unit);
  }
  plan.identity.acquisition = assemble_acquisition(parts);
  plan.build = build_id();
  plan.instruction_set = instruction_set();
  if (with_files)
    plan.files = io::stamp_scene_files(
        document.files, std::filesystem::path(document.sources.file_name).parent_path(), parts.known_files);
  plan.image = parts.info;
  plan.image.solved = std::any_of(parts.scene.states.begin(), parts.scene.states.end(),
                                  [](const scene::SurfaceState& state) { return state.solved > 0; });
  tell_objects(document.scene.objects, parts.placed, *parts.scene.world, plan.image);
  plan.tile_px = document.sampling.tile_px;
  plan.judged = parts.tolerance != nullptr;
  plan.knows_errors = parts.plan.knows_errors;
  for (const std::string& warning : parts.warnings) plan.notes.push_back("warning: " + warning);
  for (const std::string& line : parts.locations) plan.notes.push_back(line);
  for (const std::string& note : notes(parts)) plan.notes.push_back(note);
  for (const io::FileStamp& stamp : plan.files)
    if (io::is_asset_name(stamp.path))
      plan.notes.push_back(format("'{}' came from a program's memory: {} bytes, XXH3 {:016x}{:016x}",
                                  stamp.path, stamp.bytes, stamp.hash[1], stamp.hash[0]));
  plan.interleave = document.output.interleave;
  plan.formats = io::product_formats(document.output.formats);
  plan.name = document.output.name;
  const bool map_tells = parts.camera->ground_grid().has_value() || plan.image.views != nullptr;
  plan.cubes = document.output.products.value_or(io::usual_quantities(map_tells, document.sensor.stokes));
  if (plan.image.mosaic && !document.output.products)
    plan.cubes.add(io::quantities::kMosaic), plan.cubes.add(io::quantities::kMosaicHalfWidth);
  if (plan.image.views)
    io::add_view_quantities(plan.image.views->kind == sensor::ViewList::Kind::points, plan.cubes);
  plan.formats.add_needed(plan.image, plan.cubes);
  for (const io::DocumentName& channel : document.output.quicklook_channels)
    for (std::size_t c = 0; c < document.sensor.channels.size(); ++c)
      if (document.sensor.channels[c].name == channel.name)
        plan.quicklook_channels.push_back(static_cast<int>(c));
  return plan;
}

void set_contents(const io::RunPlan& plan, render::RenderJob& job) {
  job.keep_memory = plan.keeps_memory;
  job.keep_variances = plan.keeps_variances();
  job.collectors = io::collectors_of(plan.made_cubes());
  job.emissivity = plan.tells_emissivity();
  job.parts = plan.tells_parts();
  job.thermal_errors = plan.tells_thermal_errors();
}

}  // namespace ifov::session
