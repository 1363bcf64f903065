#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "core/error.h"
#include "io/instances/instance_csv.h"
#include "io/instances/instance_file.h"
#include "io/instances/instance_writer.h"

namespace ifov::io::test_instances {
namespace {

using Position = InstanceLayout::Position;
using Rotation = InstanceLayout::Rotation;
using Scale = InstanceLayout::Scale;

constexpr double kDegree = std::numbers::pi / 180.0;

class Instances : public testing::Test {
 protected:
  Instances() : folder_(std::filesystem::temp_directory_path() / format("ifov_instances_{}", getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~Instances() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string written(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// A list of three, in bytes.
  std::string three(InstanceLayout layout = {}) const {
    InstanceWriter writer(path("three.ifovinst"), layout, {100.0, 200.0, 0.0});
    for (int k = 0; k < 3; ++k) writer.add({{k * 1.5, 7.0, -k * 0.25}, quaternion_of(k * 0.5, 0.0, 0.0)});
    writer.finish();
    return bytes_of(path("three.ifovinst"));
  }
  template <class Read>
  std::string message(const Read& read) const {
    try {
      read();
    } catch (const InputError& error) {
      std::string text = error.what();
      for (std::size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;)
        text.erase(at, folder_.string().size() + 1);
      return text;
    }
    return "accepted";
  }
  std::string message_of(const std::string& content) const {
    const std::string file = written("a.ifovinst", content);
    return message([&] { InstanceFile{file}; });
  }
  std::string csv_message(const std::string& content) const {
    const std::string file = written("a.csv", content);
    return message([&] { read_instance_csv(file); });
  }

  std::filesystem::path folder_;
};

void expect_near(const math::Transform& a, const math::Transform& b, double turn, double metres) {
  for (const math::Vec3 d :
       {a.column_x() - b.column_x(), a.column_y() - b.column_y(), a.column_z() - b.column_z()})
    EXPECT_LE(length(d), turn);
  EXPECT_LE(length(a.origin_m() - b.origin_m()), metres);
}

TEST(Instance, TurnsByRollThenPitchThenYaw) {
  const math::Transform expected =
      math::Transform::translation({1.0, 2.0, 3.0}) * math::Transform::rotation({0.0, 0.0, 1.0}, 0.7) *
      math::Transform::rotation({0.0, 1.0, 0.0}, -0.4) * math::Transform::rotation({1.0, 0.0, 0.0}, 2.2) *
      math::Transform::scaling({2.0, 3.0, 0.5});
  expect_near(transform_of({{1.0, 2.0, 3.0}, quaternion_of(0.7, -0.4, 2.2), {2.0, 3.0, 0.5}}), expected,
              1e-14, 1e-14);
}

TEST(Instance, AnglesOfATurn) {
  for (const double yaw : {-3.0, 0.0, 1.2})
    for (const double pitch : {-1.5, 0.0, 0.3})
      for (const double roll : {-2.9, 0.0, 3.0}) {
        const std::array<double, 3> found = yaw_pitch_roll_of(quaternion_of(yaw, pitch, roll));
        EXPECT_NEAR(found[0], yaw, 1e-12);
        EXPECT_NEAR(found[1], pitch, 1e-12);
        EXPECT_NEAR(found[2], roll, 1e-12);
      }
  const std::array<double, 3> upright = yaw_pitch_roll_of(quaternion_of(0.5, 0.5 * std::numbers::pi, 0.0));
  EXPECT_NEAR(upright[0], 0.5, 1e-7);
  EXPECT_NEAR(upright[1], 0.5 * std::numbers::pi, 1e-7);
}

TEST_F(Instances, ComeBackInEveryLayout) {
  for (const Position position : {Position::float64, Position::float32})
    for (const Rotation rotation :
         {Rotation::none, Rotation::yaw, Rotation::yaw_pitch_roll, Rotation::quaternion})
      for (const Scale scale : {Scale::none, Scale::uniform, Scale::by_axis}) {
        const InstanceLayout layout{position, rotation, scale};
        const bool turns = rotation != Rotation::none, tilts = turns && rotation != Rotation::yaw;
        std::vector<Instance> all;
        for (int k = 0; k < 100; ++k) {
          Instance one{{5e5 + k * 1.1, 5.4e6 - k * 0.3, 200.0 + k}};
          one.quaternion = quaternion_of(turns ? 0.06 * k - 3.0 : 0.0, tilts ? 0.03 * k - 1.5 : 0.0,
                                         tilts ? 3.0 - 0.06 * k : 0.0);
          if (scale == Scale::uniform) one.scale = {1.0 + 0.01 * k, 1.0 + 0.01 * k, 1.0 + 0.01 * k};
          if (scale == Scale::by_axis) one.scale = {1.0, 0.5, 1.0 + 0.01 * k};
          all.push_back(one);
        }
        InstanceWriter writer(path("all.ifovinst"), layout, {5e5, 5.4e6, 0.0});
        for (const Instance& one : all) writer.add(one);
        writer.finish();
        const InstanceFile file(path("all.ifovinst"));
        EXPECT_EQ(file.layout(), layout);
        ASSERT_EQ(file.count(), all.size());
        for (std::size_t k = 0; k < all.size(); ++k)
          expect_near(file.at(k), transform_of(all[k]), 1e-6, position == Position::float64 ? 1e-9 : 2e-5);
      }
}

TEST_F(Instances, OfTheOtherByteOrder) {
  std::string bytes = three();
  const auto swap = [&](std::size_t at, std::size_t size) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  };
  for (const std::size_t at : {8, 12, 24}) swap(at, 4);
  for (const std::size_t at : {16, 32, 40, 48}) swap(at, 8);
  for (std::size_t record = 64; record < bytes.size(); record += 32) {
    for (const std::size_t at : {0, 8, 16}) swap(record + at, 8);
    for (const std::size_t at : {24, 28}) swap(record + at, 4);
  }
  const InstanceFile swapped(written("swapped.ifovinst", bytes)), plain(path("three.ifovinst"));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(swapped.at(k), plain.at(k));
}

TEST_F(Instances, AFileIsCheckedAgainstItsHeader) {
  const std::string good = three();
  EXPECT_EQ(message_of(good), "accepted");
  EXPECT_EQ(message_of(good.substr(0, 40)),
            "a.ifovinst: an instance list begins with a header of 64 bytes; the file has 40");
  EXPECT_EQ(message_of(good.substr(0, good.size() - 1)),
            "a.ifovinst: the header says 3 instances of 32 bytes, a file of 160 bytes; it has 159");
  EXPECT_EQ(message_of(good + "x"),
            "a.ifovinst: the header says 3 instances of 32 bytes, a file of 160 bytes; it has 161");
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string changed = good;
    return changed.replace(at, bytes.size(), bytes);
  };
  EXPECT_EQ(message_of(with(0, "IFOVIN")), "accepted");
  EXPECT_EQ(message_of(with(0, "PNG")),
            "a.ifovinst: this is no binary instance list, which begins with 'IFOVINST'");
  EXPECT_EQ(message_of(with(8, "\x07")),
            "a.ifovinst: the byte-order mark is 0x01020307; expected 0x01020304 in one order or the other");
  EXPECT_EQ(message_of(with(12, "\x02")),
            "a.ifovinst: the list is of version 2; this program reads version 1");
  EXPECT_EQ(message_of(with(23, "\x20")),
            "a.ifovinst: the header says 2305843009213693955 instances; at most 4294967294 can be placed");
  EXPECT_EQ(message_of(with(24, "\x21")),
            "a.ifovinst: records of this layout have 32 bytes; the header says 33");
  EXPECT_EQ(
      message_of(with(29, "\x04")),
      "a.ifovinst: the layout (position 0, rotation 4, scale 1, reserved 0) is not known; positions are 0 or 1, "
      "rotations 0 to 3, scales 0 to 2, reserved 0");
}

TEST_F(Instances, RecordsMustMakeSense) {
  const std::string good = three();
  const auto with_float = [&](std::size_t at, float value) {
    std::string changed = good;
    std::memcpy(changed.data() + at, &value, sizeof value);
    return message_of(changed);
  };
  EXPECT_EQ(with_float(64 + 32 + 28, 0.0f), "a.ifovinst: instance 1: its scale (0, 0, 0) is not above zero");
  EXPECT_EQ(with_float(64 + 24, std::nanf("")), "a.ifovinst: instance 0: its rotation is not finite");
  const double infinite = INFINITY;
  std::string changed = good;
  std::memcpy(changed.data() + 64 + 2 * 32, &infinite, sizeof infinite);
  EXPECT_EQ(message_of(changed), "a.ifovinst: instance 2: its position (inf, 7, -0.5) is not finite");

  std::string turned = three({Position::float64, Rotation::quaternion, Scale::none});
  const float half = 0.5f;
  std::memcpy(turned.data() + 64 + 24, &half, sizeof half);
  EXPECT_EQ(message_of(turned), "a.ifovinst: instance 0: its quaternion is not of length 1");
}

TEST_F(Instances, NoDamagedByteIsFatal) {
  const std::string good = three();
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const int value : {0x00, 0x7f, 0x80, 0xff}) {
      std::string changed = good;
      changed[at] = static_cast<char>(value);
      const std::string file = written("damaged.ifovinst", changed);
      try {
        const InstanceFile list(file);
        for (std::size_t k = 0; k < list.count(); ++k) EXPECT_TRUE(std::isfinite(list.at(k).origin_m().x));
      } catch (const InputError&) {
      }
    }
}

TEST_F(Instances, AWriterRefusesWhatItsLayoutCannotHold) {
  const auto refused = [&](InstanceLayout layout, const Instance& one) {
    return message([&] { InstanceWriter(path("b.ifovinst"), layout).add(one); });
  };
  const Instance turned{{}, quaternion_of(0.3, 0.0, 0.0)}, tilted{{}, quaternion_of(0.0, 0.3, 0.0)};
  EXPECT_EQ(refused({Position::float64, Rotation::none, Scale::none}, turned),
            "b.ifovinst: instance 0 is turned, and its layout has no rotation");
  EXPECT_EQ(refused({Position::float64, Rotation::yaw, Scale::none}, tilted),
            "b.ifovinst: instance 0 is tilted, and its layout has a rotation about z only");
  EXPECT_EQ(refused({}, {{}, {1.0, 0.0, 0.0, 0.0}, {1.0, 2.0, 1.0}}),
            "b.ifovinst: instance 0 has three scales, and its layout has one");
  EXPECT_EQ(
      refused({Position::float64, Rotation::none, Scale::none}, {{}, {1.0, 0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}}),
      "b.ifovinst: instance 0 is scaled, and its layout has no scale");
  EXPECT_EQ(refused({}, {{}, {1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
            "b.ifovinst: instance 0 has a scale that is not above zero");
  EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "an unfinished list is left behind";
}

TEST_F(Instances, FromText) {
  const std::string file =
      written("all.csv",
              "x,y,z,yaw,scale,pitch,roll\r\n# comment\r\n\r\n1,2,3,90,2,10,-20\r\n4, 5, 6, 0, 1, 0, 0\r\n");
  const std::vector<Instance> all = read_instance_csv(file);
  ASSERT_EQ(all.size(), 2u);
  expect_near(
      transform_of(all[0]),
      transform_of({{1.0, 2.0, 3.0}, quaternion_of(90 * kDegree, 10 * kDegree, -20 * kDegree), {2, 2, 2}}),
      0.0, 0.0);
  EXPECT_EQ(transform_of(all[1]), math::Transform::translation({4.0, 5.0, 6.0}));
  EXPECT_EQ(read_instance_csv(written("b.csv", "1 2 3\n4 5 6")).size(), 2u);
  EXPECT_EQ(read_instance_csv(written("c.csv", "1;2;3;45\n")).size(), 1u);
  EXPECT_EQ(read_instance_csv(written("d.csv", "")).size(), 0u);
}

TEST_F(Instances, ErrorsInTextAreLocated) {
  EXPECT_EQ(
      csv_message("x,y,z\n1,2\n"),
      "a.csv:2: found 2 fields; expected 3, 4, 5 or 7 numbers: x, y, z, yaw, scale, pitch, roll\n  1,2");
  EXPECT_EQ(
      csv_message("id,x,y,z\n1,2,3,4\n"),
      "a.csv:1:4: found 'x' as column 2; expected the columns x, y, z, yaw, scale, pitch, roll in this order\n  id,x,y,z\n     ^");
  EXPECT_EQ(csv_message("1,2,3\n1,2,3,4\n"),
            "a.csv:2: found 4 fields; expected 3 numbers, as above\n  1,2,3,4");
  EXPECT_EQ(csv_message("1,2,3\n\n1,oak,3\n"), "a.csv:3:3: found 'oak'; expected a number\n  1,oak,3\n    ^");
  EXPECT_EQ(csv_message("1,2,3,0,-1\n"),
            "a.csv:1:9: the scale is -1; expected a number above 0\n  1,2,3,0,-1\n          ^");
}

}  // namespace
}  // namespace ifov::io::test_instances
