// Feeds damaged files to every reader, for a number of runs or a time. See docs/developer/testing.md.
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "core/error.h"
#include "fuzz/fuzzed_readers.h"
#include "fuzz/mutator.h"
#include "io/files/input_file.h"

namespace ifov::fuzz {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string reader;
  std::uint64_t runs = 1000, seed = 1;
  double seconds = 0.0;
  unsigned slowest_s = 20;
  long memory_mib = 512;
  std::string finds = IFOV_SOURCE_DIR "/tests/fuzz/finds";
  std::string good_files;
};

/// The input that is being read; a crash or a hang leaves it where this names it.
char current_file[4096] = "";

void on_alarm(int) {
  constexpr char kText[] = "\nfuzz_readers: a reader hangs on ";
  if (::write(2, kText, sizeof kText - 1) < 0 ||
      ::write(2, current_file, std::char_traits<char>::length(current_file)) < 0)
    std::_Exit(4);
  std::_Exit(3);
}

long peak_mib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// True where the reader took the file or refused it in the right way.
bool reads(const FuzzedReader& reader, const fs::path& file, const Options& options, bool& refused) {
  const long before = peak_mib();
  ::alarm(options.slowest_s);
  std::string failure;
  refused = false;
  try {
    reader.read(file);
  } catch (const InputError& error) {
    refused = true;
    if (std::string(error.what()).empty()) failure = "an error without a message";
  } catch (const SystemError&) {
    refused = true;
  } catch (const std::exception& error) {
    failure = std::string("an exception that is no InputError: ") + error.what();
  }
  ::alarm(0);
  if (peak_mib() - before > options.memory_mib)
    failure = "memory grew by " + std::to_string(peak_mib() - before) + " MiB";
  if (failure.empty()) return true;
  std::cerr << reader.name << ": " << failure << "\n  input: " << file << "\n";
  return false;
}

bool replay(const FuzzedReader& reader, const fs::path& folder, const Options& options, int& count) {
  const fs::path finds = fs::path(options.finds) / reader.name;
  if (!fs::is_directory(finds)) return true;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(finds)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& find : files) {
    const fs::path file = folder / reader.file_name;
    std::ofstream(file, std::ios::binary) << io::read_input(find);
    bool refused = false;
    if (!reads(reader, file, options, refused)) return false;
    ++count;
  }
  return true;
}

bool fuzz(const FuzzedReader& reader, const Options& options) {
  const fs::path folder =
      fs::temp_directory_path() / ("ifov_fuzz_" + std::to_string(::getpid()) + "_" + reader.name);
  fs::create_directories(folder);
  const fs::path file = folder / reader.file_name;
  file.string().copy(current_file, sizeof current_file - 1);
  int finds = 0;
  if (!replay(reader, folder, options, finds)) return false;
  for (const std::string& seed : reader.seeds) {
    std::ofstream(file, std::ios::binary) << seed;
    try {
      reader.read(file);
    } catch (const std::exception& error) {
      std::cerr << reader.name << ": a seed is refused: " << error.what() << "\n";
      return false;
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::uint64_t run = 0, refused_count = 0;
  while (options.seconds > 0.0 ? elapsed_s() < options.seconds : run < options.runs) {
    std::ofstream(file, std::ios::binary) << mutated(reader.seeds, reader.words, options.seed, run++);
    bool refused = false;
    if (!reads(reader, file, options, refused)) return false;
    refused_count += refused ? 1 : 0;
  }
  std::cout << reader.name << ": " << run << " damaged files in " << elapsed_s() << " s, " << refused_count
            << " refused, " << finds << " old finds, no crash" << std::endl;
  fs::remove_all(folder);
  // A mutator that spares every file, or a reader that refuses all of them, would test nothing.
  return run < 200 || (refused_count > 0 && refused_count < run);
}

/// Writes the good files into <folder>/<reader>_<number>, with what a reader looks for beside them.
void write_good_files(const FuzzedReader& reader, const fs::path& folder) {
  for (std::size_t i = 0; i < reader.seeds.size(); ++i) {
    const fs::path own = folder / (reader.name + "_" + std::to_string(i));
    fs::create_directories(own);
    std::ofstream(own / reader.file_name, std::ios::binary) << reader.seeds[i];
    reader.read(own / reader.file_name);
  }
}

}  // namespace
}  // namespace ifov::fuzz

int main(int argc, char** argv) {
  using namespace ifov::fuzz;
  Options options;
  CLI::App app("Feeds damaged files to the readers of ifov.");
  app.add_option("--reader", options.reader, "only this one");
  app.add_option("--runs", options.runs, "damaged files per reader");
  app.add_option("--seconds", options.seconds, "time per reader, instead of --runs");
  app.add_option("--seed", options.seed, "another seed, other files");
  app.add_option("--slowest", options.slowest_s, "seconds after which a reader counts as hanging");
  app.add_option("--memory", options.memory_mib, "MiB by which one file may raise the peak of memory");
  app.add_option("--finds", options.finds, "folder of inputs that once failed");
  app.add_option("--good-files", options.good_files,
                 "write the good files of all readers to this folder, and end");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGALRM, on_alarm);
  bool any = false, good = true;
  for (const FuzzedReader& reader : fuzzed_readers()) {
    if (!options.reader.empty() && reader.name != options.reader) continue;
    any = true;
    if (!options.good_files.empty()) {
      write_good_files(reader, options.good_files);
      continue;
    }
    good = fuzz(reader, options) && good;
  }
  if (!any) std::cerr << "there is no reader '" << options.reader << "'\n";
  return any && good ? 0 : 1;
}
