#include <cmath>

#include "core/format.h"
#include "studies/sensor/moving_scenes.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr double kCarWithin_px = 0.02, kLeastHeld = 0.93, kMostHeld = 0.995;

}  // namespace

ReportSection moving_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "What moves";
  const int seeds = options.study.is_quick() ? 1 : 8, instants = options.study.is_quick() ? 12 : 96;
  section.text = format(
      "A hot plate on cold ground, 0.5 %, whose edges are compared with what kinematics says that it covers of pixels, rows and columns. And a box of two "
      "pixels that moves by three across a yard under Sun and sky, before a wall and before a mirror that leans on it, at 3 %, {} seeds: intervals that hold "
      "the mean of images, with grids of 23 to 29 rays across a pixel (61 to 67 for rows), in which it stands where it is at {} instants, or at that of each row. The six "
      "scenes of `benchmarks/honesty`, scanned and shaken ones: `tests/session/test_moving_objects.py --full`, `test_moving_before_mirrors.py --full`, "
      "`test_scanned_coverage.py --full`.",
      seeds, instants);
  const MovingCar frame{}, across{0.01, 0.0, 30.0, 0.0}, rolling{0.0, 0.003, 20.0, 5.0},
      both{0.002, 0.002, 30.0, 7.0};
  for (const auto& [name, car, what] :
       {std::tuple{"moving_car_frame", frame, "a frame of 10 ms"},
        std::tuple{"moving_car_across", across, "the same straight across"},
        std::tuple{"moving_car_rolling", rolling, "a rolling shutter of 3 ms a row"},
        std::tuple{"moving_car_both", both, "rows of 2 ms, exposed for 2 ms"}})
    section.figures.at_most(name, moving_car_off_px(car, options.study), kCarWithin_px, "px",
                            format("{}: edges against kinematics", what));
  for (const bool mirror : {false, true})
    for (const bool rolling_rows : {false, true}) {
      const MovingYard yard{rolling_rows, mirror, seeds, instants};
      const MovingHeld held = moving_held(yard, moving_truth(yard, options.study), options.study);
      const std::string name =
          format("moving_held_{}{}", rolling_rows ? "rolling" : "frame", mirror ? "_mirror" : "");
      const std::string what = format("{}{}: intervals that hold", rolling_rows ? "rolling shutter" : "frame",
                                      mirror ? ", before a mirror" : "");
      if (options.study.is_quick())
        section.figures.report(name, held.share(), "", what);
      else
        section.figures.between(name, held.share(), kLeastHeld, kMostHeld, "", what);
      section.figures.at_least(name + "_where", held.moving_share(), kLeastHeld, "",
                               format("of {} pixels that show that it moves", held.moving));
    }
  return section;
}

}  // namespace ifov::studies
