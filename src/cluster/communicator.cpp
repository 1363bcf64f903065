#include "cluster/communicator.h"

#include <chrono>
#include <thread>

#include "cluster/backoff.h"
#include "cluster/launch.h"
#include "core/error.h"

#ifdef IFOV_HAS_MPI

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <numeric>

namespace ifov::cluster {
namespace {

/// Where there is nothing to do but wait.
void take(Backoff& backoff) { std::this_thread::sleep_for(backoff.next(std::chrono::milliseconds(1))); }

std::string processor_name() {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  return {name.data(), static_cast<std::size_t>(length)};
}

std::vector<std::string> names_of_all(int ranks) {
  constexpr int kLength = MPI_MAX_PROCESSOR_NAME;
  std::array<char, kLength> mine{};
  std::strncpy(mine.data(), processor_name().c_str(), kLength - 1);
  std::vector<char> all(static_cast<std::size_t>(ranks) * kLength);
  MPI_Allgather(mine.data(), kLength, MPI_CHAR, all.data(), kLength, MPI_CHAR, MPI_COMM_WORLD);
  std::vector<std::string> names;
  for (int rank = 0; rank < ranks; ++rank)
    names.push_back(format("rank {} on {}", rank, &all[static_cast<std::size_t>(rank) * kLength]));
  return names;
}

/// Cores of this rank, divided among the ranks of the node that were bound to the same.
int share_of_cores(MPI_Comm node) {
  int ranks = 0;
  MPI_Comm_size(node, &ranks);
  cpu_set_t mine;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof mine, &mine);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(ranks));
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, node);
  const auto sharing = std::count_if(all.begin(), all.end(),
                                     [&](const cpu_set_t& other) { return CPU_EQUAL(&mine, &other) != 0; });
  return std::max(1, CPU_COUNT(&mine) / static_cast<int>(std::max<std::ptrdiff_t>(sharing, 1)));
}

}  // namespace

struct Communicator::Mpi {
  std::mutex mutex;  ///< MPI is asked for calls from one thread at a time
};

Communicator::Communicator() : mpi_(std::make_unique<Mpi>()) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED)
    throw SystemError(
        format("{} does not serve programs with several threads (MPI_THREAD_SERIALIZED)", mpi_library()));
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  names_ = names_of_all(ranks);
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &node);
  usual_threads_ = share_of_cores(node);
  int on_node = 0;
  MPI_Comm_rank(node, &on_node);
  MPI_Comm_free(&node);
  std::vector<int> on_nodes(static_cast<std::size_t>(ranks));
  MPI_Allgather(&on_node, 1, MPI_INT, on_nodes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (const int rank_on_node : on_nodes) first_on_node_.push_back(rank_on_node == 0);
}

Communicator::~Communicator() {
  if (leads() && size() > 1) {
    std::vector<int> others(names_.size() - 1);
    std::iota(others.begin(), others.end(), 1);
    send_all(others, Tag::end, {});
  }
  MPI_Finalize();
}

std::unique_ptr<Communicator> Communicator::join() {
  if (!is_one_of_several()) return nullptr;
  return std::unique_ptr<Communicator>(new Communicator());
}

void Communicator::send(int to, Tag tag, const Payload& payload) { send_all({to}, tag, payload); }

void Communicator::send_all(const std::vector<int>& to, Tag tag, const Payload& payload) {
  const std::string& bytes = payload.bytes();
  std::vector<MPI_Request> requests(to.size());
  {
    const std::lock_guard lock(mpi_->mutex);
    for (std::size_t k = 0; k < to.size(); ++k)
      MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to[k], static_cast<int>(tag),
                MPI_COMM_WORLD, &requests[k]);
  }
  const auto are_done = [&] {
    const std::lock_guard lock(mpi_->mutex);
    int done = 0;
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
    return done != 0;
  };
  for (Backoff backoff; !are_done(); take(backoff)) {
  }
}

std::optional<Message> Communicator::poll() {
  const std::lock_guard lock(mpi_->mutex);
  int found = 0;
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status);
  if (found == 0) return std::nullopt;
  int bytes = 0;
  MPI_Get_count(&status, MPI_BYTE, &bytes);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  MPI_Mrecv(text.data(), bytes, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  if (status.MPI_TAG == static_cast<int>(Tag::end)) ended_ = true;
  return Message{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG), Payload(std::move(text))};
}

Message Communicator::receive(const CancelToken* cancel) {
  for (Backoff backoff;; take(backoff)) {
    if (std::optional<Message> message = poll()) return std::move(*message);
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
  }
}

void Communicator::wait_for_end() {
  for (Backoff backoff; !ended_; take(backoff)) poll();
}

std::string mpi_library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  std::string name(text.data(), static_cast<std::size_t>(length));
  return name.substr(0, name.find_first_of(",\n"));
}

}  // namespace ifov::cluster

#else

namespace ifov::cluster {

struct Communicator::Mpi {};

Communicator::~Communicator() = default;

std::unique_ptr<Communicator> Communicator::join() {
  if (is_one_of_several())
    throw SystemError(
        "this ifov was built without MPI, and was started as one of several ranks: each would make the whole image. "
        "Install an MPI library (Debian: libopenmpi-dev) and build again, or render shares (--tiles)");
  return nullptr;
}

void Communicator::send(int, Tag, const Payload&) {}
void Communicator::send_all(const std::vector<int>&, Tag, const Payload&) {}
std::optional<Message> Communicator::poll() { return std::nullopt; }
Message Communicator::receive(const CancelToken*) { throw Cancelled(); }
void Communicator::wait_for_end() {}
std::string mpi_library() { return {}; }

}  // namespace ifov::cluster

#endif
