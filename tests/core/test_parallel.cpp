#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "core/call_scope.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/run_apart.h"

namespace ifov::test_parallel {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits until so many are there, or a time is over; what there were.
int wait_for(const std::atomic<int>& count, int wanted) {
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (count < wanted && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return count;
}

TEST(Parallel, CallsEachIndexOnce) {
  std::vector<std::atomic<int>> calls(1000);
  parallel_for(1000, 3, [&](std::int64_t k) { ++calls[static_cast<std::size_t>(k)]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST(Parallel, MoreThreadsThanCoresWorkWhereTheyAreAskedFor) {
  std::atomic<int> inside{0};
  const int wanted = usual_threads() + 2;
  parallel_for(wanted, wanted, [&](std::int64_t) {
    ++inside;
    EXPECT_EQ(wait_for(inside, wanted), wanted);
  });
}

/// A loop of one thread is at work all the time that one of three threads meets; and stays on its thread.
TEST(Parallel, OneLoopDoesNotLimitAnother) {
  std::atomic<bool> over{false};
  std::atomic<int> began{0}, met{0};
  std::thread other([&] {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(2, 1, [&](std::int64_t) {
      EXPECT_EQ(std::this_thread::get_id(), own);
      ++began;
      while (!over) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  });
  wait_for(began, 1);
  parallel_for(3, 3, [&](std::int64_t) {
    ++met;
    EXPECT_EQ(wait_for(met, 3), 3);
  });
  over = true;
  other.join();
}

TEST(Parallel, TakesTheCallAlong) {
  CancelToken cancel;
  const Call call{std::make_shared<const Call::Data>(), &cancel};
  const CallScope scope(call);
  std::atomic<int> inside{0};
  parallel_for(2, 2, [&](std::int64_t) {
    ++inside;
    wait_for(inside, 2);
    EXPECT_EQ(&current_call(), &call);
  });
  std::thread([] { EXPECT_EQ(current_call().inputs, nullptr); }).join();
}

TEST(Parallel, ACancelledCallEndsItsLoops) {
  CancelToken cancel;
  std::atomic<int> calls{0};
  const auto loop = [&] {
    parallel_for(100000, 2, [&](std::int64_t k) {
      ++calls;
      if (k == 3) cancel.cancel();
    });
  };
  loop();
  EXPECT_EQ(calls, 100000);  // of no call
  calls = 0;
  {
    const Call call{nullptr, &cancel};
    const CallScope scope(call);
    EXPECT_THROW(loop(), Cancelled);
    EXPECT_THROW(stop_if_cancelled(), Cancelled);
    const Call undisturbed{};
    const CallScope within(undisturbed);
    stop_if_cancelled();
  }
  EXPECT_LT(calls, 100000);
  stop_if_cancelled();
}

TEST(Parallel, WhatRunsApartIsNotEndedWithItsLoop) {
  // Of 1000 turns within one of a loop whose other one throws meanwhile.
  const auto turns = [](bool apart) {
    std::atomic<int> within{0}, done{0};
    const auto work = [&] {
      ++within;
      // A library's own, as Embree's.
      tbb::parallel_for(0, 1000, [&](int) {
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        ++done;
      });
    };
    EXPECT_THROW(parallel_for(2, 2,
                              [&](std::int64_t k) {
                                if (k == 0) {
                                  wait_for(within, 1);
                                  throw Cancelled();
                                }
                                if (apart)
                                  run_apart(work);
                                else
                                  work();
                              }),
                 Cancelled);
    return done.load();
  };
  EXPECT_EQ(turns(true), 1000);
  EXPECT_LT(turns(false), 1000);  // the twin
  EXPECT_THROW(run_apart([] { throw Cancelled(); }), Cancelled);
  int calls = 0;
  run_apart([&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

/// What a forked process answers with its code; it has a minute.
int in_child(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(work());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int threads_at_work() {
  std::atomic<int> inside{0};
  parallel_for(3, 3, [&](std::int64_t) {
    ++inside;
    wait_for(inside, 3);
  });
  return inside;
}

TEST(Parallel, AForkedProcessMakesThreadsOfItsOwn) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the sanitizer ends processes that were forked from several threads";
#endif
  for (int round = 0; round < 20; ++round) {
    ASSERT_EQ(threads_at_work(), 3);
    ASSERT_EQ(in_child([] { return in_child([] { return threads_at_work(); }) + threads_at_work(); }), 6);
  }
}

TEST(Parallel, AProcessThatWasForkedFromWorkSaysSo) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the sanitizer ends processes that were forked from several threads";
#endif
  const auto refused = [] {
    try {
      parallel_for(3, 3, [](std::int64_t) {});
    } catch (const SystemError& error) {
      return std::string(error.what()).find("forked from one in which ifov was at work") != std::string::npos
                 ? 7
                 : 8;
    }
    return 9;
  };
  std::atomic<int> inside{0};
  std::atomic<bool> over{false};
  std::thread other([&] {
    parallel_for(2, 2, [&](std::int64_t) {
      ++inside;
      while (!over) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  });
  wait_for(inside, 2);
  EXPECT_EQ(in_child(refused), 7);
  EXPECT_EQ(in_child([&] { return in_child(refused); }), 7);
  over = true;
  other.join();
  EXPECT_EQ(in_child(refused), 9);
  EXPECT_EQ(threads_at_work(), 3);
}

}  // namespace
}  // namespace ifov::test_parallel
