// What channels and surfaces make of wavelengths, and what a PSF makes of edges.
#include <cmath>

#include "core/format.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

void make_mixture(WildDraft& draft) {
  RandomStream& random = draft.random;
  const int parts = static_cast<int>(2 + random.index(3)), cells = random.one_of({2, 4, 9});
  const double side = draft.in_step(random.magnitude(0.5, 4.0)) * cells;
  const math::Point3 corner = draft.place(-0.5 * side, -0.5 * side, 0.0);
  const std::string where =
      format(R"("low_left": ["{} m", "{} m"], "size": ["{} m", "{} m"], "tiling": "repeat")", corner.x,
             corner.y, side * draft.gsd_m, side * draft.gsd_m);
  if (random.with(0.5)) draft.light = R"("light": {})";
  const double coldest = random.between(270.0, 320.0), hottest = coldest + random.magnitude(5.0, 400.0);
  draft.channels = random.one_of({R"({"name": "3 to 5 um", "top_hat": {"from": "3 um", "to": "5 um"}})",
                                  R"({"name": "3 to 14 um", "top_hat": {"from": "3 um", "to": "14 um"}})",
                                  R"({"name": "8 to 12 um", "top_hat": {"from": "8 um", "to": "12 um"}})"});
  std::vector<float> shares;
  std::string names;
  for (int part = 0; part < parts; ++part) {
    for (int k = 0; k < cells * cells; ++k) shares.push_back(static_cast<float>(random.between(0.05, 1.0)));
    const std::string file = format("{}_{}.img", draft.name, part);
    std::vector<float> kelvins;
    for (int k = 0; k < 16; ++k) kelvins.push_back(static_cast<float>(random.between(coldest, hottest)));
    draft.raster(file, 4, 4, kelvins);
    const double edge_um = random.between(3.5, 10.0), short_of = random.between(0.5, 1.0),
                 beyond = random.between(0.5, 1.0);
    draft.material(
        format("part {}", part),
        format(
            R"("emissivity": {{"table": {{"wavelength": ["1 um", "{0:.2f} um", "{1:.2f} um", "30 um"], "values": [{2:.3f}, {2:.3f}, {3:.3f}, {3:.3f}]}}}}, "temperature": {{"map": {{"file": "{4}", {5}, "unit": "K"}}}})",
            edge_um, edge_um + random.between(0.1, 1.0), short_of, beyond, file, where));
    names += format(R"({}"part {}")", part == 0 ? "" : ", ", part);
  }
  for (int k = 0; k < cells * cells; ++k) {  // shares of a cell sum to 1
    const auto at = [&](int part) -> float& {
      return shares[static_cast<std::size_t>(part * cells * cells + k)];
    };
    float sum = 0.0f;
    for (int part = 0; part < parts; ++part) sum += at(part);
    for (int part = 0; part < parts; ++part) at(part) /= sum;
  }
  draft.raster(draft.name + ".img", cells, cells, shares);
  draft.objects.push_back(
      format(R"({{"plane": {{}}, "material": {{"mixture": {{"file": "{}.img", {}, "materials": [{}]}}}}}})",
             draft.name, where, names));
}

void make_wide(WildDraft& draft) {
  RandomStream& random = draft.random;
  draft.channels = random.one_of({R"({"name": "all", "top_hat": {"from": "2 um", "to": "1000 um"}})",
                                  R"({"name": "far", "top_hat": {"from": "4 um", "to": "200 um"}})",
                                  R"({"name": "broad", "top_hat": {"from": "3 um", "to": "50 um"}})",
                                  R"({"name": "line", "top_hat": {"from": "9.6 um", "to": "9.602 um"}})"});
  const double hot = random.magnitude(250.0, 2500.0);
  const auto surface = [&](const std::string& what, double temperature_k) {
    if (random.with(0.5)) return draft.warm(what, random.between(0.7, 1.0), temperature_k);
    draft.material(
        what,
        format(
            R"("emissivity": {{"table": {{"wavelength": ["1 um", "{0:.2f} um", "{1:.2f} um", "2000 um"], "values": [{2:.3f}, {2:.3f}, {3:.3f}, {3:.3f}]}}}}, "temperature": "{4:.2f} K")",
            random.between(4.0, 8.0), random.between(8.5, 20.0), random.between(0.5, 1.0),
            random.between(0.5, 1.0), temperature_k));
  };
  surface("ground", random.with(0.5) ? hot : random.between(260.0, 320.0));
  surface("block", hot);
  draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
  for (int k = 0; k < 3; ++k) {
    const double x = random.between(-6.0, 4.0), y = random.between(-6.0, 4.0);
    draft.box({x, y, 0.0},
              {x + random.between(0.5, 3.0), y + random.between(0.5, 3.0), random.between(0.5, 3.0)},
              "block");
  }
}

void make_colours(WildDraft& draft) {
  RandomStream& random = draft.random;
  const auto coloured = [&](const std::string& what) {
    const double edge = random.between(0.55, 0.8), low = random.between(0.02, 0.2),
                 high = random.between(0.4, 0.9);
    draft.material(
        what,
        format(
            R"("reflectance": {{"table": {{"wavelength": ["0.3 um", "{:.3f} um", "{:.3f} um", "2.5 um"], "values": [{:.3f}, {:.3f}, {:.3f}, {:.3f}]}}}})",
            edge, edge + random.between(0.005, 0.06), low, low, high, high));
  };
  coloured("ground");
  coloured("house");
  draft.objects.push_back(R"({"plane": {}, "material": "ground"})");
  draft.channels =
      random.one_of({R"({"name": "edge", "gaussian": {"center": "0.705 um", "fwhm": "0.02 um"}})",
                     R"({"name": "broad", "top_hat": {"from": "0.64 um", "to": "0.76 um"}})",
                     R"({"name": "line", "gaussian": {"center": "0.65 um", "fwhm": "0.005 um"}})"});
  const double street = random.between(1.0, 5.0);
  draft.box({-0.5 * street - 4.0, -20.0, 0.0}, {-0.5 * street, 20.0, random.between(2.0, 8.0)}, "house");
  draft.box({0.5 * street, -20.0, 0.0}, {0.5 * street + 4.0, 20.0, random.between(2.0, 8.0)}, "house");
}

void make_airy(WildDraft& draft) {
  RandomStream& random = draft.random;
  const double q_px = random.between(0.3, 1.2), pitch_m = 1e-5, focal_m = 0.02, wavelength_um = 0.65;
  const double height_m = draft.gsd_m * focal_m / pitch_m;
  draft.camera = format(
      R"("camera": {{"frame": {{"focal_length": "{} m", "pitch": "{} um", "pixels": [{}, {}], "position": ["{} m", "{} m", "{} m"], "look_at": ["{} m", "{} m", "0 m"]}}}})",
      focal_m, pitch_m * 1e6, draft.size_px, draft.size_px, draft.centre_m[0], draft.centre_m[1], height_m,
      draft.centre_m[0], draft.centre_m[1]);
  draft.psf = format(R"("psf": {{"airy": {{"aperture": "{} m", "wavelength": "{} um"}}}})",
                     wavelength_um * 1e-6 * focal_m / (q_px * pitch_m), wavelength_um);
  draft.ground();
  draft.surface("plate");
  const double turn = random.one_of({0.0, 5.0, random.between(0.0, 45.0)}) * 0.017453292519943295;
  const double c = std::cos(turn), s = std::sin(turn), reach = random.one_of({3.0, 60.0});
  const auto at = [&](double x, double y) {
    return std::array<double, 3>{c * x - s * y, s * x + c * y, 0.001};
  };
  draft.polygon({at(0.0, -reach), at(reach, -reach), at(reach, reach), at(0.0, reach)}, "plate");
}

}  // namespace ifov::benchmarks
