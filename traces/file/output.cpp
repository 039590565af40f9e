#include "traces/file/output.hpp"

#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#if __has_include(<sys/file.h>)
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#define ZSTEP_LOCKS_FILES
#endif

#include "traces/outcome.hpp"

namespace zstep {

namespace {

namespace fs = std::filesystem;

struct Inputs {
  std::mutex mutex;
  std::vector<fs::path> paths;
};
Inputs& inputs() {
  static Inputs all;
  return all;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

#ifdef ZSTEP_LOCKS_FILES
/// A file that is open as long as this lives.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  int release() { return std::exchange(number, -1); }
};

bool is_recorded(const fs::path& path) {
  if (!is_file(path)) return false;
  const Descriptor file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  return file.number >= 0 && flock(file.number, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}
#else
bool is_recorded(const fs::path&) { return false; }
#endif

[[noreturn]] void refuse_recorded(const fs::path& path) {
  throw InputError(path.string(), "another zstep is recording to it",
                   "wait until it has ended, or write to another file");
}

}  // namespace

void note_input(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  if (error || !is_file(whole)) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().paths.push_back(whole);
}

void check_replaceable(const fs::path& path) {
  {
    const std::lock_guard lock(inputs().mutex);
    std::error_code error;
    for (const fs::path& input : inputs().paths)
      if (fs::equivalent(path, input, error) && !error)
        throw InputError(path.string(), "would overwrite the input", "write to another file");
  }
  if (is_recorded(path)) refuse_recorded(path);
}

fs::path where_it_leads(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
}

OpenFile open_output(const fs::path& path) {
  errno = 0;
#ifdef ZSTEP_LOCKS_FILES
  std::error_code ignored;
  if (fs::is_fifo(path, ignored)) {
    Descriptor pipe{open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)};
    if (pipe.number < 0 && errno == ENXIO)
      throw InputError(path.string(), "is a pipe that nobody reads", "start its reader first");
    if (pipe.number < 0) return nullptr;
    fcntl(pipe.number, F_SETFL, fcntl(pipe.number, F_GETFL) & ~O_NONBLOCK);
    return OpenFile(fdopen(pipe.release(), "wb"));
  }
#endif
  return OpenFile(std::fopen(path.string().c_str(), "wb"));
}

OpenFile open_own_output(const fs::path& path) {
#ifdef ZSTEP_LOCKS_FILES
  if (!is_file(path) && fs::exists(path)) return open_output(path);
  errno = 0;
  Descriptor file{open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)};
  if (file.number < 0) return nullptr;
  // Emptied once it is ours, not before.
  if (flock(file.number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse_recorded(path);
  if (ftruncate(file.number, 0) != 0) return nullptr;
  return OpenFile(fdopen(file.release(), "wb"));
#else
  return open_output(path);
#endif
}

namespace {

struct AllUnfinished {
  std::mutex mutex;
  std::vector<const Unfinished*> files;
};
AllUnfinished& unfinished() {
  static AllUnfinished all;
  return all;
}

}  // namespace

Unfinished::Unfinished(fs::path path) : path_(std::move(path)) {
  const std::lock_guard lock(unfinished().mutex);
  unfinished().files.push_back(this);
}

Unfinished::~Unfinished() {
  const std::lock_guard lock(unfinished().mutex);
  std::erase(unfinished().files, this);
  std::error_code ignored;
  fs::remove(path_, ignored);
}

void Unfinished::remove_all() {
  const std::lock_guard lock(unfinished().mutex);
  std::error_code ignored;
  for (const Unfinished* file : unfinished().files) fs::remove(file->path(), ignored);
}

void output_failed(const fs::path& path, int error) {
  const std::string what = fmt::format("cannot be written: {}", std::strerror(error));
  if (error == ENOSPC || error == EFBIG || error == EDQUOT)
    throw Exhausted(path.string(), what, "make room there, or write to another place");
  throw InputError(path.string(), what, "choose a place that can be written to");
}

}  // namespace zstep
