// Files as they are read and written: nothing is waited for, a fault of the system is one line, and nothing is written
// through what somebody puts in the way.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#if __has_include(<sys/stat.h>)
#include <sys/stat.h>
#include <unistd.h>
#endif

#include "tests/folder.hpp"
#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"

namespace fs = std::filesystem;
using namespace zstep;

namespace {

template <class Work>
std::string line_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string why_not_read(const fs::path& path, std::uintmax_t limit = 1000) {
  return line_of([&] { read_whole(path, limit); });
}

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("files: what is read is an ordinary file, and no pipe is waited for") {
  const test::Folder folder;
  CHECK(read_whole(folder.write("a", "some text"), 9) == "some text");
  CHECK(tells(why_not_read(folder.path() / "none"), "there is no such file"));
  CHECK(tells(why_not_read(folder.path()), "is a folder"));
  REQUIRE(mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
  CHECK(tells(why_not_read(folder.path() / "pipe"), "is a pipe"));
  fs::create_symlink(folder.path() / "pipe", folder.path() / "link");
  CHECK(tells(why_not_read(folder.path() / "link"), "is a pipe"));
  if (fs::exists("/dev/zero")) CHECK(tells(why_not_read("/dev/zero"), "is no ordinary file"));
}

TEST_CASE("files: one that is too large is refused by its size, and one that grows by what comes") {
  const test::Folder folder;
  CHECK(tells(why_not_read(folder.write("a", std::string(1001, 'x'))), "is larger than 1000 bytes"));
  fs::resize_file(folder.write("b", ""), std::uintmax_t{1} << 40);  // without a byte on the disk
  CHECK(tells(why_not_read(folder.path() / "b", std::uintmax_t{1} << 30), "is larger than 1024 MiB"));
  CHECK(read_whole(folder.write("c", std::string(300'000, 'y')), 300'000).size() == 300'000);
  if (fs::exists("/proc/self/maps")) {  // its size is told as 0
    CHECK(read_whole("/proc/self/maps", 10'000'000).size() > 100);
    CHECK(tells(why_not_read("/proc/self/maps", 10), "is larger than 10 bytes"));
  }
}

TEST_CASE("files: what the system cannot read is an InputError, through a stream as well") {
  if (!fs::exists("/proc/self/mem")) return;
  CHECK(tells(why_not_read("/proc/self/mem"), "cannot be read to its end"));
  InputStream stream{InputFile("/proc/self/mem")};
  std::string line;
  CHECK(tells(line_of([&] { std::getline(stream, line); }), "cannot be read to its end"));
}

TEST_CASE("files: a link that is put in the place of an output meanwhile is replaced, and what it leads to stays") {
  const test::Folder folder;
  const fs::path input = folder.write("in", "what was read");
  note_input(input);
  const fs::path out = folder.path() / "out";
  const OutputPlace place(out);
  std::fputs("new", place.make("part").get());
  fs::create_symlink("in", out);
  place.take("part");
  CHECK(read_whole(input, 100) == "what was read");
  CHECK(fs::is_regular_file(fs::symlink_status(out)));
  CHECK(read_whole(out, 100) == "new");
}

TEST_CASE("files: another name of an input, and a folder exchanged for the input's, are noticed at the end") {
  const test::Folder folder;
  fs::create_directories(folder.path() / "kept");
  fs::create_directories(folder.path() / "out");
  const fs::path input = folder.write("kept/a", "what was read");
  note_input(input);
  const OutputPlace hard(folder.path() / "out" / "a");
  std::fputs("new", hard.make("part").get());
  fs::create_hard_link(input, folder.path() / "out" / "a");
  CHECK(tells(line_of([&] { hard.take("part"); }), "would overwrite the input"));
  fs::remove(folder.path() / "out" / "a");
  // The folder stays the one that it was when the place was made, whatever has its name by then.
  const OutputPlace moved(folder.path() / "out" / "a");
  fs::rename(folder.path() / "out", folder.path() / "elsewhere");
  fs::create_directory_symlink("kept", folder.path() / "out");
  std::fputs("new", moved.make("part2").get());
  moved.take("part2");
  CHECK(read_whole(input, 100) == "what was read");
  CHECK(read_whole(folder.path() / "elsewhere" / "a", 100) == "new");
}

TEST_CASE("files: where a file has a name of its own until it is whole, no link under that name is written through") {
  const test::Folder folder;
  const fs::path input = folder.write("in", "what was read");
  const OutputPlace place(folder.path() / "out");
  fs::create_symlink("in", folder.path() / "out.begun");
  CHECK(tells(line_of([&] { place.make_own("out.begun"); }), "out.begun: is in the way"));
  fs::remove(folder.path() / "out.begun");
  note_input(input);
  fs::create_hard_link(input, folder.path() / "out.begun");
  CHECK(tells(line_of([&] { place.make_own("out.begun"); }), "is in the way"));
  CHECK(read_whole(input, 100) == "what was read");
}

TEST_CASE(
    "files: a link in the place of an output is followed as it stood at first, or replaced, and never to an input") {
  const test::Folder folder;
  const fs::path real = folder.write("real", "old"), other = folder.write("other", "old"),
                 link = folder.path() / "link";
  fs::create_symlink("real", link);
  const OutputPlace followed(link);
  const OutputPlace replaced(link, Inputs::kept, Links::replaced);
  fs::remove(link);
  fs::create_symlink("other", link);
  std::fputs("new", followed.make("part").get());
  followed.take("part");
  CHECK(read_whole(real, 100) == "new");
  CHECK(fs::is_symlink(link));
  std::fputs("newer", replaced.make("part").get());
  replaced.take("part");
  CHECK_FALSE(fs::is_symlink(link));
  CHECK(read_whole(link, 100) == "newer");
  CHECK(read_whole(other, 100) == "old");
  note_input(real);
  fs::create_symlink("real", folder.path() / "second");
  for (const Links links : {Links::followed, Links::replaced})
    CHECK(tells(line_of([&] { const OutputPlace place(folder.path() / "second", Inputs::kept, links); }),
                "would overwrite the input"));
}
