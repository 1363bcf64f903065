// Finds the brightest pixel of a document's image, in its first channel, and writes no file.
#include <ifov/ifov.h>

#include <cstdio>
#include <mutex>

class Brightest : public ifov::TileSink {
 public:
  void write(const ifov::Tile& tile) override {
    const std::lock_guard lock(mutex_);
    for (int row = 0; row < tile.height_px; ++row)
      for (int column = 0; column < tile.width_px; ++column) {
        const std::size_t value = (static_cast<std::size_t>(row) * tile.width_px + column) * tile.channels;
        if (!(tile.radiance[value] > radiance)) continue;
        radiance = tile.radiance[value];
        half_width = tile.half_width.empty() ? 0.0f : tile.half_width[value];
        x_px = tile.x_px + column, y_px = tile.y_px + row;
      }
  }

  float radiance = -1.0f, half_width = 0.0f;
  int x_px = 0, y_px = 0;

 private:
  std::mutex mutex_;
};

int main(int argc, char** argv) try {
  if (argc < 2) return std::fprintf(stderr, "usage: brightest FILE [KEY=VALUE]...\n"), 1;
  const ifov::Document document = ifov::Document::read(argv[1], {argv + 2, argv + argc});
  const ifov::Simulation simulation = ifov::Simulation::load(document);
  for (const std::string& warning : simulation.warnings())
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  Brightest brightest;
  const ifov::Outcome outcome = simulation.render_tiles(brightest);
  std::printf("%s: %g +- %g W m-2 sr-1 um-1 at column %d, row %d\n",
              simulation.image().channels[0].name.c_str(), brightest.radiance, brightest.half_width,
              brightest.x_px, brightest.y_px);
  return outcome.exit_code();
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return ifov::exit_code_of(error);
}
