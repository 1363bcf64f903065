#include <gtest/gtest.h>

#include "cluster/fault.h"
#include "cluster/payload.h"
#include "core/error.h"

namespace ifov::cluster::test_payload {
namespace {

TEST(Payload, GivesBackWhatWasPutIn) {
  Payload out;
  out.put(7);
  out.put(std::string("scene.out"));
  out.put(std::vector<double>{1.5, -2.0});
  put(out, {Fault::Kind::environment, "the disk is full"});
  Payload in(out.bytes());
  EXPECT_EQ(in.take<int>(), 7);
  EXPECT_EQ(in.take<std::string>(), "scene.out");
  EXPECT_EQ(in.take<std::vector<double>>(), (std::vector<double>{1.5, -2.0}));
  const Fault fault = take_fault(in);
  EXPECT_EQ(fault.kind, Fault::Kind::environment);
  EXPECT_EQ(fault.text, "the disk is full");
  EXPECT_THROW(in.take<int>(), std::logic_error);
}

TEST(Fault, IsThrownAgainWithTheNameOfItsRank) {
  Fault fault;
  try {
    throw SystemError("the disk is full");
  } catch (...) {
    fault = current_fault();
  }
  try {
    raise(fault, "rank 3 on node7");
    FAIL();
  } catch (const SystemError& error) {
    EXPECT_STREQ(error.what(), "rank 3 on node7: the disk is full");
  }
}

}  // namespace
}  // namespace ifov::cluster::test_payload
