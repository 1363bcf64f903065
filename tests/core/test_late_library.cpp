#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/late_library.h"
#include "core/parallel.h"

namespace ifov::test_late_library {
namespace {

constinit LateLibrary mathematics{"libm.so.6"};
constinit LateFunction<double (*)(double)> late_cbrt{mathematics, "cbrt"};
constinit LateLibrary standard{"libc.so.6"};
constinit LateFunction<int (*)(char*, std::size_t, const char*, ...)> late_snprintf{standard, "snprintf"};

std::string message_of(LateLibrary& library, const char* function) {
  try {
    library.function(function);
  } catch (const SystemError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(LateLibrary, AFunctionIsCalledAsIfItWereLinked) {
  EXPECT_DOUBLE_EQ(late_cbrt(27.0), 3.0);
  double (*handed_on)(double) = late_cbrt;
  EXPECT_DOUBLE_EQ(handed_on(-8.0), -2.0);
}

TEST(LateLibrary, AFunctionOfAnyNumberOfArguments) {
  char text[32];
  EXPECT_EQ(late_snprintf(text, sizeof(text), "%d and %.1f", 7, 0.5), 9);
  EXPECT_STREQ(text, "7 and 0.5");
}

TEST(LateLibrary, ThreadsShareIt) {
  LateLibrary own{"libm.so.6"};
  LateFunction<double (*)(double)> root{own, "cbrt"};
  std::vector<double> found(64);
  parallel_for(64, 4, [&](std::int64_t k) {
    found[static_cast<std::size_t>(k)] = root(static_cast<double>(k * k * k));
  });
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], static_cast<double>(k), 1e-12);
}

TEST(LateLibrary, WhatIsMissingIsNamed) {
  LateLibrary absent{"libof_no_machine.so.7"};
  const std::string nothing = message_of(absent, "f");
  EXPECT_NE(nothing.find("the library libof_no_machine.so.7 cannot be loaded: "), std::string::npos)
      << nothing;
  EXPECT_NE(nothing.find("; it was there when ifov was built"), std::string::npos) << nothing;
  EXPECT_EQ(message_of(mathematics, "of_no_library"),
            "the library libm.so.6 has no function of_no_library; ifov was built with another version of it");
}

}  // namespace
}  // namespace ifov::test_late_library
