#include "sim/homework/sandbox_stage.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr int most_files = 10000;
constexpr auto readable_folder = fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                 fs::perms::others_read | fs::perms::others_exec;

/// Copies folders and plain files. Links, devices and the like stay: what they lead to is not the student's.
void copy_program(const fs::path& from, const fs::path& to, const Limits& limits) {
  fs::create_directory(to);
  fs::permissions(to, readable_folder);
  std::uintmax_t bytes = 0;
  int count = 0;
  for (auto at = fs::recursive_directory_iterator(from); at != fs::recursive_directory_iterator(); ++at) {
    const fs::path there = to / at->path().lexically_relative(from);
    const fs::file_status status = at->symlink_status();
    if (fs::is_directory(status)) {
      if (at->path().filename() == ".git") {
        at.disable_recursion_pending();
        continue;
      }
      fs::create_directory(there);
      fs::permissions(there, readable_folder);
    } else if (fs::is_regular_file(status)) {
      bytes += at->file_size();
      if (bytes > Limits::bytes(limits.files) || ++count > most_files)
        throw InputError(from.string(), fmt::format("holds more than {} MiB or {} files", limits.files, most_files),
                         "hand in the program alone");
      fs::copy_file(at->path(), there);
      const bool runs = (status.permissions() & fs::perms::owner_exec) != fs::perms::none;
      fs::permissions(there, runs ? readable_folder : fs::perms(0644));
    }
  }
}

bool lies_in_system(const fs::path& path) {
  const std::string text = path.string();
  return text.starts_with("/usr/") || text.starts_with("/bin/") || text.starts_with("/lib");
}

}  // namespace

bool runs_as_nobody() {
  if (geteuid() != 0) return false;
  std::ifstream users("/proc/self/uid_map");  // lines of: the first user here, the first outside, how many
  if (!users) return true;
  for (std::uint64_t first = 0, outside = 0, count = 0; users >> first >> outside >> count;)
    if (first <= nobody && nobody < first + count) return true;
  return false;
}

Stage::Stage(const fs::path& program, const std::string& name, const std::string& scene, const Limits& limits)
    : name_(name + ".txt") {
  std::string pattern = (fs::temp_directory_path() / "zstep-run-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
    throw InputError(pattern, "no folder can be made there", "set TMPDIR to a folder that can be written to");
  folder_ = pattern, program_ = folder_ / "program", scene_ = folder_ / "scene", scratch_ = folder_ / "scratch";
  try {
    fs::permissions(folder_, readable_folder);
    copy_program(program, program_, limits);
    fs::create_directory(scene_);
    fs::permissions(scene_, readable_folder);
    std::ofstream(scene_ / name_, std::ios::binary) << scene;
    fs::permissions(scene_ / name_, fs::perms(0644));
    fs::create_directory(scratch_);
    fs::permissions(scratch_, fs::perms::owner_all);
    if (runs_as_nobody() && chown(scratch_.c_str(), nobody, nobody) != 0)
      throw InputError(scratch_.string(), "cannot be given to the user nobody", "run zstep as a plain user");
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw InputError(error.path1().string(), "cannot be copied: " + error.code().message(), "check its permissions");
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

Stage::~Stage() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> Stage::words(const std::string& command, bool walls, const Limits& limits) const {
  const std::string scene = walls ? "/scene/" + name_ : (scene_ / name_).string();
  const std::vector<std::string> shell{"/bin/sh", "-c", command + " \"$1\"", "sh", scene};
  if (!walls) return shell;
  const std::string room = std::to_string(Limits::bytes(limits.files));
  std::vector<std::string> all{"bwrap",
                               "--unshare-all",
                               "--unshare-user",
                               "--disable-userns",
                               "--die-with-parent",
                               "--uid",
                               std::to_string(nobody),
                               "--gid",
                               std::to_string(nobody),
                               "--cap-drop",
                               "ALL",
                               "--ro-bind",
                               "/usr",
                               "/usr"};
  const auto add = [&](std::initializer_list<std::string> more) { all.insert(all.end(), more); };
  for (const char* folder : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/etc/alternatives", "/etc/ld.so.cache"})
    add({"--ro-bind-try", folder, folder});
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/etc", ignored))  // where Debian keeps Java's settings
    if (entry.path().filename().string().starts_with("java"))
      add({"--ro-bind-try", entry.path().string(), entry.path().string()});
  // An installed zstep could print the right run, and its lessons have the solutions.
  if (const fs::path self = fs::read_symlink("/proc/self/exe", ignored); lies_in_system(self))
    add({"--ro-bind", "/dev/null", self.string()});
  for (const fs::path& lessons : lesson_folders())
    if (lies_in_system(lessons) && fs::is_directory(lessons, ignored)) add({"--tmpfs", lessons.string()});
  add({"--proc", "/proc", "--dev", "/dev", "--size", room, "--tmpfs", "/dev/shm", "--size", room, "--tmpfs", "/tmp"});
  add({"--ro-bind", program_.string(), "/program", "--ro-bind", scene_.string(), "/scene"});
  add({"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/program", "--"});
  // Only inside is it the number of its own processes that counts, and not that of all the user's.
  if (fs::exists("/usr/bin/prlimit", ignored))
    add({"/usr/bin/prlimit", "--nproc=" + std::to_string(limits.refused_from())});
  all.insert(all.end(), shell.begin(), shell.end());
  return all;
}

std::vector<std::string> Stage::environment(bool walls) const {
  const std::string room = walls ? "/tmp" : scratch_.string();
  return {"PATH=/usr/local/bin:/usr/bin:/bin", "HOME=" + room, "TMPDIR=" + room, "LANG=C.UTF-8",
          "PYTHONDONTWRITEBYTECODE=1"};
}

}  // namespace zstep::homework
