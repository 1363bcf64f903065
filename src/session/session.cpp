#include "session/session.h"

#include <set>

#include "core/version.h"
#include "io/products/product_writer.h"
#include "session/parts.h"
#include "session/scene_assembly.h"
#include "session/sensor_assembly.h"
#include "session/statements.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

io::ProductOptions product_options(const io::Document& document, const std::filesystem::path& folder) {
  io::ProductOptions options;
  options.folder = folder;
  const std::set<io::ProductFormat> formats(document.output.formats.begin(), document.output.formats.end());
  options.geotiff = formats.contains(io::ProductFormat::geotiff);
  options.quicklook = formats.contains(io::ProductFormat::png);
  options.report = formats.contains(io::ProductFormat::html);
  for (const io::DocumentName& channel : document.output.quicklook_channels)
    for (std::size_t c = 0; c < document.sensor.channels.size(); ++c)
      if (document.sensor.channels[c].name == channel.name)
        options.quicklook_channels.push_back(static_cast<int>(c));
  return options;
}

}  // namespace

render::RenderJob Session::Parts::job() const {
  render::RenderJob job{*spectral_scene, *camera, *footprint, *plan.sampler};
  job.tolerance = tolerance.get();
  if (document.sampling.max_depth) job.transport.maximum_scatterings = *document.sampling.max_depth;
  job.label_detail = plan.request ? render::LabelDetail::sun_state : render::LabelDetail::material;
  job.seed = document.seed;
  job.tile_px = document.sampling.tile_px;
  job.seed_objects = plan.seed_objects;
  job.drivers = plan.drivers;
  return job;
}

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session Session::load(const io::Document& document, LogSink* log) {
  auto parts = std::make_unique<Parts>();
  Parts& p = *parts;
  p.document = document;
  p.scene = assemble_scene(document, log);
  p.channels = assemble_channels(document);
  p.camera = assemble_camera(document, p.scene);
  p.footprint = std::make_unique<sampling::PixelFootprint>(assemble_footprint(document));
  p.plan = assemble_sampling(document, p.channels);
  std::vector<radiometry::Spectrum> surfaces;
  for (const materials::Material& material : p.scene.materials) surfaces.push_back(material.reflectance);
  with_position(document, document.sensor.position, [&] {
    const radiometry::Spectrum sun = p.scene.sun ? p.scene.sun->irradiance : radiometry::Spectrum();
    p.nodes = std::make_unique<radiometry::SpectralNodes>(
        radiometry::SpectralNodes::build(p.channels, sun, surfaces));
    p.spectral_scene = std::make_unique<render::SpectralScene>(p.scene, *p.nodes);
  });
  p.brightness = std::make_unique<render::ChannelBrightness>(*p.nodes);
  if (p.plan.request)
    p.tolerance = std::make_unique<render::AccuracyTolerance>(
        *p.plan.request, *p.brightness, p.spectral_scene->white_reflected(),
        static_cast<std::int64_t>(p.camera->width_px()) * p.camera->height_px());
  p.info = image_info(document, *p.camera, p.channels, p.scene);
  if (log != nullptr)
    log->info(format("sensor: {} x {} pixels, {} channels in {} spectral nodes", p.info.width_px, p.info.height_px,
                     p.channels.size(), p.nodes->node_count()));
  return Session(std::move(parts));
}

std::string Session::description() const { return describe(*parts_); }

RunSummary Session::render(const RunOptions& options) const {
  const Parts& p = *parts_;
  const std::filesystem::path folder =
      options.output_folder.empty() ? std::filesystem::path(p.document.output.folder) : options.output_folder;
  io::RunIdentity identity;
  identity.version = version();
  identity.document_path = p.document.file_name;
  identity.document_text = *p.document.text;
  identity.seed = p.document.seed;
  identity.sampler = p.plan.method;
  identity.accuracy_asked = p.plan.accuracy_asked;
  if (p.tolerance) identity.confidence = p.tolerance->confidence();

  io::ProductOptions products = product_options(p.document, folder);
  products.standard_error = products.half_width = p.plan.knows_errors;
  io::ProductWriter writer(products, identity);
  writer.begin(p.info);
  DetectionTally detection(writer);
  render::RenderControl control;
  control.threads = options.threads;
  control.cancel = options.cancel;
  control.progress = options.progress;
  RunSummary summary;
  summary.folder = folder;
  summary.totals = render::render_image(p.job(), control, detection);

  io::RunOutcome outcome;
  outcome.accuracy_statement = accuracy_statement(p, summary.totals);
  outcome.detection_statement = detection.statement();
  outcome.notes = notes(p);
  outcome.elapsed_s = summary.totals.elapsed_s;
  outcome.threads = options.threads;
  const io::RunRecord record = writer.finish(outcome);
  for (const io::ProductFile& file : record.files) summary.files.push_back({file.path, file.what});
  summary.accuracy_statement = outcome.accuracy_statement;
  return summary;
}

}  // namespace ifov::session
