#include "transport/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/world.h"
#include "scene/scene.h"
#include "transport/emitter_choice.h"
#include "transport/emitter_tree.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

using geometry::PieceKind;
using geometry::SurfacePiece;
using geometry::SurfacePoint;
using math::Point3;
using math::Vec3;

namespace {

/// Of a piece that a map covers, the least part of what its surface assignment may emit that it is taken to emit: what lies between
/// the points that are looked at.
constexpr double kLeastPart = 0.01;

/// Points of a unit shape at which a mapped piece is looked at, with a direction in which they are looked at.
struct Viewpoint {
  Point3 at;
  Vec3 along;
};
std::vector<Viewpoint> viewpoints_of(PieceKind kind) {
  const Vec3 down{0.0, 0.0, -1.0};
  std::vector<Viewpoint> viewpoints;
  switch (kind) {
    case PieceKind::triangle:
      return {{{1.0 / 3.0, 1.0 / 3.0, 0.0}, down},
              {{0.6, 0.2, 0.0}, down},
              {{0.2, 0.6, 0.0}, down},
              {{0.2, 0.2, 0.0}, down}};
    case PieceKind::parallelogram:
      for (int k = 0; k < 16; ++k)
        viewpoints.push_back({{0.125 + 0.25 * (k % 4), 0.125 + 0.25 * (k / 4), 0.0}, down});
      return viewpoints;
    case PieceKind::disk:
      for (const double x : {-0.5, 0.0, 0.5})
        for (const double y : {-0.5, 0.0, 0.5}) viewpoints.push_back({{x, y, 0.0}, down});
      return viewpoints;
    case PieceKind::open_cylinder:
      for (int k = 0; k < 8; ++k) {
        const double x = std::cos(0.785398 * k), y = std::sin(0.785398 * k);
        viewpoints.push_back({{x, y, 0.25 + 0.5 * (k % 2)}, {-x, -y, 0.0}});
      }
      return viewpoints;
    case PieceKind::ball:
    case PieceKind::hemisphere:
      for (int k = 0; k < 12; ++k) {
        const double z = kind == PieceKind::hemisphere ? 0.1 + 0.4 * (k / 6) : -0.6 + 0.6 * (k / 4);
        const double r = std::sqrt(1.0 - z * z), x = r * std::cos(2.4 * k), y = r * std::sin(2.4 * k);
        viewpoints.push_back({{x, y, z}, {-x, -y, -z}});
      }
      return viewpoints;
  }
  return viewpoints;
}

bool is_of(const SurfacePiece& piece, const SurfacePoint& hit) {
  return hit.hit() && hit.instance == piece.object && hit.primitive == piece.primitive &&
         hit.patch == piece.patch;
}

/// The mean of what a mapped piece emits, by rays that are sent at it from close by.
GroupedRadiance looked_at(const SpectralScene& scene, const EmitterChoice& choice,
                          const SurfacePiece& piece) {
  constexpr double kNear = 1e-3;
  std::vector<math::Ray> rays;
  const math::Transform& map = piece.scene_from_unit;
  const double size = std::sqrt(geometry::area_m2(piece));
  for (const Viewpoint& view : viewpoints_of(piece.kind)) {
    Vec3 along = map(view.along);
    if (view.along.z == -1.0 && piece.kind != PieceKind::ball)
      along = math::cross(map.column_y(), map.column_x());
    along = math::normalized(along);
    rays.push_back({map(view.at) - kNear * size * along, along});
  }
  std::vector<SurfacePoint> hits(rays.size());
  scene.scene().world->intersect(rays, hits);
  radiometry::SpectrumBlock scratch(3, scene.node_count());
  GroupedRadiance mean;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!is_of(piece, hits[k])) continue;
    const GroupedRadiance one = choice.brightness(
        piece.material, scene.emission(scene.scene().resolve(hits[k]), -rays[k].direction, scratch.row(0)));
    for (std::size_t g = 0; g < mean.of.size(); ++g) mean.of[g] += one.of[g];
  }
  for (std::size_t g = 0; g < mean.of.size(); ++g)
    mean.of[g] = std::max(mean.of[g] / static_cast<double>(rays.size()),
                          kLeastPart * choice.brightest(piece.material).of[g]);
  return mean;
}

/// Whether triangles of one object close on themselves, judged by the sum of their area vectors.
class Closure {
 public:
  void add(const SurfacePiece& piece) {
    const Vec3 area = math::cross(piece.scene_from_unit.column_x(), piece.scene_from_unit.column_y());
    sum_ = sum_ + area;
    whole_ += math::length(area);
    ++count_;
  }
  bool closed() const { return count_ >= 4 && math::length(sum_) < 1e-3 * whole_; }

 private:
  Vec3 sum_{};
  double whole_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

Emitters::Emitters() = default;
Emitters::~Emitters() = default;

double Emitters::reach(const Receiver& receiver) const { return tree_->reach(at_home(receiver).receiver); }

std::unique_ptr<const Emitters> Emitters::find(const SpectralScene& scene) {
  if (scene.scene().world == nullptr) return nullptr;  // spectra alone
  const EmitterChoice choice(scene);
  if (!choice.any()) return nullptr;
  std::unique_ptr<Emitters> emitters(new Emitters());
  emitters->take(scene, choice);
  emitters->finish();
  return emitters;
}

void Emitters::take(const SpectralScene& scene, const EmitterChoice& choice) {
  const geometry::World& world = *scene.scene().world;
  wanted_ = choice.wanted();
  groups_ = choice.group_count();
  in_part_.assign(wanted_.size(), false);
  geometry::WantedMaterials declined(wanted_.size(), false);
  for (std::uint32_t a = 0; a < wanted_.size(); ++a) {
    outshone_ = outshone_ || choice.outshines(a);
    if (!choice.declined(a)) continue;
    wanted_[a] = false;
    declined[a] = choice.outshines(a);
    declines_some_ = declines_some_ || declined[a];
  }
  patterns_.assign(wanted_.size(), nullptr);
  for (std::size_t a = 0; a < wanted_.size(); ++a)
    if (const scene::SurfaceAssignment& assignment = scene.scene().assignments[a];
        assignment.states.size() == 1)
      patterns_[a] = scene.lamp_pattern(assignment.states[0]);
  if (const auto period = world.period()) {
    repeats_ = true;
    period_ = *period;
  }
  if (declines_some_) leave_out(world, declined);
  const std::size_t most = repeats_ ? kMost / 9 : kMost;
  leave_many_faint(world, choice, most / 16);
  std::vector<SurfacePiece> pieces;
  std::vector<double> area(wanted_.size(), 0.0);
  bool too_many = false;
  geometry::WantedMaterials looked_through = wanted_;
  for (std::uint32_t a = 0; a < looked_through.size(); ++a)
    looked_through[a] = looked_through[a] || choice.outshines(a);
  world.visit_surfaces(looked_through, [&](const SurfacePiece& piece) {
    const double part = geometry::area_m2(piece);
    area[piece.material] += part;
    if (!(part > 0.0) || !wanted_[piece.material]) return;
    if (pieces.size() < most)
      pieces.push_back(piece);
    else
      too_many = true;
  });
  const std::vector<double> whole = world.surface_areas_m2(wanted_.size());
  for (std::uint32_t c = 0; c < wanted_.size(); ++c)
    if (choice.wanted()[c] && area[c] < 0.99 * whole[c])
      in_part_[c] = true, passes_over_ = passes_over_ || choice.outshines(c);
  if (too_many) {
    pieces.clear();
    passes_over_ = true;
    leave_out(world, wanted_);
  }
  for (std::size_t first = 0; first < pieces.size();) {
    std::size_t last = first;
    Closure closure;
    for (; last < pieces.size() && pieces[last].object == pieces[first].object; ++last)
      if (pieces[last].kind == PieceKind::triangle) closure.add(pieces[last]);
    for (; first < last; ++first) {
      const SurfacePiece& piece = pieces[first];
      const GroupedRadiance radiance =
          choice.mapped(piece.material) ? looked_at(scene, choice, piece) : choice.brightest(piece.material);
      add(piece, piece.kind == PieceKind::triangle && closure.closed(), radiance);
    }
  }
}

void Emitters::leave_many_faint(const geometry::World& world, const EmitterChoice& choice, std::size_t most) {
  geometry::WantedMaterials faint(wanted_.size(), false);
  bool any = false;
  for (std::uint32_t a = 0; a < wanted_.size(); ++a) {
    faint[a] = wanted_[a] && !choice.outshines(a) && !choice.lamp(a);
    any = any || faint[a];
  }
  if (!any) return;
  std::size_t count = world.triangle_count() + world.object_count();
  if (count <= kMostLookedThrough) {
    count = 0;
    world.visit_surfaces(faint, [&](const SurfacePiece&) { ++count; });
  }
  if (count <= most) return;
  for (std::size_t a = 0; a < wanted_.size(); ++a) wanted_[a] = wanted_[a] && !faint[a];
}

void Emitters::leave_out(const geometry::World& world, const geometry::WantedMaterials& what) {
  constexpr double kCells = 8.0;  // along a side of the scene
  const geometry::World::Bounds bounds = world.bounds();
  const Vec3 sides = bounds.high_m - bounds.low_m;
  const double cell_m = std::max({sides.x, sides.y, sides.z, 1e-9}) / kCells;
  struct Box {
    Point3 low, high;
    double area_m2 = 0.0;
  };
  std::map<std::array<std::int64_t, 4>, Box> boxes;
  world.visit_surfaces(what, [&](const SurfacePiece& piece) {
    const EmitterShape shape(piece, false);
    const Point3 c = shape.centre_m();
    const double r = shape.radius_m();
    const auto cell = [&](double at, double low) {
      return static_cast<std::int64_t>(std::floor((at - low) / cell_m));
    };
    const auto [known, fresh] = boxes.try_emplace(
        {piece.material, cell(c.x, bounds.low_m.x), cell(c.y, bounds.low_m.y), cell(c.z, bounds.low_m.z)});
    Box& box = known->second;
    if (fresh) box.low = box.high = c;
    box.low = {std::min(box.low.x, c.x - r), std::min(box.low.y, c.y - r), std::min(box.low.z, c.z - r)};
    box.high = {std::max(box.high.x, c.x + r), std::max(box.high.y, c.y + r), std::max(box.high.z, c.z + r)};
    box.area_m2 += geometry::area_m2(piece);
  });
  for (const auto& [name, box] : boxes)
    for (int column = repeats_ ? -1 : 0; column <= (repeats_ ? 1 : 0); ++column)
      for (int row = repeats_ ? -1 : 0; row <= (repeats_ ? 1 : 0); ++row) {
        const Vec3 moved{column * period_.x_m, row * period_.y_m, 0.0};
        left_out_.push_back({{box.low + (box.high - box.low) * 0.5 + moved, 0.5 * length(box.high - box.low)},
                             box.area_m2,
                             static_cast<std::uint32_t>(name[0])});
      }
}

void Emitters::add(const SurfacePiece& piece, bool closed, const GroupedRadiance& radiance) {
  const auto put = [&](const SurfacePiece& placed, std::int32_t column, std::int32_t row) {
    emitters_.push_back({EmitterShape(placed, closed), radiance, column, row, patterns_[piece.material]});
    names_.push_back({piece.object, piece.primitive, piece.patch, column, row});
  };
  if (!repeats_) return put(piece, 0, 0);
  const Point3 centre = EmitterShape(piece, closed).centre_m();
  const int home_column = static_cast<int>(std::floor(centre.x / period_.x_m));
  const int home_row = static_cast<int>(std::floor(centre.y / period_.y_m));
  for (int column = -1 - home_column; column <= 1 - home_column; ++column)
    for (int row = -1 - home_row; row <= 1 - home_row; ++row) {
      SurfacePiece placed = piece;
      placed.scene_from_unit = math::Transform::translation({column * period_.x_m, row * period_.y_m, 0.0}) *
                               piece.scene_from_unit;
      put(placed, column, row);
    }
}

void Emitters::finish() {
  by_name_.resize(emitters_.size());
  std::iota(by_name_.begin(), by_name_.end(), 0u);
  std::sort(by_name_.begin(), by_name_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return names_[a] < names_[b]; });
  if (!emitters_.empty()) tree_ = std::make_unique<EmitterTree>(emitters_, groups_);
}

Emitters::Home Emitters::at_home(const Receiver& receiver) const {
  Home home{receiver, 0, 0};
  if (!repeats_) return home;
  home.column = static_cast<std::int32_t>(std::floor(receiver.at_m.x / period_.x_m));
  home.row = static_cast<std::int32_t>(std::floor(receiver.at_m.y / period_.y_m));
  home.receiver.at_m = receiver.at_m - Vec3{home.column * period_.x_m, home.row * period_.y_m, 0.0};
  return home;
}

Emitters::Aim Emitters::aim(const Receiver& receiver, sampling::Point2 u) const {
  Aim aim;
  const Home home = at_home(receiver);
  const EmitterTree::Choice choice = tree_->choose(home.receiver, u.x);
  if (!(choice.probability > 0.0)) return aim;
  const AimedDirection aimed = emitters_[choice.emitter].shape.aim(home.receiver, {choice.rest, u.y});
  aim.direction = aimed.direction;
  aim.density = choice.probability * aimed.density;
  aim.emitter = choice.emitter;
  aim.column = home.column;
  aim.row = home.row;
  return aim;
}

Emitters::Point Emitters::point(const Receiver& receiver, sampling::Point2 u) const {
  Point point;
  const Home home = at_home(receiver);
  const EmitterTree::Choice choice = tree_->choose(home.receiver, u.x);
  if (!(choice.probability > 0.0)) return point;
  static_cast<SurfaceSample&>(point) = emitters_[choice.emitter].shape.point({choice.rest, u.y});
  static_cast<Piece&>(point) = {choice.emitter, home.column, home.row};
  point.at_m = point.at_m + Vec3{home.column * period_.x_m, home.row * period_.y_m, 0.0};
  point.density *= choice.probability;
  return point;
}

bool Emitters::is(const Piece& piece, const SurfacePoint& hit) const {
  const Name& name = names_[piece.emitter];
  return hit.hit() && hit.instance == name.object && hit.primitive == name.primitive &&
         hit.patch == name.patch && hit.copy_column == name.column + piece.column &&
         hit.copy_row == name.row + piece.row;
}

std::optional<std::uint32_t> Emitters::emitter_of(const Home& home, const SurfacePoint& hit) const {
  if (!hit.hit() || !wanted_[hit.material]) return {};
  const Name name{hit.instance, hit.primitive, hit.patch, hit.copy_column - home.column,
                  hit.copy_row - home.row};
  const auto found = std::lower_bound(by_name_.begin(), by_name_.end(), name,
                                      [&](std::uint32_t a, const Name& b) { return names_[a] < b; });
  if (found == by_name_.end() || names_[*found] != name) return {};
  return *found;
}

double Emitters::density(const Receiver& receiver, Vec3 direction, const SurfacePoint& hit) const {
  const Home home = at_home(receiver);
  const std::optional<std::uint32_t> emitter = emitter_of(home, hit);
  if (!emitter) return 0.0;
  const double probability = tree_->probability(home.receiver, *emitter);
  return probability > 0.0
             ? probability * emitters_[*emitter].shape.density(home.receiver, direction, hit.distance_m)
             : 0.0;
}

double Emitters::point_density(const Receiver& receiver, const SurfacePoint& hit) const {
  const Home home = at_home(receiver);
  const std::optional<std::uint32_t> emitter = emitter_of(home, hit);
  if (!emitter) return 0.0;
  const Vec3 moved{home.column * period_.x_m, home.row * period_.y_m, 0.0};
  return tree_->probability(home.receiver, *emitter) *
         emitters_[*emitter].shape.point_density(hit.position_m - moved);
}

}  // namespace ifov::transport
