#include "call.h"

#include <unistd.h>

#include <atomic>
#include <stdexcept>

namespace ifov::python {
namespace {

/// Calls at work, and the process that began them. A fork takes one thread along: what others held when it came is held for ever.
std::atomic<int> at_work{0};
std::atomic<pid_t> where{0};

void require_own_threads() {
  if (at_work > 0 && where != getpid())
    throw std::runtime_error(
        "this process was forked from one in which ifov was at work, and has none of its threads; fork before or after that, "
        "or start processes with multiprocessing's 'spawn'");
}

}  // namespace

Call::Call(nb::object progress, nb::object log) : progress_(std::move(progress)), log_(std::move(log)) {
  require_own_threads();
}

Call::AtWork::AtWork() {
  require_own_threads();
  where = getpid();
  ++at_work;
}

Call::AtWork::~AtWork() { --at_work; }

void Call::report(const Progress& progress) {
  if (!is_function(progress_)) return;
  std::string phase;
  {
    // A run of a million tiles has better things to do than to wait for Python.
    constexpr std::chrono::milliseconds kPause{20};
    const std::scoped_lock lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (progress.pixels_done < progress.pixels_total && now - last_report_ < kPause) return;
    last_report_ = now;
    phase = phase_;
  }
  guarded([&] { progress_(progress, phase); });
}

void Call::phase(const std::string& what) {
  {
    const std::scoped_lock lock(mutex_);
    phase_ = what;
  }
  if (is_function(progress_)) guarded([&] { progress_(nb::none(), what); });
}

void Call::said(const std::string& message, bool is_warning) {
  if (is_function(log_)) guarded([&] { log_(message, is_warning); });
}

void Call::look_for_signals() {
  const nb::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) stop(nb::python_error());
}

void Call::stop(nb::python_error&& error) {
  if (!stopped_) stopped_ = std::make_unique<nb::python_error>(std::move(error));
  cancel_.cancel();
}

}  // namespace ifov::python
