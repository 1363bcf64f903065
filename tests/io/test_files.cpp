#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include "core/error.h"
#include "core/parallel.h"
#include "io/files/input_file.h"
#include "io/files/inputs.h"
#include "io/files/mapped_file.h"
#include "io/files/own_files.h"

namespace ifov::io::test_files {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() {
    std::string name = (fs::temp_directory_path() / "ifov_files_XXXXXX").string();
    folder_ = fs::canonical(mkdtemp(name.data()));
  }
  ~Files() override { fs::remove_all(folder_); }
  fs::path put(const char* name, const char* content) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }
  static std::string why_not(const fs::path& path) {
    try {
      read_input(path);
    } catch (const SystemError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(Files, SaysWhyAFileCannotBeRead) {
  const auto expect = [&](const fs::path& path, const std::string& why) {
    EXPECT_EQ(why_not(path), format("cannot read '{}': {}", path.string(), why));
  };
  expect(folder_ / "none", "no such file");
  expect(folder_, "it is a folder");
  expect(put("file", "") / "below", "what its name takes for a folder is none");
  fs::create_symlink("loop", folder_ / "loop");
  expect(folder_ / "loop", "it is a link that leads nowhere: too many links one after the other");
  mkfifo((folder_ / "pipe").c_str(), 0600);
  expect(folder_ / "pipe", "it is not a plain file");
  expect("/dev/null", "it is not a plain file");
  expect(folder_ / std::string(300, 'x'), "its name is too long");
  if (geteuid() != 0) {
    fs::permissions(put("closed", ""), fs::perms::none);
    expect(folder_ / "closed", "permission denied");
  }
}

TEST_F(Files, ConfinedInputsLieBelowTheFolderAfterAllLinks) {
  put("in/a.txt", "a");
  put("in/deep/b.txt", "b");
  put("inside/c.txt", "c");  // the name of the folder is the beginning of this one's
  fs::create_symlink("deep/b.txt", folder_ / "in/link");
  fs::create_symlink(folder_ / "inside/c.txt", folder_ / "in/out");
  fs::create_symlink(folder_ / "in", folder_ / "shortcut");
  auto inputs = std::make_shared<Inputs>();
  inputs->below = folder_of_inputs(folder_ / "shortcut");
  const Call call{inputs};
  std::optional<CallScope> confined(call);
  EXPECT_EQ(read_input(folder_ / "in/a.txt"), "a");
  EXPECT_EQ(read_input(folder_ / "shortcut/link"), "b");
  EXPECT_EQ(read_input(folder_ / "in/../in/deep/b.txt"), "b");
  for (const char* name :
       {"inside/c.txt", "in/out", "in/../inside/c.txt", "inside/none", "in/deep/../../none"}) {
    const fs::path path = folder_ / name;
    EXPECT_EQ(why_not(path),
              format("cannot read '{}': it does not lie below '{}', and --inputs-below allows no other files",
                     path.string(), (folder_ / "in").string()));
  }
  EXPECT_THROW(MappedFile(folder_ / "in/out"), SystemError);
  // Threads that work for the call are bound as well, others are not.
  std::atomic<int> refused{0};
  parallel_for(4, 2, [&](std::int64_t) { refused += why_not(folder_ / "in/out").empty() ? 0 : 1; });
  EXPECT_EQ(refused, 4);
  std::thread([&] { EXPECT_EQ(read_input(folder_ / "in/out"), "c"); }).join();
  confined.reset();
  EXPECT_EQ(read_input(folder_ / "in/out"), "c");
}

TEST_F(Files, AReadThatIsCancelledEnds) {
  const fs::path file = put("a", "text");
  CancelToken cancel;
  const Call call{nullptr, &cancel};
  const CallScope scope(call);
  EXPECT_EQ(read_input(file), "text");
  cancel.cancel();
  EXPECT_THROW(read_input(file), Cancelled);
}

TEST_F(Files, ANewFileTakesThePlaceOfALink) {
  const fs::path precious = put("precious", "mine");
  fs::create_symlink(precious, folder_ / "new");
  fs::create_symlink(precious, folder_ / "new.part");
  write_new_file(folder_ / "new", "text");
  EXPECT_EQ(read_input(precious), "mine");
  EXPECT_FALSE(fs::is_symlink(folder_ / "new"));
  EXPECT_EQ(read_input(folder_ / "new"), "text");
  EXPECT_FALSE(fs::exists(folder_ / "new.part"));
}

TEST_F(Files, ANewFileThatIsNotPublishedGoes) {
  { NewFile file(folder_ / "a", folder_ / "a.part"); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Files, LinkedFoldersAreRefusedBelowWhatIsTrusted) {
  fs::create_directories(folder_ / "real/deep");
  fs::create_symlink("real", folder_ / "linked");
  refuse_links_below(folder_, folder_ / "real/deep");
  refuse_links_below(folder_, folder_ / "none/at/all");
  refuse_links_below(folder_ / "linked", folder_ / "linked/deep");
  EXPECT_THROW(refuse_links_below(folder_, folder_ / "linked"), SystemError);
  EXPECT_THROW(refuse_links_below(folder_, folder_ / "linked/deep"), SystemError);
}

TEST_F(Files, OwnFilesAreReadThroughNoLink) {
  put("file", "text");
  fs::create_symlink("file", folder_ / "link");
  EXPECT_EQ(read_own_file(folder_ / "file"), "text");
  EXPECT_THROW(read_own_file(folder_ / "link"), SystemError);
}

TEST_F(Files, AnAddressLeadsToItsMappedFile) {
  const fs::path path = put("a\x1b[1m", "some bytes");
  const char* inside = nullptr;
  {
    const MappedFile file(path);
    inside = reinterpret_cast<const char*>(file.bytes().data());
    ASSERT_NE(mapped_file_at(inside + 9), nullptr);
    EXPECT_EQ(std::string(mapped_file_at(inside + 9)), (folder_ / "a\\x1b[1m").string());
    EXPECT_EQ(mapped_file_at(inside + 10), nullptr);
  }
  EXPECT_EQ(mapped_file_at(inside), nullptr);
}

}  // namespace
}  // namespace ifov::io::test_files
