#include "sim/homework/sandbox_stage.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "sim/homework/sandbox_files.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr unsigned nobody = 65534;  // inside of walls
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
    if (++count > most_files || at.depth() > deepest_folders)
      throw InputError(
          from.string(),
          fmt::format("holds more than {} files, or folders more than {} deep", most_files, deepest_folders),
          "hand in the program alone");
    if (fs::is_directory(status)) {
      if (at->path().filename() == ".git") {
        at.disable_recursion_pending();
        continue;
      }
      fs::create_directory(there);
      fs::permissions(there, readable_folder);
    } else if (fs::is_regular_file(status)) {
      bytes += at->file_size();
      if (bytes > Limits::bytes(limits.files))
        throw InputError(from.string(), fmt::format("holds more than {} MiB", limits.files),
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

std::optional<unsigned> program_user() {
  if (geteuid() != 0) return std::nullopt;
  const auto process = static_cast<std::uint64_t>(getpid());
  // Above all that systems give to people and services; or, in a container with fewer, where Debian has none of them.
  const std::uint64_t usual = 2'000'000'000 + process, among_few = 60'000 + process % 5'000;
  std::ifstream users("/proc/self/uid_map");  // lines of: the first user here, the first outside, how many
  if (!users) return static_cast<unsigned>(among_few);
  std::optional<unsigned> found;
  for (std::uint64_t first = 0, outside = 0, count = 0; users >> first >> outside >> count;)
    for (const std::uint64_t one : {usual, among_few})
      if (!found && first <= one && one < first + count) found = static_cast<unsigned>(one);
  return found;
}

Stage::Stage(const fs::path& program, const std::string& name, const std::string& scene, const Limits& limits)
    : folder_("zstep-run"),
      program_(folder_.path() / "program"),
      scene_(folder_.path() / "scene"),
      scratch_(folder_.path() / "scratch"),
      name_(name + ".txt") {
  try {
    fs::permissions(folder_.path(), readable_folder);
    copy_program(program, program_, limits);
    fs::create_directory(scene_);
    fs::permissions(scene_, readable_folder);
    std::ofstream text(scene_ / name_, std::ios::binary);
    text << scene;
    text.close();
    if (!text) throw InputError((scene_ / name_).string(), "cannot be written", "make room on the disk");
    fs::permissions(scene_ / name_, fs::perms(0644));
    fs::create_directory(scratch_);
    fs::permissions(scratch_, fs::perms::owner_all);
    if (const auto user = program_user(); user && chown(scratch_.c_str(), *user, *user) != 0)
      throw InputError(scratch_.string(), "cannot be given to another user", "run zstep as a plain user");
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().string(), "cannot be copied: " + error.code().message(), "check its permissions");
  }
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
