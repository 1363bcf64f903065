#include "render/mirrors/glint_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sampling/random.h"
#include "sampling/warp.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

using geometry::UnitKind;
using math::Point3;
using math::Vec3;

/// Directions closer together than this change evenly across a triangle.
constexpr double kEven = 0.7;
/// What a triangle's directions may lie beyond those of its corners, over their spread.
constexpr double kBeyond = 1.2;
/// Sides of triangles that points are drawn from, on the focal plane.
constexpr double kLongest_px = 0.25;
/// Spread of directions from which Newton's method is begun.
constexpr double kNewton = 1e-2;
constexpr int kDeepest = 80;
/// Of triangles that are seen in part: along the line where a plane of mirrors ends for the camera each division makes more of them.
constexpr int kDeepestInPart = 24;
/// Spread of directions over the slope of a lobe's micro-facets, and over the distance from the highlight's middle.
constexpr double kLobeStep = 0.3, kLobeGrowth = 0.2;
/// Wider triangles might hold a highlight that none of their corners is near.
constexpr double kMostGrowth = 0.6;
/// Sides of triangles of highlights, which are even across them.
constexpr double kLongestOfLobe_px = 0.5;

constexpr std::uint64_t kGlintPoints = 0x676c696e74ull;

double apart(const sampling::FocalPoint& a, const sampling::FocalPoint& b) {
  return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

}  // namespace

GlintSearch::GlintSearch(const sensor::Camera& camera, Vec3 towards_sun, double half_angle_rad,
                         double margin_px, int steps, std::uint64_t seed)
    : camera_(camera),
      towards_sun_(towards_sun),
      half_angle_(half_angle_rad),
      margin_(margin_px),
      step_(half_angle_rad > 0.0 ? half_angle_rad / steps : kNewton),
      seed_(seed) {
  const sampling::TangentFrame frame(towards_sun);
  first_ = frame.first, second_ = frame.second;
}

GlintSearch::GlintSearch(const sensor::Camera& camera, const geometry::SurfaceSurvey::Ball& ball,
                         double margin_px, double steps, std::uint64_t seed, std::size_t most)
    : camera_(camera), ball_(ball), margin_(margin_px), step_(0.0), steps_(steps), most_(most), seed_(seed) {}

GlintSearch::GlintSearch(const sensor::Camera& camera, Vec3 towards_sun, double least_slope, double reach_rad,
                         const Coarseness& coarseness, double margin_px, std::uint64_t seed, std::size_t most)
    : camera_(camera),
      towards_sun_(towards_sun),
      half_angle_(reach_rad),
      margin_(margin_px),
      step_(coarseness.all * kLobeStep * 2.0 * least_slope),
      growth_(coarseness.all * kLobeGrowth),
      tail_(coarseness.tail / (2.0 * least_slope)),
      lobes_(true),
      most_(most),
      seed_(seed) {}

GlintSearch::Corner GlintSearch::corner(const Surface& surface, double u, double v) const {
  Corner c;
  c.u = u, c.v = v;
  Vec3 normal;
  surface(u, v, c.at, normal);
  if (!camera_.project(c.at, c.image)) return c;
  math::Ray ray;
  camera_.rays({&c.image, 1}, {&ray, 1});
  c.from = normalized(ray.direction - 2.0 * dot(ray.direction, normal) * normal);
  c.seen = std::isfinite(c.from.x + c.from.y + c.from.z);
  c.off = c.from, c.wide = half_angle_;
  if (ball_) {
    const Vec3 to = ball_->centre_m - c.at;
    const double distance = length(to);
    c.wide = distance > ball_->radius_m ? std::asin(ball_->radius_m / distance) : std::numbers::pi;
    if (distance > 0.0) c.off = c.from - to / distance;
  }
  return c;
}

void GlintSearch::search(const geometry::SurfaceSurvey::Round& round, std::uint64_t number,
                         const Found& found) {
  solved_.clear();
  const math::Transform& map = round.scene_from_unit;
  const auto locate = [&map](Point3 unit, Vec3 normal, Point3& at, Vec3& out) {
    at = map(unit);
    out = map(math::as_normal(normal)).as_vector();
  };
  if (round.kind == UnitKind::open_cylinder || round.kind == UnitKind::cylinder) {
    const Surface side = [&](double u, double v, Point3& at, Vec3& normal) {
      const double turn = 2.0 * std::numbers::pi * u;
      locate({std::cos(turn), std::sin(turn), v}, {std::cos(turn), std::sin(turn), 0.0}, at, normal);
    };
    for (int k = 0; k < 8; ++k) divide_quad(side, k / 8.0, 0.0, (k + 1) / 8.0, 1.0, number, found);
    return;
  }
  // The faces of a cube blown up to the sphere; of a hemisphere, what is above its rim.
  for (int face = 0; face < 6; ++face) {
    const int axis = face % 3;
    const double side = face < 3 ? 1.0 : -1.0;
    const bool half = round.kind == UnitKind::hemisphere;
    if (half && axis == 2 && side < 0.0) continue;
    const Surface part = [&, axis, side](double u, double v, Point3& at, Vec3& normal) {
      // Of the side faces v runs upwards.
      const double a = std::tan(0.25 * std::numbers::pi * u), b = std::tan(0.25 * std::numbers::pi * v);
      const Vec3 d = normalized(axis == 0   ? Vec3{side, a, b}
                                : axis == 1 ? Vec3{a, side, b}
                                            : Vec3{a, b, side});
      locate(Point3{} + d, d, at, normal);
    };
    divide_quad(part, -1.0, half && axis != 2 ? 0.0 : -1.0, 1.0, 1.0, number, found);
  }
}

void GlintSearch::search(const geometry::SurfaceSurvey::Smooth& smooth, std::uint64_t number,
                         const Found& found) {
  solved_.clear();
  const geometry::MeshLists& mesh = smooth.mesh;
  for (const std::uint32_t t : smooth.triangles) {
    const geometry::Triangle& v = mesh.triangles[t];
    const geometry::Triangle& i = mesh.normal_corners.empty() ? v : mesh.normal_corners[t];
    const Point3 a = smooth.scene_from_mesh(mesh.vertices_m[v[0]]);
    const Vec3 ab = smooth.scene_from_mesh(mesh.vertices_m[v[1]]) - a,
               ac = smooth.scene_from_mesh(mesh.vertices_m[v[2]]) - a;
    const bool facet_alone =
        mesh.normals.empty() || std::find(i.begin(), i.end(), geometry::kNoIndex) != i.end();
    const Vec3 own =
        cross(mesh.vertices_m[v[1]] - mesh.vertices_m[v[0]], mesh.vertices_m[v[2]] - mesh.vertices_m[v[0]]);
    const Vec3 na = facet_alone ? own : mesh.normals[i[0]].as_vector(),
               nb = facet_alone ? Vec3{} : mesh.normals[i[1]].as_vector() - na,
               nc = facet_alone ? Vec3{} : mesh.normals[i[2]].as_vector() - na;
    const Surface facet = [&](double u, double w, Point3& at, Vec3& normal) {
      at = a + ab * u + ac * w;
      normal = smooth.scene_from_mesh(math::as_normal(na + nb * u + nc * w)).as_vector();
    };
    divide(facet, {{corner(facet, 0.0, 0.0), corner(facet, 1.0, 0.0), corner(facet, 0.0, 1.0)}, 0}, number,
           found);
  }
}

void GlintSearch::search(Vec3 plane_normal, double offset_m, std::uint64_t number, const Found& found) {
  // The window about the image of the ball that stands behind the plane.
  const Point3 behind =
      ball_->centre_m - 2.0 * (dot(plane_normal, ball_->centre_m - Point3{}) - offset_m) * plane_normal;
  double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;
  for (int k = 0; k < 8; ++k) {
    const Vec3 to{(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0};
    sampling::FocalPoint image;
    if (!camera_.project(behind + ball_->radius_m * to, image)) {
      broken_off_ = true;
      return;
    }
    low_x = std::min(low_x, image.x_px), high_x = std::max(high_x, image.x_px);
    low_y = std::min(low_y, image.y_px), high_y = std::max(high_y, image.y_px);
  }
  // What stands beside the camera has a window as large as one likes.
  low_x = std::max(low_x, -margin_), high_x = std::min(high_x, camera_.width_px() + margin_);
  low_y = std::max(low_y, -margin_), high_y = std::min(high_y, camera_.height_px() + margin_);
  if (!(low_x < high_x) || !(low_y < high_y)) return;
  const Surface window = [&](double u, double v, Point3& at, Vec3& normal) {
    const sampling::FocalPoint image{u, v};
    math::Ray ray;
    camera_.rays({&image, 1}, {&ray, 1});
    const double facing = dot(ray.direction, plane_normal);
    const double along = (offset_m - dot(plane_normal, ray.origin_m - Point3{})) / facing;
    // Behind the camera, and along the line of sight, there is no mirror.
    constexpr double kGrazing = 1e-9;
    at = along > 0.0 && std::abs(facing) > kGrazing ? ray.origin_m + along * ray.direction
                                                    : Point3{NAN, NAN, NAN};
    normal = plane_normal;
  };
  least_part_ = kLongest_px;
  divide_quad(window, low_x, low_y, high_x, high_y, number, found);
  least_part_ = 0.0;
}

void GlintSearch::divide_quad(const Surface& surface, double u0, double v0, double u1, double v1,
                              std::uint64_t number, const Found& found) {
  const Corner a = corner(surface, u0, v0), b = corner(surface, u1, v0), c = corner(surface, u1, v1),
               d = corner(surface, u0, v1);
  divide(surface, {{a, b, c}, 0}, number, found);
  divide(surface, {{a, c, d}, 0}, number, found);
}

void GlintSearch::divide(const Surface& surface, const Cell& whole, std::uint64_t number,
                         const Found& found) {
  if (broken_off_) return;
  cells_.assign(1, whole);
  while (!cells_.empty()) {
    const Cell cell = cells_.back();
    cells_.pop_back();
    const Corner* c = cell.corner;
    const bool seen = c[0].seen && c[1].seen && c[2].seen;
    int longest = 0;
    if (seen) {
      double spread = 0.0, side_px = 0.0, worst = -1.0, wide = half_angle_, step = step_;
      if (ball_) {
        wide = std::max({c[0].wide, c[1].wide, c[2].wide});
        step = std::min({c[0].wide, c[1].wide, c[2].wide}) / steps_;
      }
      // Where steps differ much, sides that are judged each by itself make slivers.
      const double of_all = std::min({length(c[0].from - towards_sun_), length(c[1].from - towards_sun_),
                                      length(c[2].from - towards_sun_)});
      for (int k = 0; k < 3; ++k) {
        const double turn = length(c[k].off - c[(k + 1) % 3].off),
                     px = apart(c[k].image, c[(k + 1) % 3].image);
        spread = std::max(spread, turn), side_px = std::max(side_px, px);
        const double nearest = tail_ > 0.0 ? of_all
                                           : std::min(length(c[k].from - towards_sun_),
                                                      length(c[(k + 1) % 3].from - towards_sun_));
        const double grown =
            lobes_ ? step + std::min(growth_ * (1.0 + tail_ * nearest), kMostGrowth) * nearest : step;
        const double longest_px = lobes_ ? kLongestOfLobe_px : kLongest_px;
        const double needed = std::max(turn / grown, wide > 0.0 ? px / longest_px : 0.0);
        if (needed > worst) worst = needed, longest = k;
      }
      if (spread < kEven) {
        const Vec3 middle = (c[0].off + c[1].off + c[2].off) / 3.0;
        if (length(middle - towards_sun_) > 1.01 * wide + kBeyond * spread) continue;
        const double reach = margin_ + side_px;
        bool left = true, right = true, above = true, below = true;
        for (int k = 0; k < 3; ++k) {
          left = left && c[k].image.x_px < -reach,
          right = right && c[k].image.x_px > camera_.width_px() + reach;
          above = above && c[k].image.y_px < -reach,
          below = below && c[k].image.y_px > camera_.height_px() + reach;
        }
        if (left || right || above || below) continue;
      }
      if (worst <= 1.0) {
        if (wide > 0.0) {
          broken_off_ = drawn_ >= most_;
          if (broken_off_) return;
          if (found)
            draw(surface, cell, number, found);
          else
            ++drawn_;
        } else if (found)
          solve(surface, cell, found);
        continue;
      }
    } else {
      if (!c[0].seen && !c[1].seen && !c[2].seen && cell.depth > 12) continue;
      if (cell.depth > kDeepestInPart) continue;
      // The longest side by its parameters: else triangles become slivers along the line where they are no longer seen.
      double side = -1.0;
      for (int k = 0; k < 3; ++k) {
        const Corner &from = c[k], &to = c[(k + 1) % 3];
        const double parameters = std::hypot(to.u - from.u, to.v - from.v);
        if (parameters > side) side = parameters, longest = k;
      }
      if (side < least_part_) continue;
    }
    if (cell.depth >= kDeepest) continue;
    const Corner &p = c[longest], &q = c[(longest + 1) % 3], &r = c[(longest + 2) % 3];
    const Corner middle = corner(surface, 0.5 * (p.u + q.u), 0.5 * (p.v + q.v));
    cells_.push_back({{p, middle, r}, cell.depth + 1});
    cells_.push_back({{middle, q, r}, cell.depth + 1});
  }
}

bool GlintSearch::shows(const Corner& corner) const {
  if (lobes_) return true;
  if (!ball_) return length(cross(corner.from, towards_sun_)) < std::sin(half_angle_);
  return length(corner.off) <= 2.0 * std::sin(0.5 * corner.wide) * (1.0 + 1e-9);
}

GlintSearch::Corner GlintSearch::within(const Surface& surface, const Cell& cell, double s, double t) const {
  const Corner* c = cell.corner;
  return corner(surface, c[0].u + s * (c[1].u - c[0].u) + t * (c[2].u - c[0].u),
                c[0].v + s * (c[1].v - c[0].v) + t * (c[2].v - c[0].v));
}

double GlintSearch::area_at(const Surface& surface, const Cell& cell, double s, double t,
                            const Corner& here) const {
  constexpr double kStep = 1e-4;
  const Corner along_s = within(surface, cell, s + kStep, t), along_t = within(surface, cell, s, t + kStep);
  const double xs = along_s.image.x_px - here.image.x_px, ys = along_s.image.y_px - here.image.y_px;
  const double xt = along_t.image.x_px - here.image.x_px, yt = along_t.image.y_px - here.image.y_px;
  return 0.5 * std::abs(xs * yt - xt * ys) / (kStep * kStep);
}

void GlintSearch::draw(const Surface& surface, const Cell& cell, std::uint64_t number, const Found& found) {
  const Corner* c = cell.corner;
  const double x1 = c[1].image.x_px - c[0].image.x_px, y1 = c[1].image.y_px - c[0].image.y_px;
  const double x2 = c[2].image.x_px - c[0].image.x_px, y2 = c[2].image.y_px - c[0].image.y_px;
  const double area = 0.5 * std::abs(x1 * y2 - x2 * y1);
  const std::uint64_t key = sampling::hash(seed_, number, drawn_++, kGlintPoints);
  for (std::uint32_t k = 0; k < kReplicates; ++k) {
    const double root = std::sqrt(sampling::unit_double(key + 2 * k)),
                 share = sampling::unit_double(key + 2 * k + 1);
    const double s = root * (1.0 - share), t = root * share;
    const Corner at = within(surface, cell, s, t);
    // Triangles of lobes are too wide for an image without curvature.
    if (at.seen && shows(at)) found({at.at, at.image, lobes_ ? area_at(surface, cell, s, t, at) : area, k});
  }
}

void GlintSearch::solve(const Surface& surface, const Cell& cell, const Found& found) {
  const Corner* c = cell.corner;
  const auto at = [&](double s, double t) { return within(surface, cell, s, t); };
  constexpr double kStep = 1e-4, kOutside = 1e-7;
  double s = 1.0 / 3.0, t = s;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Corner here = at(s, t), along_s = at(s + kStep, t), along_t = at(s, t + kStep);
    if (!here.seen || !along_s.seen || !along_t.seen) return;
    const double f = dot(here.from, first_), g = dot(here.from, second_);
    const double fs = (dot(along_s.from, first_) - f) / kStep, gs = (dot(along_s.from, second_) - g) / kStep;
    const double ft = (dot(along_t.from, first_) - f) / kStep, gt = (dot(along_t.from, second_) - g) / kStep;
    const double turn = fs * gt - ft * gs;
    // Where directions change along one line alone, they pass the point or they do not: it is shown nowhere.
    if (std::abs(turn) < 1e-9 * (fs * fs + gs * gs + ft * ft + gt * gt)) return;
    const double ds = (ft * g - gt * f) / turn, dt = (gs * f - fs * g) / turn;
    s += ds, t += dt;
    if (!(std::abs(s) < 10.0 && std::abs(t) < 10.0)) return;
    if (std::hypot(ds, dt) > 1e-9) continue;
    if (s < -kOutside || t < -kOutside || s + t > 1.0 + kOutside) return;
    const double xs = (along_s.image.x_px - here.image.x_px) / kStep,
                 ys = (along_s.image.y_px - here.image.y_px) / kStep;
    const double xt = (along_t.image.x_px - here.image.x_px) / kStep,
                 yt = (along_t.image.y_px - here.image.y_px) / kStep;
    const double size = length(c[1].at - c[0].at) + length(c[2].at - c[0].at);
    for (const Point3& known : solved_)
      if (length(known - here.at) < 1e-5 * size) return;  // on the side of two triangles
    if (dot(here.from, towards_sun_) <= 0.0) return;
    solved_.push_back(here.at);
    const double area = std::abs((xs * yt - xt * ys) / turn);
    for (std::uint32_t k = 0; k < kReplicates; ++k) found({here.at, here.image, area, k});
    return;
  }
}

}  // namespace ifov::render
