#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "io/scene_cache/scene_cache.h"

namespace ifov::io::test_scene_cache {
namespace {

namespace fs = std::filesystem;

class Words final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += message + "\n"; }
  std::string text;
};

class SceneCacheFile : public testing::Test {
 protected:
  SceneCacheFile() : folder_(fs::temp_directory_path() / format("ifov_cache_{}", getpid())) {
    fs::create_directories(folder_);
    write("a.obj", "the first file");
    write("b.obj", "the second file");
  }
  ~SceneCacheFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
  }
  std::string bytes() const {
    std::ifstream file(path("scene.ifovcache"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// One run of a program that wants two records; what it made itself, and what it said.
  struct Run {
    std::string made, words;
  };
  Run run(const std::string& version = "1.0") const {
    Words words;
    Run result;
    {
      SceneCache cache(path("scene.ifovcache"), version, &words);
      for (const std::string name : {"a.obj", "b.obj"}) {
        if (const auto found = cache.find(name)) {
          EXPECT_EQ(text_of(*found), "made of " + name + content(name));
          EXPECT_EQ(reinterpret_cast<std::uintptr_t>(found->data()) % 64, 0u);
          continue;
        }
        const std::string file = path(name);
        auto stamps = cache.stamps(std::span(&file, 1));
        const std::string one = "made of " + name, two = content(name);
        const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(one)),
                                                             std::as_bytes(std::span(two))};
        cache.put(name, stamps, pieces);
        result.made += name + " ";
      }
      cache.save();
    }
    result.words = words.text;
    for (std::size_t at; (at = result.words.find(folder_.string() + "/")) != std::string::npos;)
      result.words.erase(at, folder_.string().size() + 1);
    return result;
  }
  std::string content(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  void expect_only_the_cache() const {
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }

  fs::path folder_;
};

TEST_F(SceneCacheFile, IsWrittenOnceAndThenUsed) {
  EXPECT_EQ(run().made, "a.obj b.obj ");
  const std::string first = bytes();
  const auto time = fs::last_write_time(path("scene.ifovcache"));
  const Run second = run();
  EXPECT_EQ(second.made, "");
  EXPECT_EQ(second.words, "");
  EXPECT_EQ(bytes(), first);
  EXPECT_EQ(fs::last_write_time(path("scene.ifovcache")), time);
  expect_only_the_cache();
}

TEST_F(SceneCacheFile, AChangedFileIsReadAgainAndOnlyThat) {
  run();
  write("b.obj", "the second life");  // as long as before
  const Run changed = run();
  EXPECT_EQ(changed.made, "b.obj ");
  EXPECT_EQ(changed.words, "'b.obj' has changed since 'scene.ifovcache' was written: it is read again\n");
  EXPECT_EQ(run().made, "");
  write("a.obj", "longer than the first file was");
  EXPECT_EQ(run().made, "a.obj ");
  EXPECT_EQ(run().made, "");
}

TEST_F(SceneCacheFile, AFileThatWasOnlyTouchedIsNot) {
  run();
  fs::last_write_time(path("a.obj"), fs::last_write_time(path("a.obj")) + std::chrono::hours(1));
  const Run touched = run();
  EXPECT_EQ(touched.made, "");
  EXPECT_EQ(touched.words, "");
  EXPECT_EQ(run().made, "");
}

TEST_F(SceneCacheFile, MovesWithItsFolder) {
  run();
  const fs::path elsewhere = folder_.string() + "_moved";
  fs::rename(folder_, elsewhere);
  folder_ = elsewhere;
  EXPECT_EQ(run().made, "");
}

TEST_F(SceneCacheFile, ABareNameLiesInTheCurrentFolder) {
  run();
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  {
    SceneCache cache("scene.ifovcache", "1.0", nullptr);
    EXPECT_TRUE(cache.find("a.obj").has_value());
    EXPECT_EQ(cache.name_of("a.obj"), "a.obj");
    EXPECT_EQ(cache.name_of(path("b.obj")), "b.obj");
    const std::string file = "b.obj";
    EXPECT_EQ(cache.stamps(std::span(&file, 1)).at(0).path, "b.obj");
  }
  fs::current_path(before);
}

TEST_F(SceneCacheFile, AnyBitThatFlipsIsNoticed) {
  run();
  const std::string good = bytes();
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
    write("scene.ifovcache", damaged);
    const Run again = run();
    ASSERT_EQ(again.made, "a.obj b.obj ") << at;
    ASSERT_EQ(
        again.words,
        "the scene cache 'scene.ifovcache' is not used: it is damaged; the scene is read from its files\n");
    ASSERT_EQ(bytes(), good);
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{64}, good.size() - 1}) {
    write("scene.ifovcache", good.substr(0, size));
    ASSERT_EQ(run().made, "a.obj b.obj ") << size;
  }
  write("scene.ifovcache", good + "x");
  EXPECT_EQ(run().made, "a.obj b.obj ");
}

TEST_F(SceneCacheFile, OfAnotherVersionIsMadeAgain) {
  run("1.0");
  const Run other = run("1.1");
  EXPECT_EQ(other.made, "a.obj b.obj ");
  EXPECT_EQ(
      other.words,
      "the scene cache 'scene.ifovcache' is not used: it was written by version 1.0; the scene is read from its "
      "files\n");
  EXPECT_EQ(run("1.1").made, "");
}

TEST_F(SceneCacheFile, GoesWithoutWhereNothingCanBeWritten) {
  write("plain", "a file where a folder should be");
  Words words;
  SceneCache cache(path("plain/scene.ifovcache"), "1.0", &words);
  EXPECT_FALSE(cache.find("a").has_value());
  const std::string one = "one";
  const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(one))};
  cache.put("a", {}, pieces);
  cache.put("b", {}, pieces);
  cache.save();
  EXPECT_EQ(words.text.find("there will be no scene cache: "), 0u) << words.text;
  EXPECT_EQ(std::count(words.text.begin(), words.text.end(), '\n'), 1) << "said once";
}

TEST_F(SceneCacheFile, RunsAtTheSameTimeDoNotClash) {
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&] {
      for (int turn = 0; turn < 20; ++turn) {
        if (turn % 5 == 0) {
          std::error_code ignored;
          fs::remove(path("scene.ifovcache"), ignored);
        }
        EXPECT_EQ(run().words, "");
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(run().words, "");
  EXPECT_EQ(run().made, "");
  expect_only_the_cache();
}

TEST_F(SceneCacheFile, WhatMakesNoSenseIsMadeAgain) {
  run();
  Words words;
  {
    SceneCache cache(path("scene.ifovcache"), "1.0", &words);
    EXPECT_TRUE(cache.find("a.obj").has_value());
    EXPECT_TRUE(cache.find("b.obj").has_value());
    cache.reject("a.obj");
    cache.save();
  }
  EXPECT_NE(words.text.find("'a.obj' in the scene cache"), std::string::npos);
  EXPECT_EQ(run().made, "a.obj ");
}

TEST_F(SceneCacheFile, RecordsNoLongerAskedForAreDropped) {
  run();
  const std::size_t before = bytes().size();
  {
    SceneCache cache(path("scene.ifovcache"), "1.0", nullptr);
    EXPECT_TRUE(cache.find("b.obj").has_value());
    cache.save();
  }
  EXPECT_LT(bytes().size(), before);
  EXPECT_EQ(run().made, "a.obj ");
}

}  // namespace
}  // namespace ifov::io::test_scene_cache
