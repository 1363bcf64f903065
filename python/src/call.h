#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "ifov/run_control.h"

namespace ifov::python {

namespace nb = nanobind;

/// What one call of Python brings along: its functions, which are called from any thread of the library, and what they threw, or
/// Ctrl-C, which ends the call.
class Call final : public ProgressSink, public LogSink {
 public:
  /// `progress`: called with a Progress and the phase's words; `log`: with a text and whether it is a warning; either may be None.
  /// Made and destroyed with the GIL held.
  explicit Call(nb::object progress = nb::none(), nb::object log = nb::none());

  const CancelToken* cancel() const { return &cancel_; }
  void report(const Progress& progress) override;
  void phase(const std::string& what) override;
  void info(const std::string& message) override { said(message, false); }
  void warn(const std::string& message) override { said(message, true); }

  /// Calls with the GIL held, from any thread; what is thrown ends the call, and is thrown by run().
  template <class Function>
  void guarded(const Function& function) {
    if (cancel_.cancelled()) return;
    const nb::gil_scoped_acquire gil;
    try {
      function();
    } catch (nb::python_error& error) {
      stop(std::move(error));
    }
  }

  /// Runs work without the GIL, in a thread of its own, while the thread of Python that waits for it looks for Ctrl-C. Throws what
  /// the work threw, what a function of Python threw, or KeyboardInterrupt.
  template <class Work>
  auto run(const Work& work) {
    const AtWork counted;
    auto result = std::async(std::launch::async, work);
    {
      const nb::gil_scoped_release released;
      while (result.wait_for(kGlance) != std::future_status::ready) look_for_signals();
    }
    if (stopped_) {
      try {
        result.get();
      } catch (...) {  // it was stopped, or failed of something else meanwhile: the first reason counts
      }
      throw nb::python_error(std::move(*std::exchange(stopped_, nullptr)));
    }
    return result.get();
  }

 private:
  static constexpr std::chrono::milliseconds kGlance{15};

  /// Counts a call for forks that come meanwhile.
  struct AtWork {
    AtWork();
    ~AtWork();
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;
  };

  void look_for_signals();
  void stop(nb::python_error&& error);
  void said(const std::string& message, bool is_warning);

  nb::object progress_, log_;
  CancelToken cancel_;
  std::unique_ptr<nb::python_error> stopped_;  ///< guarded by the GIL
  std::mutex mutex_;
  std::string phase_;
  std::chrono::steady_clock::time_point last_report_{};
};

/// None, or a function.
inline bool is_function(const nb::object& object) { return object.is_valid() && !object.is_none(); }

}  // namespace ifov::python
