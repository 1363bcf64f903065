#include "io/document/reading/check_references.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "core/format.h"
#include "core/names.h"
#include "core/overloaded.h"
#include "io/document/atmosphere_document.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/detector_document.h"
#include "io/document/document.h"
#include "io/document/file_materials_document.h"
#include "io/document/presence_document.h"
#include "io/document/psf_document.h"
#include "io/document/pupil_document.h"
#include "io/document/reading/check_motions.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/sampler_settings.h"
#include "io/document/spectrometer_document.h"
#include "io/quantities/quantity.h"

namespace ifov::io {
namespace {

constexpr std::size_t kDeepest = 64;

template <class T>
std::vector<std::string> names_of(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

class ReferenceCheck {
 public:
  explicit ReferenceCheck(const Document& document)
      : document_(document),
        materials_(names_of(document.scene.materials)),
        prototypes_(names_of(document.scene.prototypes)),
        channels_(names_of(document.sensor.channels)) {}

  void run() const {
    for (const MaterialDocument& material : document_.scene.materials)
      if (material.sides)
        for (const DocumentName* side : {&material.sides->first, &material.sides->second}) check_side(*side);
    for (const ObjectDocument& object : document_.scene.objects) {
      check(object);
      if (object.present && !document_.time)
        throw document_error(
            document_.sources, object.present->position,
            "what is there for a time only needs the document's 'time', at which the picture is taken");
    }
    for (const PrototypeDocument& prototype : document_.scene.prototypes) {
      for (const ObjectDocument& object : prototype.objects) {
        check(object);
        if (std::holds_alternative<CityShape>(object.shape))
          throw document_error(document_.sources, object.shape_position, "a prototype cannot hold a city");
        if (object.present)
          throw document_error(
              document_.sources, object.present->position,
              "a part of a prototype cannot have times of its own; give 'present' to the copies");
        if (object.motion)
          throw document_error(
              document_.sources, object.motion->position,
              "a part of a prototype cannot move by itself: it is rigid; give 'motion' to the copies");
        if (std::holds_alternative<RandomPlacement>(object.shape))
          throw document_error(document_.sources, object.shape_position,
                               "a prototype cannot hold a random placement");
      }
    }
    check_nesting();
    check_channel_names();
    if (const DocumentName* channel = document_.sampling.method->channel_looked_at())
      require("channel", *channel, channels_);
    for (const DocumentName& channel : document_.output.quicklook_channels)
      require("channel", channel, channels_);
    check_mosaic();
    check_products();
    check_error();
    check_direction(document_.light.sun, "Sun");
    check_moon();
    check_sky();
    check_psf();
  }

 private:
  /// Whoever names products that there cannot be wants them; "all" are all that there can be.
  void check_products() const {
    if (!document_.output.products || *document_.output.products == QuantitySet::all()) return;
    const auto named = [&](bool Quantity::Needs::*need) {
      std::vector<std::string> names;
      for (const Quantity* quantity : *document_.output.products)
        if (quantity->needs.*need) names.emplace_back(quantity->name);
      return names;
    };
    const std::vector<std::string> parts = named(&Quantity::Needs::parts);
    if (!parts.empty() && document_.sensor.camera.model == "points")
      throw document_error(
          document_.sources, document_.output.position,
          format(
              "output.products has {}: sensor.points measures irradiance, whose parts are not told; that of "
              "cameras, distant, hemisphere and rays is radiance",
              list_names(parts, "and")));
    check_sunlight(named(&Quantity::Needs::sunlight));
    const std::vector<std::string> mosaics =
        document_.sensor.mosaic ? std::vector<std::string>{} : named(&Quantity::Needs::mosaic);
    if (!mosaics.empty())
      throw document_error(
          document_.sources, document_.output.position,
          format(
              "output.products has {}: that takes a sensor with a \"mosaic\", and sensor.mosaic is not given",
              list_names(mosaics, "and")));
    const std::vector<std::string> without =
        document_.sensor.stokes ? std::vector<std::string>{} : named(&Quantity::Needs::stokes);
    if (!without.empty())
      throw document_error(
          document_.sources, document_.output.position,
          format(
              "output.products has {}: that takes a sensor with \"stokes\": true, and sensor.stokes is not given or false",
              list_names(without, "and")));
  }

  void check_mosaic() const {
    const std::shared_ptr<const MosaicDocument>& mosaic = document_.sensor.mosaic;
    const std::vector<std::string>& formats = document_.output.formats;
    if (!mosaic && std::find(formats.begin(), formats.end(), "demosaiced") != formats.end())
      throw document_error(
          document_.sources, document_.output.position,
          "output.formats has 'demosaiced': that takes a sensor with a \"mosaic\", and sensor.mosaic is not given");
    if (!mosaic) return;
    for (const std::vector<DocumentName>& row : mosaic->rows)
      for (const DocumentName& channel : row) require("channel", channel, channels_);
    const std::string& camera = document_.sensor.camera.model;
    if (camera != "frame" && camera != "orthographic")
      throw document_error(
          document_.sources, mosaic->position,
          format(
              "a mosaic is of the elements of a frame, and a {} camera makes its image of lines; expected a frame or orthographic "
              "camera",
              camera));
  }

  /// Reflectance above the air is over the light of the Sun there.
  void check_sunlight(const std::vector<std::string>& products) const {
    if (products.empty()) return;
    const AtmosphereDocument& air = document_.atmosphere;
    std::string why;
    if (!document_.light.sun)
      why = "light.sun is not given";
    else if (air.simple || air.uniform || air.four_curve)
      why = format("atmosphere.{} tells of sunlight at the ground alone", air.simple    ? "simple"
                                                                          : air.uniform ? "uniform"
                                                                                        : "four_curve");
    if (!why.empty())
      throw document_error(document_.sources, document_.output.position,
                           format("output.products has {}: that takes sunlight above the air, and {}",
                                  list_names(products, "and"), why));
  }

  /// What a mirror that turns does to polarization behind it is not known; and sweeps are pictures of their own, so that none knows the image's error.
  void check_sweeps(const AccuracySampling* accuracy) const {
    const CameraSettings* const camera = document_.sensor.camera.settings.get();
    if (camera == nullptr) return;
    const auto polarizes = [](const ChannelDocument& channel) {
      return channel.polarizer || channel.retarder;
    };
    if (camera->sweeps() &&
        std::any_of(document_.sensor.channels.begin(), document_.sensor.channels.end(), polarizes))
      throw document_error(
          document_.sources, document_.sensor.camera.position,
          format(
              "a {} camera turns its view, and what that does to the polarization of light on its way to polarizers and retarders is not "
              "modelled: expected none (\"stokes\": true tells of light as it arrives), or another camera",
              document_.sensor.camera.model));
    if (accuracy != nullptr && accuracy->of_image() && !camera->made_of().empty())
      throw document_error(
          document_.sources, accuracy->position,
          format(
              "\"of\": \"image\" takes an image that is one picture, and each {} of a {} camera is one of its own: "
              "ask for errors of pixels (\"of\": \"pixel\")",
              camera->made_of(), document_.sensor.camera.model));
  }

  /// Degrees of polarization are known where Q and U are told.
  void check_error() const {
    const auto* accuracy = sampler_as<AccuracySampling>(document_.sampling);
    check_sweeps(accuracy);
    if (accuracy != nullptr && accuracy->of_image() && document_.sensor.stokes)
      throw document_error(
          document_.sources, accuracy->position,
          "\"of\": \"image\" does not judge Q, U and V, and the sensor has \"stokes\": true: ask for "
          "errors of pixels (\"of\": \"pixel\"), or sample by a grid");
    if (accuracy == nullptr || accuracy->error.unit != ErrorSize::Unit::polarization ||
        document_.sensor.stokes)
      return;
    throw document_error(
        document_.sources, accuracy->error.position,
        format(
            "an error of {} is asked for, and the sensor does not tell polarization: give it \"stokes\": true, or "
            "the error in K, %, W m-2 sr-1 um-1, reflectance or noise",
            text_of(accuracy->error)));
  }

  void require(std::string_view what, const DocumentName& reference,
               const std::vector<std::string>& names) const {
    if (std::find(names.begin(), names.end(), reference.name) != names.end()) return;
    const std::string hint = did_you_mean(reference.name, names);
    const std::string list =
        names.empty() ? "none is declared" : format("declared: {}", list_names(names, "and"));
    throw document_error(document_.sources, reference.position,
                         format("there is no {} '{}'{} ({})", what, reference.name, hint, list));
  }

  void check_side(const DocumentName& side) const {
    require("material", side, materials_);
    const auto found = std::ranges::find(document_.scene.materials, side.name, &MaterialDocument::name);
    if (found->sides)
      throw document_error(document_.sources, side.position,
                           format("'{}' has a front and a back itself and cannot be a side", side.name));
  }

  void check(const ObjectDocument& object) const {
    if (const DocumentName* of = copied_by(object)) require("prototype", *of, prototypes_);
    if (const auto* placement = std::get_if<RandomPlacement>(&object.shape)) check(*placement);
    if (!object.material) return;
    const auto known = [&](const DocumentName& material) { require("material", material, materials_); };
    std::visit(
        Overloaded{[&](const DocumentName& name) { known(name); },
                   [&](const MaterialMap& map) {
                     for (const auto& [number, material] : map.classes) known(material);
                   },
                   [&](const MixtureDocument& mixture) {
                     for (const DocumentName& material : mixture.materials) known(material);
                   },
                   [&](const std::shared_ptr<const FileMaterials>& file) {
                     for (const FileMaterials::Colour& colour : file->colours) known(colour.material);
                     for (const auto& [slot, material] : file->slots) known(material);
                     if (!std::holds_alternative<MeshShape>(object.shape))
                       throw document_error(
                           document_.sources, object.material->position,
                           "only a mesh has materials 'from_file', those that its file tells");
                   },
                   [&](const MaterialSlots& slots) {
                     for (const auto& [slot, material] : slots.slots) known(material);
                     if (!std::holds_alternative<MeshShape>(object.shape) &&
                         !std::holds_alternative<CityShape>(object.shape)) {
                       throw document_error(
                           document_.sources, object.material->position,
                           "only a mesh and a city have 'slots', the names of materials in their files");
                     }
                   }},
        object.material->value);
  }

  void check(const RandomPlacement& placement) const {
    for (const RandomPlacement::Weighted& weighted : placement.of)
      require("prototype", weighted.prototype, prototypes_);
    if (!placement.on) return;
    std::vector<std::string> grounds;
    for (const ObjectDocument& object : document_.scene.objects)
      if (!object.name.empty() && object.material &&
          std::find(grounds.begin(), grounds.end(), object.name) == grounds.end())
        grounds.push_back(object.name);
    require("object with a shape of its own", *placement.on, grounds);
  }

  /// No prototype may hold itself: depth first, each prototype once.
  void check_nesting() const {
    enum class State { unseen, open, done };
    std::map<std::string, State> states;
    std::vector<std::string> path;
    const std::function<void(const PrototypeDocument&)> descend = [&](const PrototypeDocument& prototype) {
      states[prototype.name] = State::open;
      path.push_back(prototype.name);
      if (path.size() > kDeepest)
        throw document_error(document_.sources, prototype.position,
                             format("prototypes are nested more than {} deep", kDeepest));
      for (const ObjectDocument& object : prototype.objects) {
        const DocumentName* of = copied_by(object);
        if (of == nullptr || states[of->name] == State::done) continue;
        if (states[of->name] == State::open) {
          std::string loop;
          for (auto at = std::find(path.begin(), path.end(), of->name); at != path.end(); ++at)
            loop += format("'{}' holds ", *at);
          throw document_error(document_.sources, of->position,
                               format("the prototype '{}' holds itself: {}'{}'", of->name, loop, of->name));
        }
        for (const PrototypeDocument& inner : document_.scene.prototypes)
          if (inner.name == of->name) descend(inner);
      }
      path.pop_back();
      states[prototype.name] = State::done;
    };
    for (const PrototypeDocument& prototype : document_.scene.prototypes)
      if (states[prototype.name] == State::unseen) descend(prototype);
  }

  static const DocumentName* copied_by(const ObjectDocument& object) {
    if (const auto* one = std::get_if<InstanceShape>(&object.shape)) return &one->of;
    if (const auto* many = std::get_if<InstancesShape>(&object.shape)) return &many->of;
    return nullptr;
  }

  void check_channel_names() const {
    std::set<std::string> seen;
    for (const ChannelDocument& channel : document_.sensor.channels) {
      if (!seen.insert(channel.name).second) {
        throw document_error(
            document_.sources, channel.position,
            format("two channels are named '{}'; give one a 'name' of its own", channel.name));
      }
    }
  }

  template <class Source>
  void check_direction(const std::optional<Source>& source, const char* body) const {
    if (!source || source->direction || (document_.time && document_.scene.origin.geographic)) return;
    throw document_error(
        document_.sources, source->position,
        format("the {} has no direction: give 'zenith' and 'azimuth', or {}", body,
               document_.time ? "the scene's 'origin' with 'latitude' and 'longitude'"
               : document_.scene.origin.geographic
                   ? "the document's 'time'"
                   : "the document's 'time' and the scene's 'origin' with 'latitude' and 'longitude'"));
  }

  void check_moon() const {
    const std::optional<MoonDocument>& moon = document_.light.moon;
    if (!moon) return;
    check_direction(moon, "Moon");
    if (!moon->phase_angle_rad && !document_.time)
      throw document_error(document_.sources, moon->position,
                           "the Moon has no phase: give 'phase_angle', or the document's 'time'");
    const std::string maker = document_.atmosphere.imported ? "imported" : document_.atmosphere.sky_maker();
    if (!maker.empty() && maker != "profile")
      throw document_error(
          document_.sources, moon->position,
          format(
              "the atmosphere's '{}' says what light the Sun gives, not the Moon: leave out 'moon', or name a "
              "'profile'",
              maker));
  }

  void check_sky() const {
    const std::string maker = document_.atmosphere.sky_maker();
    if (maker.empty()) return;
    const LightDocument& light = document_.light;
    if (!std::holds_alternative<NoSky>(light.sky))
      throw document_error(
          document_.sources, light.sky_position,
          format("the sky follows from the atmosphere's '{0}': leave out 'sky', or '{0}'", maker));
    if (maker != "profile" && light.sun && light.sun->irradiance)
      throw document_error(
          document_.sources, light.sun->position,
          format("the Sun's light follows from the atmosphere's '{0}': leave out 'spectrum', or '{0}'",
                 maker));
  }

  void check_psf() const {
    const SensorDocument& sensor = document_.sensor;
    const AiryPsf* airy = nullptr;
    const std::shared_ptr<const PupilDocument>* pupil = nullptr;
    bool diffuses = false;
    const std::vector<PsfPart> parts = sensor.psf ? sensor.psf->parts : std::vector<PsfPart>();
    for (const PsfPart& part : parts) {
      if (const auto* found = std::get_if<AiryPsf>(&part)) airy = found;
      if (const auto* found = std::get_if<std::shared_ptr<const PupilDocument>>(&part)) pupil = found;
      diffuses = diffuses || std::holds_alternative<std::shared_ptr<const DiffusionDocument>>(part);
    }
    if (diffuses && !sensor.camera.settings->optics() && (!sensor.detector || !sensor.detector->pitch_m))
      throw document_error(
          document_.sources, sensor.psf_position,
          "carrier diffusion needs a 'frame' camera, whose pitch gives its size in pixels, or "
          "'detector.pitch'");
    if (airy == nullptr && pupil == nullptr) return;
    const bool own_aperture =
        airy != nullptr ? airy->aperture_m.has_value() : (*pupil)->aperture_m.has_value();
    const char *of = airy != nullptr ? "the Airy PSF" : "the PSF of a pupil",
               *one = airy != nullptr ? "an Airy PSF" : "the PSF of a pupil";
    const OpticsDocument none;
    const OpticsDocument& optics = sensor.optics ? *sensor.optics : none;
    if (!own_aperture && !optics.aperture_m && !optics.f_number)
      throw document_error(document_.sources, sensor.psf_position,
                           format("{} has no aperture: give it 'aperture', or the sensor 'optics' with "
                                  "'aperture' or 'f_number'",
                                  of));
    if (sensor.camera.settings->optics()) return;
    const bool focal = optics.focal_length_m || (!own_aperture && optics.f_number);
    if (focal && sensor.detector && sensor.detector->pitch_m) return;
    throw document_error(
        document_.sources, sensor.psf_position,
        format("{} needs a 'frame' camera, whose focal length and pitch give its size in pixels, or "
               "'optics.focal_length' and 'detector.pitch'",
               one));
  }

  const Document& document_;
  std::vector<std::string> materials_, prototypes_, channels_;
};

}  // namespace

void check_references(const Document& document) {
  ReferenceCheck(document).run();
  check_motions(document);
}

}  // namespace ifov::io
