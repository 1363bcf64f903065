// Glossy things, panes and glass, water: surfaces whose models are not separable, in the Sun.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

using Corner = std::array<double, 3>;

/// Smooth things are not met by a Sun that is a point.
void with_disc(WildDraft& draft) {
  if (const auto at = draft.light.find("\"point\""); at != std::string::npos)
    draft.light.replace(at, 7, "\"disc\"");
}

/// A coat, a metal or a plastic; the width of its slopes.
double glossy(WildDraft& draft, const std::string& name) {
  RandomStream& random = draft.random;
  const double width = random.magnitude(0.02, 0.5);
  switch (random.index(3)) {
    case 0:
      draft.material(
          name,
          format(
              R"("reflectance": {:.3f}, "scattering": {{"rough_conductor": {{{}, "roughness": {:.4f}, "distribution": "{}"}}}})",
              random.between(0.5, 1.0),
              random.one_of({R"("index": "aluminium")", R"("index": "gold")", R"("n": 2.5, "k": 3)"}), width,
              random.one_of({"ggx", "beckmann"})));
      break;
    case 1:
      draft.material(
          name,
          format(
              R"("reflectance": {:.3f}, "scattering": {{"rough_dielectric": {{"index": {:.2f}, "roughness": {:.4f}}}}})",
              random.between(0.02, 0.7), random.between(1.3, 1.8), width));
      break;
    default:
      draft.material(
          name,
          format(
              R"("reflectance": {:.3f}, "scattering": {{"ward": {{"specular": {:.3f}, "roughness": {:.4f}{}}}}})",
              random.between(0.02, 0.5), random.magnitude(0.01, 0.3), width,
              random.with(0.3) ? format(R"(, "across": {:.4f})", std::min(0.5, 2.0 * width)) : ""));
  }
  return width;
}

void cylinder(WildDraft& draft, Corner base, double radius, double height, const std::string& what) {
  draft.objects.push_back(
      format(R"({{"cylinder": {{"base": {}, "radius": {}, "height": {}}}, "material": "{}"}})",
             draft.point(base[0], base[1], base[2]), draft.length(radius), draft.length(height), what));
}

/// A lump of flat faces, as an OBJ file: a ring about a top.
void lump(WildDraft& draft, const std::string& file, Corner middle, double radius, double height,
          const std::string& what) {
  RandomStream& random = draft.random;
  const int around = static_cast<int>(5 + random.index(12));
  std::string text = "usemtl lump\n";
  const auto vertex = [&](double x, double y, double z) {
    const math::Point3 p = draft.place(middle[0] + x, middle[1] + y, middle[2] + z);
    text += format("v {} {} {}\n", p.x, p.y, p.z);
  };
  vertex(0.0, 0.0, height);
  for (int k = 0; k < around; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / around, r = radius * random.between(0.7, 1.0);
    vertex(r * std::cos(angle), r * std::sin(angle), 0.0);
  }
  for (int k = 0; k < around; ++k) text += format("f 1 {} {}\n", k + 2, (k + 1) % around + 2);
  std::ofstream out(draft.folder / file);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + (draft.folder / file).string());
  draft.objects.push_back(
      format(R"({{"mesh": {{"file": "{}"}}, "material": {{"slots": {{"lump": "{}"}}}}}})", file, what));
}

/// A rectangle about a point, turned to any side and leaning by so much from upright.
std::array<Corner, 4> rectangle(RandomStream& random, Corner middle, double wide, double high, double lean) {
  const double turn = random.between(0.0, 2.0 * std::numbers::pi);
  const double along[2] = {std::cos(turn), std::sin(turn)};
  std::array<Corner, 4> corners;
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double a = 0.5 * wide * signs[k][0], b = 0.5 * high * signs[k][1];
    corners[k] = {middle[0] + a * along[0] - b * std::sin(lean) * along[1],
                  middle[1] + a * along[1] + b * std::sin(lean) * along[0], middle[2] + b * std::cos(lean)};
  }
  return corners;
}

void throws_about(WildDraft& draft, Corner middle, double radius) {
  draft.hints.around_mirrors.push_back(
      {draft.place(middle[0], middle[1], middle[2]), radius * draft.gsd_m * (1.0 + 1e-6)});
}

/// Boxes and posts in paint, to be seen and shadowed.
void painted_things(WildDraft& draft, int count, double high) {
  RandomStream& random = draft.random;
  draft.surface("paint");
  draft.surface("other");
  for (int k = 0; k < count; ++k) {
    const double x = random.between(-6.0, 5.0), y = random.between(-6.0, 5.0),
                 top = random.magnitude(0.1, high);
    const char* what = random.with(0.5) ? "paint" : "other";
    if (random.with(0.7))
      draft.box({x, y, 0.0}, {x + random.magnitude(0.1, 3.0), y + random.magnitude(0.1, 3.0), top}, what);
    else
      cylinder(draft, {x, y, 0.0}, random.magnitude(0.05, 0.5), top, what);
  }
}

void panes(WildDraft& draft) {
  RandomStream& random = draft.random;
  const int count = random.one_of({1, 2, 4});
  draft.material(
      "pane",
      random.with(0.7)
          ? format(R"("scattering": {{"slab": {{"n": {:.2f}, "k": {}, "thickness": "{:.1f} mm"}}}})",
                   random.between(1.3, 1.9), random.one_of({"0", "1e-7", "2e-5"}),
                   random.magnitude(1.0, 20.0))
          : format(
                R"("scattering": {{"film": {{"n": {:.2f}, "k": 0, "thickness": "{:.6f} mm", "substrate_n": 1.5, "substrate_k": 0, "pane": "4 mm"}}}})",
                random.between(1.3, 2.4), random.between(5e-5, 3e-4)));
  for (int k = 0; k < count; ++k) {
    const double wide = random.magnitude(0.4, 9.0), high = random.magnitude(0.4, 6.0);
    const double lean = random.one_of({0.0, random.between(-0.5, 0.5), random.between(-1.5, 1.5)});
    const Corner middle{random.between(-5.0, 5.0), random.between(-5.0, 5.0),
                        0.5 * high + random.one_of({0.01, random.between(0.1, 3.0)})};
    const std::array<Corner, 4> corners = rectangle(random, middle, wide, high, lean);
    draft.polygon({corners.begin(), corners.end()}, "pane");
    throws_about(draft, middle, 0.5 * std::hypot(wide, high));
  }
  if (random.with(0.3)) {
    draft.material("mirror",
                   format(R"("reflectance": {:.3f}, "scattering": "mirror")", random.between(0.5, 0.95)));
    const Corner middle{random.between(-5.0, 5.0), random.between(-5.0, 5.0), 2.5};
    const std::array<Corner, 4> corners = rectangle(random, middle, 4.0, 4.0, random.between(-0.4, 0.4));
    draft.polygon({corners.begin(), corners.end()}, "mirror");
    throws_about(draft, middle, std::sqrt(8.0));
  }
}

void blocks_of_glass(WildDraft& draft, bool rough) {
  RandomStream& random = draft.random;
  const double n = random.between(1.3, 1.7);
  const char* k = random.one_of({"0", "0", "1e-8"});
  if (rough)
    draft.material(
        "glass",
        format(R"("scattering": {{"rough_boundary": {{"n": {:.3f}, "k": {}, "roughness": {:.3f}}}}})", n, k,
               std::min(1.0, 0.21 / (n - 1.0) * random.magnitude(1.0, 1.6))));
  else
    draft.material("glass", format(R"("scattering": {{"smooth": {{"n": {:.3f}, "k": {}}}}})", n, k));
  const int count = random.one_of({1, 1, 2});
  for (int i = 0; i < count; ++i) {
    const double x = -4.0 + 5.0 * i + random.between(0.0, 1.0), y = random.between(-3.0, 3.0),
                 r = random.magnitude(0.3, 2.0), foot = random.one_of({0.01, 1.0});
    const Corner middle{x, y, foot + r};
    if (random.with(0.5)) {
      draft.box({x - r, y - r, foot}, {x + r, y + r, foot + 2.0 * r}, "glass");
    } else {
      draft.sphere(middle, r, "glass");
      draft.hints.focus = 100.0;
      if (!rough) draft.hints.mirrors.push_back({draft.place(x, y, foot + r), r * draft.gsd_m});  // its glint
    }
    if (!rough) throws_about(draft, middle, std::sqrt(3.0) * r);
  }
}

}  // namespace

void make_gloss(WildDraft& draft) {
  RandomStream& random = draft.random;
  with_disc(draft);
  draft.ground();
  const double width = glossy(draft, "gloss");
  const int count = random.one_of({1, 2, 4});
  for (int k = 0; k < count; ++k) {
    const double x = random.between(-5.0, 5.0), y = random.between(-5.0, 5.0), r = random.magnitude(0.1, 3.0);
    switch (random.index(4)) {
      case 0:
        draft.sphere({x, y, r + 0.01}, r, "gloss");
        // Seen from above: about half-way between the zenith and the Sun.
        {
          const math::Vec3 half = math::normalized(draft.towards_sun + math::Vec3{0.0, 0.0, 1.0});
          draft.hints.bright.push_back({draft.place(x + r * half.x, y + r * half.y, r + 0.01 + r * half.z),
                                        2.0 * width * r * draft.gsd_m});
        }
        break;
      case 1: cylinder(draft, {x, y, 0.0}, r, r * random.between(0.5, 4.0), "gloss"); break;
      case 2:
        draft.box({x, y, 0.0}, {x + r, y + r * random.between(0.5, 2.0), r * random.between(0.3, 2.0)},
                  "gloss");
        break;
      default:
        lump(draft, format("{}_{}.obj", draft.name, k), {x, y, 0.0}, r, r * random.between(0.3, 1.5),
             "gloss");
    }
  }
  if (random.with(0.5)) painted_things(draft, 2, 3.0);
}

void make_glass(WildDraft& draft) {
  RandomStream& random = draft.random;
  with_disc(draft);
  draft.ground();
  painted_things(draft, random.one_of({1, 3, 6}), 4.0);
  const double form = random.uniform();
  if (form < 0.6)
    panes(draft);
  else
    blocks_of_glass(draft, form > 0.8);
}

void make_water(WildDraft& draft) {
  RandomStream& random = draft.random;
  with_disc(draft);
  if (random.with(0.75)) {
    draft.material(
        "water",
        format(
            R"("reflectance": {:.4f}, "scattering": {{"sea": {{"wind": {:.2f}, "wind_from": "{:.0f} deg", "slopes": "{}"}}}})",
            random.magnitude(0.001, 0.1), random.between(1.7, 13.0), random.between(0.0, 360.0),
            random.one_of({"anisotropic", "isotropic", "skewed"})));
  } else {
    draft.material("water", R"("scattering": {"smooth": {"n": 1.33, "k": 0.01, "over": "absorber"}})");
    throws_about(draft, {0.0, 0.0, 0.0}, 45.0);
  }
  draft.objects.push_back(R"({"plane": {}, "material": "water"})");
  painted_things(draft, random.one_of({1, 3, 5}), 3.0);
  if (random.with(0.4))  // a shore
    draft.box({random.between(-4.0, 4.0), -22.0, -0.5}, {22.0, 22.0, random.magnitude(0.05, 1.0)}, "paint");
}

}  // namespace ifov::benchmarks
