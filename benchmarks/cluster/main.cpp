// What a run on many machines is made of. Each command prints one JSON object.
//   bench_cluster costs DOCUMENT TILE...     what each tile takes, one thread, for these sizes of tiles
//   mpirun -n 2 bench_cluster messages       what asking for tiles takes while the first rank computes
//   bench_cluster simulate FILE              efficiency of many ranks; FILE: see simulate()
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <numeric>
#include <thread>

#include "cluster/tile_server.h"
#include "core/format.h"
#include "io/document/document.h"
#include "io/files/input_file.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/json/json_writer.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "simulation.h"

namespace {

using namespace ifov;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// `content` writes one value.
void print(auto&& content) {
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  content(json);
  std::printf("%s\n", json.written().c_str());
}

/// Of this thread: others that take the core do not count.
double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class CostSink final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult&) override {
    const double now_s = processor_s();
    seconds.push_back(now_s - last_s_);
    last_s_ = now_s;
  }
  std::vector<double> seconds;

 private:
  double last_s_ = processor_s();
};

void measure_costs(const std::string& file, const std::vector<int>& sizes) {
  const session::Session session = session::Session::load(io::read_document(file), nullptr);
  const auto write_costs = [&](io::JsonWriter& json, int size) {
    render::RenderJob job = session.parts().job();
    job.tile_px = size;
    const int columns = (job.camera.width_px() + size - 1) / size,
              rows = (job.camera.height_px() + size - 1) / size;
    std::vector<int> order(static_cast<std::size_t>(columns * rows));
    std::iota(order.begin(), order.end(), 0);
    CostSink sink;
    // One thread alone takes a parallel loop's pieces in order.
    render::RenderControl control;
    control.threads = 1;
    control.tile_order = order;
    render::render_image(job, control, sink);
    json.member("tile_px", size);
    json.member("columns", columns);
    json.member("seconds", sink.seconds);
  };
  print([&](io::JsonWriter& json) {
    json.list([&] {
      for (const int size : sizes) json.object([&] { write_costs(json, size); });
    });
  });
}

constexpr int kRoundTrips = 1000, kBurst = 5000;

cluster::Payload ask() {
  cluster::Payload payload;
  payload.put(1);
  payload.put(1);
  payload.put(Progress{});
  payload.put(std::vector<cluster::TileCost>{{0, 0.1}});
  return payload;
}

void wait_for_tiles(cluster::Communicator& communicator) {
  while (!communicator.poll()) {
  }
}

/// The second rank's view. It looks for answers without a pause: what is found is the first rank's part and the way.
void ask_for_tiles(cluster::Communicator& communicator) {
  std::vector<double> trips;
  for (int k = 0; k < kRoundTrips; ++k) {
    // Asks come at any moment between two looks of the first rank.
    std::this_thread::sleep_for(std::chrono::microseconds(2000 + 37 * (k % 41)));
    const Clock::time_point begin = Clock::now();
    communicator.send(0, cluster::Tag::ask, ask());
    wait_for_tiles(communicator);
    trips.push_back(since(begin));
  }
  const Clock::time_point begin = Clock::now();
  std::thread asking([&] {
    for (int k = 0; k < kBurst; ++k) communicator.send(0, cluster::Tag::ask, ask());
  });
  for (int k = 0; k < kBurst; ++k) wait_for_tiles(communicator);
  asking.join();
  const double service_s = since(begin) / kBurst;
  std::sort(trips.begin(), trips.end());
  print([&](io::JsonWriter& json) {
    json.object([&] {
      json.member("round_trip_s", std::accumulate(trips.begin(), trips.end(), 0.0) / kRoundTrips);
      json.member("round_trip_99_s", trips[kRoundTrips * 99 / 100]);
      json.member("service_s", service_s);
    });
  });
  cluster::Payload farewell;
  put(farewell, {cluster::Fault::Kind::none, {}});
  farewell.put(0);
  farewell.put(std::vector<std::string>());
  farewell.put(Progress{});
  communicator.send(0, cluster::Tag::farewell, farewell);
  communicator.wait_for_end();
}

int measure_messages() {
  const std::unique_ptr<cluster::Communicator> communicator = cluster::Communicator::join();
  if (!communicator) return std::fprintf(stderr, "start it with mpirun -n 2\n"), 1;
  if (!communicator->leads()) return ask_for_tiles(*communicator), 0;
  std::vector<int> tiles(2 * (kRoundTrips + kBurst));
  std::iota(tiles.begin(), tiles.end(), 0);
  std::atomic<bool> done{false};
  std::thread tracing([&] {  // a core is taken, as by a rank that traces
    double sum = 0.0;
    while (!done) sum += std::sqrt(sum + 1.0);
  });
  cluster::TileServer server(*communicator, cluster::TileSchedule(tiles, 100, 1), nullptr);
  server.finish([] {});
  done = true;
  tracing.join();
  return 0;
}

/// {"round_trip_s": .., "service_s": .., "copies": k, "ranks": [..], "images": as of measure_costs()}; each image stands k
/// times beside and above itself.
int simulate(const std::string& file) {
  const io::DocumentTree tree = io::parse_json(io::read_input(file), file);
  const io::JsonView input(tree);
  const bench::MessageTimes messages{input["round_trip_s"].number(), input["service_s"].number()};
  const int copies = input["copies"].small_integer();
  std::vector<bench::TileCosts> images;
  double least_s = 1e300;
  for (const io::JsonView& image : input["images"].items()) {
    const std::vector<io::JsonView> seconds = image["seconds"].items();
    const int columns = image["columns"].small_integer();
    const int rows = static_cast<int>(seconds.size()) / columns;
    bench::TileCosts tiles{columns * copies, {}};
    for (int y = 0; y < rows * copies; ++y)
      for (int x = 0; x < columns * copies; ++x)
        tiles.seconds.push_back(seconds[static_cast<unsigned>(y % rows * columns + x % columns)].number());
    least_s = std::min(least_s, std::accumulate(tiles.seconds.begin(), tiles.seconds.end(), 0.0));
    images.push_back(std::move(tiles));
  }
  const std::pair<const char*, bench::Scheduling> kinds[] = {{"shares", bench::Scheduling::shares},
                                                             {"rows", bench::Scheduling::rows},
                                                             {"schedule", bench::Scheduling::schedule}};
  const std::vector<io::JsonView> described = input["images"].items();
  const auto write_row = [&](io::JsonWriter& json, std::size_t k, const auto& kind, int ranks) {
    const double makespan_s = bench::makespan_s(images[k], ranks, messages, kind.second);
    json.member("tile_px", described[k]["tile_px"].integer());
    json.member("scheduling", kind.first);
    json.member("ranks", ranks);
    json.member("makespan_s", makespan_s);
    // What small tiles cost more, for what lies beyond their rims, counts too.
    json.member("efficiency", least_s / (ranks * makespan_s));
  };
  print([&](io::JsonWriter& json) {
    json.list([&] {
      for (std::size_t k = 0; k < images.size(); ++k)
        for (const auto& kind : kinds)
          for (const io::JsonView& ranks : input["ranks"].items())
            json.object([&] { write_row(json, k, kind, ranks.small_integer()); });
    });
  });
  return 0;
}

int run(const std::vector<std::string>& words) {
  if (words.size() > 2 && words[0] == "costs") {
    std::vector<int> sizes;
    for (std::size_t k = 2; k < words.size(); ++k) sizes.push_back(std::stoi(words[k]));
    return measure_costs(words[1], sizes), 0;
  }
  if (words.size() == 1 && words[0] == "messages") return measure_messages();
  if (words.size() == 2 && words[0] == "simulate") return simulate(words[1]);
  return std::fprintf(stderr, "bench_cluster costs DOCUMENT TILE... | messages | simulate FILE\n"), 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
