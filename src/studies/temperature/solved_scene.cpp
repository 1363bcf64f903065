#include "studies/temperature/solved_scene.h"

#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "studies/temperature/kept_document.h"
#include "thermal/surface_solution.h"

namespace ifov::studies {
namespace {

constexpr double kStudySun_rad = 0.00465;  // radius of the disc

}  // namespace

struct SolvedScene::Inside {
  session::Session session;
  session::DocumentOutdoors about;

  session::ByMaterial by_material{};

  explicit Inside(session::Session loaded)
      : session(std::move(loaded)),
        about(session::outdoors_of_document(session.parts().document, *session.parts().weather)) {}
};

SolvedScene::SolvedScene(const io::Document& document, const std::string& name, const StudyOptions& options) {
  session::LoadOptions loading;
  loading.unseen_temperatures = true;
  auto inside = std::make_unique<Inside>(
      session::Session::load(kept_document(document, name, options), nullptr, loading));
  const session::Parts& all = inside->session.parts();
  inside->by_material = session::solved_materials(all.document, all.scene, inside->about.mean_air_k);
  inside_ = std::move(inside);
}

SolvedScene::~SolvedScene() = default;

const thermal::OutdoorsSeries& SolvedScene::series() const { return inside_->about.outdoors.series; }

double SolvedScene::half_width_k() const {
  double largest_k = 0.0;
  for (const auto& [material, error] : inside_->session.parts().temperature_errors->by_material)
    largest_k = std::max(largest_k, half_width_k(material));
  return largest_k;
}

double SolvedScene::half_width_k(std::size_t material) const {
  session::TemperatureErrors::OfMaterial error =
      inside_->session.parts().temperature_errors->by_material.at(static_cast<std::uint32_t>(material));
  error.beside_k = error.met_beside_k = 0.0;
  return error.half_width_k();
}

double SolvedScene::whole_half_width_k(std::size_t material) const {
  return inside_->session.parts()
      .temperature_errors->by_material.at(static_cast<std::uint32_t>(material))
      .whole_half_width_k();
}

session::BesideOff SolvedScene::beside_off(std::size_t material, const geometry::SurfacePoint& point,
                                           std::uint64_t key,
                                           const exposure::SolvedSurface::Exposure& exposure,
                                           double full_k) const {
  const scene::Scene& scene = inside_->session.parts().scene;
  const exposure::SolvedSurface& of = *surface(material);
  thermal::Stand stand;
  stand.terrain = inside_->about.terrain;
  return session::beside_off({scene, of.scene(), inside_->by_material, series(), stand, kStudySun_rad}, of,
                             inside_->by_material.at(static_cast<std::uint32_t>(material)), point, key,
                             exposure, full_k);
}

const exposure::SolvedSurface* SolvedScene::surface(std::size_t material) const {
  const auto& solved = inside_->session.parts().scene.solved;
  return material < solved.size() ? dynamic_cast<const exposure::SolvedSurface*>(solved[material].get())
                                  : nullptr;
}

geometry::SurfacePoint SolvedScene::met_by(math::Point3 from_m, math::Vec3 direction) const {
  const math::Ray ray{.origin_m = from_m, .direction = direction};
  geometry::SurfacePoint hit;
  inside_->session.parts().scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

std::size_t SolvedScene::solved_material(const geometry::SurfacePoint& point) const {
  if (!point.hit()) return kNone;
  const scene::Scene& scene = inside_->session.parts().scene;
  const scene::ResolvedSurface resolved = scene.resolve_without_temperature(point);
  const std::uint32_t by = scene.states[resolved.constituents[0].state].solved;
  return by == 0 ? kNone : by - 1;
}

double SolvedScene::full_k(std::size_t material, thermal::Stand stand, std::vector<double> visibility,
                           std::vector<double> free_sky) const {
  return full_k(material, stand, series(), std::move(visibility), std::move(free_sky));
}

double SolvedScene::full_k(std::size_t material, thermal::Stand stand, const thermal::OutdoorsSeries& series,
                           std::vector<double> visibility, std::vector<double> free_sky) const {
  const session::ThermalMaterial& of = inside_->by_material.at(static_cast<std::uint32_t>(material)).thermal;
  stand.terrain = inside_->about.terrain;
  return thermal::solve_surface(of.solid, of.skin, stand, series, of.start, std::move(visibility),
                                std::move(free_sky))
      .history.nodes.back()
      .surface_k;
}

std::unique_ptr<const exposure::SolvedSurface> SolvedScene::surface_under(
    std::size_t material, const thermal::OutdoorsSeries& series) const {
  const session::ThermalMaterial& of = inside_->by_material.at(static_cast<std::uint32_t>(material)).thermal;
  thermal::Stand stand;
  stand.terrain = inside_->about.terrain;
  const exposure::PastScene past(*inside_->session.parts().scene.world);
  return std::make_unique<const exposure::SolvedSurface>(
      std::make_shared<const thermal::SurfaceClasses>(
          std::make_shared<const thermal::OutdoorsSeries>(series),
          thermal::ClassSurface{of.solid, of.skin, stand, of.start}, 1, false, past.highest_m()),
      past, kStudySun_rad);
}

double mean_estimate_k(const exposure::SolvedSurface& surface, const geometry::SurfacePoint& point, int draws,
                       std::uint64_t seed) {
  double sum_k = 0.0;
  for (int k = 0; k < draws; ++k)
    sum_k += surface.at(point, seed * 1000003 + static_cast<std::uint64_t>(k)).kelvin / draws;
  return sum_k;
}

}  // namespace ifov::studies
