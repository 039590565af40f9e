
#include "sim/homework/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <poll.h>
#include <set>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "sim/homework/folders.hpp"
#include "sim/homework/sandbox_process.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t most_errors = 8192;
constexpr int milliseconds_between_looks = 50, looks_for_files = 2;

struct SignalText {
  int number;
  const char* text;
};
constexpr std::array signal_texts{
    SignalText{SIGSEGV, "SIGSEGV, as after an access to memory that is not its own"},
    SignalText{SIGBUS, "SIGBUS, as after an access to memory that is not there"},
    SignalText{SIGABRT, "SIGABRT, as after a failed assertion or an exception that nobody caught"},
    SignalText{SIGFPE, "SIGFPE, as after an integer division by zero"},
    SignalText{SIGILL, "SIGILL, as after an instruction that the processor does not have"},
    SignalText{SIGKILL, "SIGKILL"},
    SignalText{SIGTERM, "SIGTERM"},
    SignalText{SIGXFSZ, "SIGXFSZ, as it wrote a file that is too large"},
};

class File {
 public:
  explicit File(const fs::path& path) : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0644)) {
    if (file_ < 0) throw InputError(path.string(), "cannot be made", "give the name of a new file");
  }
  ~File() { close(file_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  void write(const char* bytes, std::size_t count) {
    while (count > 0) {
      const ssize_t written = ::write(file_, bytes, count);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) throw InputError(path_.string(), "cannot be written", "make room on the disk");
      bytes += written, count -= static_cast<std::size_t>(written);
    }
  }

 private:
  fs::path path_;
  int file_;
};

Ended ended_as(int status, double seconds, const Limits& limits) {
  // The shell, and bubblewrap, say of a program that was ended by a signal that its exit code is 128 and the signal.
  Ended ended;
  int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code == 0) return ended;
  ended.how = code > 128 && code < 128 + 32 ? Ended::How::signal : Ended::How::exit_code;
  ended.code = ended.how == Ended::How::signal ? code - 128 : code;
  if (ended.how == Ended::How::signal && (ended.code == SIGXCPU || seconds > limits.seconds))
    ended.how = Ended::How::processor;
  return ended;
}

/// Gone with it: what a user has written where everybody may.
struct FilesOf {
  std::optional<unsigned> user;
  ~FilesOf() {
    if (user) remove_files_of(*user);
  }
};

Ended run_on(const Stage& stage, const std::string& command, bool walls, const fs::path& out, const Limits& limits,
             const std::function<void()>& tick) {
  File file(out);
  const std::optional<unsigned> user = walls ? std::nullopt : program_user();
  const FilesOf files{user};
  Process process(stage, command, walls, limits);
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::string errors;
  std::uint64_t printed = 0;
  std::array<char, 1 << 16> buffer;
  const auto read_what_is_there = [&] {
    for (std::size_t which = 0; which < 2; ++which) {
      for (int blocks = 0; process.pipes()[which] >= 0 && blocks < 64; ++blocks) {
        const ssize_t got = read(process.pipes()[which], buffer.data(), buffer.size());
        if (got < 0) break;
        if (got == 0) process.close_pipe(which);
        const std::size_t count = std::max<ssize_t>(got, 0);
        if (which == 1) errors.append(buffer.data(), std::min(count, most_errors - errors.size()));
        else if ((printed += count) <= Limits::bytes(limits.output)) file.write(buffer.data(), count);
      }
    }
  };
  const auto stopped = [&](Ended::How how) {
    process.end();
    return Ended{how, 0, seconds(), errors};
  };
  double looked = 0;
  int looks = 0;
  for (;;) {
    const bool open = process.pipes()[0] >= 0 || process.pipes()[1] >= 0;
    std::array<pollfd, 2> ready{{{process.pipes()[0], POLLIN, 0}, {process.pipes()[1], POLLIN, 0}}};
    poll(ready.data(), 2, open ? milliseconds_between_looks : 5);
    const bool over = process.look();
    read_what_is_there();
    if (printed > Limits::bytes(limits.output)) return stopped(Ended::How::output);
    if (over) break;
    if (seconds() - looked < 0.001 * milliseconds_between_looks) continue;
    looked = seconds();
    tick();
    // Of several limits, the one that leads to the others is told: many processes take much memory, and not the other
    // way round.
    const Usage usage = usage_below(process.keeper(), Limits::bytes(limits.memory));
    if (usage.processes.size() > static_cast<std::size_t>(limits.processes)) return stopped(Ended::How::processes);
    if (++looks % looks_for_files == 0 && !walls && writes_too_much(user, stage.scratch(), limits))
      return stopped(Ended::How::files);
    if (usage.memory > Limits::bytes(limits.memory)) return stopped(Ended::How::memory);
    if (usage.seconds > limits.seconds) return stopped(Ended::How::processor);
    if (seconds() > limits.clock_seconds()) return stopped(Ended::How::clock);
  }
  process.end();
  read_what_is_there();
  if (!walls && writes_too_much(user, stage.scratch(), limits)) return stopped(Ended::How::files);
  Ended ended = ended_as(process.status(), process.seconds(), limits);
  ended.seconds = seconds(), ended.errors = errors;
  return ended;
}

/// Whether bubblewrap can be used, and if not, why, with what to do about it.
struct Walls {
  bool work = false;
  std::string why_not;
};
Walls try_bubblewrap() {
  if (const char* wish = std::getenv("ZSTEP_SANDBOX"); wish != nullptr && std::string(wish) == "limits")
    return {false, "bubblewrap (bwrap) is not used, as ZSTEP_SANDBOX=limits asks for"};
#ifdef __linux__
  if (std::none_of(bubblewrap_places.begin(), bubblewrap_places.end(),
                   [](const char* place) { return access(place, X_OK) == 0; }))
    return {false, "bubblewrap (bwrap) is not installed (apt-get install bubblewrap)"};
  const TemporaryFolder folder("zstep-try");
  std::string says;
  try {
    fs::create_directory(folder.path() / "program");
    const Stage stage(folder.path() / "program", "try", "", {});
    const Ended ended = run_on(stage, "echo works", true, folder.path() / "out", {}, [] {});
    says =
        ended.errors.empty() ? "it " + text_of(ended, {}) : printable(ended.errors.substr(0, ended.errors.find('\n')));
    if (ended.how == Ended::How::well && fs::file_size(folder.path() / "out") > 0) says.clear();
  } catch (const std::exception& error) {
    says = error.what();
  }
  if (says.empty()) return {true, ""};
  return {false, fmt::format("bubblewrap (bwrap) is installed and does not work here: “{}” (it must be allowed to make "
                             "namespaces and to mount; docs/homework.md says how)",
                             says)};
#else
  return {false, "there is no bubblewrap (bwrap) for this system"};
#endif
}

const Walls& walls_here() {
  static const Walls walls = try_bubblewrap();
  return walls;
}

}  // namespace

std::string text_of(const Ended& ended, const Limits& limits, bool exact) {
  switch (ended.how) {
    case Ended::How::well:
      return "ended well";
    case Ended::How::exit_code:
      return !exact              ? "ended with an exit code other than 0"
             : ended.code == 127 ? "could not be started (exit code 127)"
                                 : fmt::format("ended with exit code {}", ended.code);
    case Ended::How::signal:
      if (!exact) return "was ended by a signal";
      for (const SignalText& one : signal_texts)
        if (one.number == ended.code) return fmt::format("was ended by {}", one.text);
      return fmt::format("was ended by signal {}", ended.code);
    case Ended::How::processor:
      return fmt::format("was stopped after {} s of processor time", limits.seconds);
    case Ended::How::clock:
      return fmt::format("was stopped after {} s: it waited for something, or had no end", limits.clock_seconds());
    case Ended::How::memory:
      return fmt::format("was stopped: it took more than {} MiB of memory", limits.memory);
    case Ended::How::processes:
      return fmt::format("was stopped: it started more than {} processes", limits.processes);
    case Ended::How::files:
      return fmt::format("was stopped: it wrote more than {} MiB, {} files, or folders {} deep", limits.files,
                         most_files, deepest_folders);
    case Ended::How::output:
      break;
  }
  return fmt::format("was stopped: it printed more than {} MiB", limits.output);
}

bool has_walls() { return walls_here().work; }

std::string not_protected() {
  if (has_walls()) return "";
  return walls_here().why_not +
         (program_user()
              ? ": programs run as a user of their own, with limits of time, memory, processes, files and output. They "
                "reach the network, read what everybody may read, and write where everybody may write; that is removed "
                "after them. Keep the homework and the results from others (chmod -R go= …)."
              : ": programs run as you, with limits of time, memory and output. They reach the network and all of your "
                "files, the homework's too. Run none that you do not trust.");
}

Ended run_in_sandbox(const std::string& command, const fs::path& program, const std::string& name,
                     const std::string& scene, const fs::path& out, const Limits& limits,
                     const std::function<void()>& tick) {
  const bool walls = has_walls();
  const Stage stage(program, name, scene, limits);
  return run_on(stage, command, walls, out, limits, tick);
}

namespace {

struct Line {
  pid_t process = 0, parent = 0;
  std::uint64_t pages = 0, ticks = 0, of_children = 0;  ///< of children: that it has waited for
};

/// /proc/N/stat; false where the process is gone, or ended and only waits to be noticed.
bool read_line(const char* name, Line& line) {
  std::FILE* file = std::fopen((std::string("/proc/") + name + "/stat").c_str(), "r");
  if (file == nullptr) return false;
  char text[1024];
  const std::size_t length = std::fread(text, 1, sizeof text - 1, file);
  std::fclose(file);
  text[length] = 0;
  const char* after_name = std::strrchr(text, ')');  // the name itself may hold anything
  if (after_name == nullptr) return false;
  char state = 0;
  int parent = 0;
  unsigned long own = 0, system = 0, pages = 0;
  long of_children = 0, system_of_children = 0;
  const int found = std::sscanf(
      after_name + 1, " %c %d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu %ld %ld %*d %*d %*d %*d %*u %*u %lu", &state,
      &parent, &own, &system, &of_children, &system_of_children, &pages);
  if (found != 7 || state == 'Z') return false;
  const std::uint64_t waited_for =
      static_cast<std::uint64_t>(of_children) + static_cast<std::uint64_t>(system_of_children);
  line = {static_cast<pid_t>(std::atoi(name)), parent, pages, own + system + waited_for, waited_for};
  return true;
}

/// The proportional set size that /proc/N/smaps_rollup tells, in bytes.
std::optional<std::uint64_t> proportional_memory(pid_t process) {
  std::FILE* file = std::fopen(("/proc/" + std::to_string(process) + "/smaps_rollup").c_str(), "r");
  if (file == nullptr) return std::nullopt;
  char line[256];
  unsigned long kib = 0;
  bool found = false;
  while (!found && std::fgets(line, sizeof line, file) != nullptr) found = std::sscanf(line, "Pss: %lu kB", &kib) == 1;
  std::fclose(file);
  return found ? std::optional(std::uint64_t{kib} << 10) : std::nullopt;
}

}  // namespace

Usage usage_below(pid_t process, std::uint64_t allowed) {
  Usage usage;
  DIR* all = opendir("/proc");
  if (all == nullptr) return usage;
  std::multimap<pid_t, Line> by_parent;
  std::uint64_t ended = 0;
  while (const dirent* entry = readdir(all)) {
    Line line;
    if (entry->d_name[0] < '1' || entry->d_name[0] > '9' || !read_line(entry->d_name, line)) continue;
    by_parent.emplace(line.parent, line);
    if (line.process == process) ended = line.of_children;
  }
  closedir(all);
  static const std::uint64_t page = sysconf(_SC_PAGESIZE);
  static const auto ticks_a_second = static_cast<double>(sysconf(_SC_CLK_TCK));
  usage.seconds = static_cast<double>(ended) / ticks_a_second;
  std::vector<pid_t> open{process};
  std::set<pid_t> seen{process};
  std::vector<std::pair<pid_t, std::uint64_t>> pages_of;
  while (!open.empty()) {
    const auto [first, last] = by_parent.equal_range(open.back());
    open.pop_back();
    for (auto at = first; at != last; ++at) {
      const Line& line = at->second;
      if (!seen.insert(line.process).second) continue;  // numbers are used again
      usage.processes.push_back(line.process);
      usage.memory += line.pages * page;
      pages_of.emplace_back(line.process, line.pages);
      usage.seconds += static_cast<double>(line.ticks) / ticks_a_second;
      open.push_back(line.process);
    }
  }
  if (usage.memory <= allowed) return usage;
  usage.memory = 0;
  for (const auto& [one, pages] : pages_of) usage.memory += proportional_memory(one).value_or(pages * page);
  return usage;
}

namespace {

constexpr std::array open_places{"/dev/shm", "/tmp", "/var/tmp", "/run/lock", "/dev/mqueue"};

/// Goes through what is in a folder, with no path longer than a name: `visit` is given each name and what it is, and
/// says whether to go on into it. False where it is nested too deep.
template <class Visit>
bool walk(int in, const char* name, int depth, const Visit& visit) {
  const int folder = openat(in, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  DIR* const entries = folder < 0 ? nullptr : fdopendir(folder);
  if (entries == nullptr) {
    if (folder >= 0) close(folder);
    return true;
  }
  bool well = depth <= deepest_folders;
  while (const dirent* entry = well ? readdir(entries) : nullptr) {
    if (std::strcmp(entry->d_name, ".") == 0 || std::strcmp(entry->d_name, "..") == 0) continue;
    struct stat status {};
    if (fstatat(folder, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const bool into = visit(entry->d_name, status);
    if (into && S_ISDIR(status.st_mode)) well = walk(folder, entry->d_name, depth + 1, visit);
  }
  closedir(entries);
  return well;
}

}  // namespace

bool writes_too_much(std::optional<unsigned> user, const std::filesystem::path& folder, const Limits& limits) {
  std::uint64_t bytes = 0;
  int files = 0;
  const auto is_much = [&] { return bytes > Limits::bytes(limits.files) || files > most_files; };
  const auto count = [&](const char*, const struct stat& status) {
    if (is_much() || (user && status.st_uid != *user)) return false;
    constexpr std::uint64_t block = 512;
    bytes += static_cast<std::uint64_t>(status.st_blocks) * block;
    ++files;
    return true;
  };
  if (!walk(AT_FDCWD, folder.c_str(), 0, count)) return true;
  if (user)
    for (const char* place : open_places)
      if (!walk(AT_FDCWD, place, 0, count)) return true;
  return is_much();
}

void remove_files_of(unsigned user) {
  for (const char* place : open_places) {
    std::vector<std::string> names;
    walk(AT_FDCWD, place, 0, [&](const char* name, const struct stat& status) {
      if (status.st_uid == user) names.emplace_back(name);
      return false;
    });
    for (const std::string& name : names) remove_all_of(std::filesystem::path(place) / name);
  }
}

}  // namespace zstep::homework
