#include "traces/file/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#if __has_include(<sys/stat.h>) && !defined(_WIN32)
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#define ZSTEP_OPENS_WITHOUT_WAITING
#endif
#if __has_include(<sys/file.h>) && !defined(__EMSCRIPTEN__)
#include <sys/file.h>
#define ZSTEP_LOCKS_FILES
#endif

#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_open(const std::string& name, int error, std::string_view mend) {
  if (error == ENOENT || error == ENOTDIR) throw InputError(name, "there is no such file", mend);
  throw InputError(name, fmt::format("cannot be opened: {}", std::strerror(error)), mend);
}

void check_kind(const std::string& name, fs::file_type type) {
  if (type == fs::file_type::directory) throw InputError(name, "is a folder", "name a file in it");
  if (type == fs::file_type::fifo)
    throw InputError(name, "is a pipe, which may never end", "write what comes out of it to a file, and name that");
  if (type != fs::file_type::regular) throw InputError(name, "is no ordinary file", "name a file, not a device");
}

/// "512 bytes", "64 MiB".
std::string size_text(std::uintmax_t bytes) {
  constexpr std::uintmax_t mib = std::uintmax_t{1} << 20;
  return bytes < mib ? fmt::format("{} bytes", bytes) : fmt::format("{:.4g} MiB", ratio(bytes, mib));
}

}  // namespace

InputFile::InputFile(const fs::path& path, std::string_view mend) : name_(path.string()) {
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file < 0) {
    // A socket cannot be opened at all; what it is says more than why not.
    std::error_code ignored;
    const int error = errno;
    if (const fs::file_type type = fs::status(path, ignored).type(); type == fs::file_type::socket)
      check_kind(name_, type);
    cannot_open(name_, error, mend);
  }
  file_.reset(fdopen(file, "rb"));
  struct stat status {};
  if (!file_ || fstat(file, &status) != 0) cannot_open(name_, errno, mend);
  check_kind(name_, S_ISREG(status.st_mode)    ? fs::file_type::regular
                    : S_ISDIR(status.st_mode)  ? fs::file_type::directory
                    : S_ISFIFO(status.st_mode) ? fs::file_type::fifo
                                               : fs::file_type::unknown);
  size_ = static_cast<std::uint64_t>(status.st_size);
#else
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::not_found) cannot_open(name_, ENOENT, mend);
  check_kind(name_, type);
  file_.reset(std::fopen(name_.c_str(), "rb"));
  if (!file_) cannot_open(name_, errno, mend);
  size_ = fs::file_size(path, error);
#endif
}

InputFile InputFile::standard_input() {
  InputFile input;
  input.name_ = "standard input";
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int file = dup(STDIN_FILENO);
  if (file >= 0) input.file_.reset(fdopen(file, "rb"));
  struct stat status {};
  if (!input.file_ || fstat(file, &status) != 0)
    cannot_open(input.name_, errno, "redirect a file or a program's output to it");
  if (S_ISDIR(status.st_mode)) check_kind(input.name_, fs::file_type::directory);
#else
  input.file_.reset(std::fopen("/dev/stdin", "rb"));
  if (!input.file_) cannot_open(input.name_, errno, "name a file");
#endif
  return input;
}

void InputFile::seek(std::uint64_t offset) {
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int failed = fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET);
#else
  const int failed = std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET);
#endif
  if (failed != 0) throw InputError(name_, "cannot be read at any place", mend_unreadable);
}

std::size_t InputFile::read(void* to, std::size_t count) {
  errno = 0;
  const std::size_t got = std::fread(to, 1, count, file_.get());
  if (got < count && std::ferror(file_.get()) != 0)
    throw InputError(name_, fmt::format("cannot be read to its end: {}", std::strerror(errno != 0 ? errno : EIO)),
                     "check the file and the disk");
  return got;
}

InputStream::Buffer::int_type InputStream::Buffer::underflow() {
  const std::size_t got = file_.read(piece_.data(), piece_.size());
  setg(piece_.data(), piece_.data(), piece_.data() + got);
  return got == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
}

template <class Bytes>
Bytes read_whole(const fs::path& path, std::uintmax_t limit, std::string_view mend, std::string_view mend_large) {
  InputFile file(path, mend);
  const auto refuse_large = [&] {
    throw InputError(file.name(), fmt::format("is larger than {}", size_text(limit)), mend_large);
  };
  if (file.size() > limit) refuse_large();
  // Its size is a hint: it may grow, and what the system makes up as it is read (/proc) has none.
  constexpr std::uintmax_t first_piece = std::uintmax_t{1} << 16;
  Bytes text;
  for (std::uintmax_t wanted = std::min(std::max<std::uintmax_t>(file.size() + 1, first_piece), limit + 1);;) {
    const std::size_t had = text.size();
    text.resize(wanted);
    const std::size_t got = file.read(text.data() + had, text.size() - had);
    const bool ended = had + got < text.size();
    text.resize(had + got);
    if (text.size() > limit) refuse_large();
    if (ended) return text;
    wanted = std::min(2 * wanted, limit + 1);
  }
}

template std::string read_whole(const fs::path&, std::uintmax_t, std::string_view, std::string_view);
template std::vector<std::uint8_t> read_whole(const fs::path&, std::uintmax_t, std::string_view, std::string_view);

namespace {

namespace fs = std::filesystem;

struct NotedInputs {
  std::mutex mutex;
  std::vector<fs::path> paths;
};
NotedInputs& inputs() {
  static NotedInputs all;
  return all;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<fs::path> noted_inputs() {
  const std::lock_guard lock(inputs().mutex);
  return inputs().paths;
}

/// Where a link leads; the path itself where it is none, or leads to what has no name (/dev/stdout to a pipe).
fs::path where_it_leads(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path end = fs::weakly_canonical(path, error);
  return error || end.empty() ? path : end;
}

[[noreturn]] void refuse_recorded(const std::string& path) {
  throw InputError(path, "another zstep is recording to it", "wait until it has ended, or write to another file");
}
[[noreturn]] void refuse_input(const std::string& path) {
  throw InputError(path, "would overwrite the input", "write to another file");
}

}  // namespace

void note_input(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  if (error || !is_file(whole)) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().paths.push_back(whole);
}

#ifdef ZSTEP_LOCKS_FILES

namespace {

/// A file that is open as long as this lives.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  int release() { return std::exchange(number, -1); }
};

bool is_one_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

bool is_noted(const struct stat& file) {
  struct stat input {};
  for (const fs::path& path : noted_inputs())
    if (stat(path.c_str(), &input) == 0 && is_one_file(file, input)) return true;
  return false;
}

#ifdef O_PATH
constexpr int as_folder = O_PATH | O_DIRECTORY | O_CLOEXEC;
#else
constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
#endif

}  // namespace

/// What has the name now, links not followed.
struct OutputPlace::Found {
  bool there = false;
  struct stat status {};
};

OutputPlace::Found OutputPlace::look() const {
  Found found;
  found.there = fstatat(folder_, name_.c_str(), &found.status, AT_SYMLINK_NOFOLLOW) == 0;
  return found;
}

OutputPlace::OutputPlace(const fs::path& path, Inputs inputs, Links links)
    : path_(links == Links::followed ? where_it_leads(path) : path),
      shown_(path.string()),
      name_(path_.filename().string()),
      inputs_(inputs) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (path.filename().empty() || fs::is_directory(status)) throw InputError(shown_, "is a folder", "name a file in it");
  device_ = fs::exists(status) && !fs::is_regular_file(status);
  if (device_) return;
  const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
  Descriptor held{open(folder.c_str(), as_folder)};
  if (held.number < 0 && (errno == ENOENT || errno == ENOTDIR))
    throw InputError(shown_, fmt::format("there is no folder {}", folder.string()),
                     "make it first, or write to another place");
  if (held.number < 0) output_failed(shown_, errno);
  // Renaming over a file asks only the folder; a file that its owner protected stays as it is.
  if (const Descriptor old{openat(held.number, name_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
      old.number < 0 && errno != ENOENT && errno != ELOOP)
    output_failed(shown_, errno);
  folder_ = held.release();
  try {
    // A link to an input would be replaced and the input not, but that is hardly what was meant.
    struct stat led {};
    if (inputs_ == Inputs::kept && fstatat(folder_, name_.c_str(), &led, 0) == 0 && is_noted(led)) refuse_input(shown_);
    check_replaceable();
  } catch (...) {
    close(folder_);
    throw;
  }
}

OutputPlace::~OutputPlace() {
  if (folder_ >= 0) close(folder_);
}

void OutputPlace::check_replaceable() const {
  const Found found = look();
  if (!found.there) return;
  if (inputs_ == Inputs::kept && is_noted(found.status)) refuse_input(shown_);
  if (!S_ISREG(found.status.st_mode)) return;
  const Descriptor file{openat(folder_, name_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  if (file.number >= 0 && flock(file.number, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse_recorded(shown_);
}

OpenFile OutputPlace::open_device() const {
  Descriptor file{open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
  if (file.number < 0 && errno == ENXIO)
    throw InputError(shown_, "is a pipe that nobody reads", "start its reader first");
  if (file.number < 0) output_failed(shown_, errno);
  struct stat status {};
  if (fstat(file.number, &status) != 0) output_failed(shown_, errno);
  if (S_ISREG(status.st_mode))
    throw InputError(shown_, "was made another file by somebody meanwhile", "write to a folder that is yours");
  fcntl(file.number, F_SETFL, fcntl(file.number, F_GETFL) & ~O_NONBLOCK);
  return OpenFile(fdopen(file.release(), "wb"));
}

OpenFile OutputPlace::make(const std::string& name) const {
  const int file = openat(folder_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) output_failed(shown_, errno);
  return OpenFile(fdopen(file, "wb"));
}

OpenFile OutputPlace::make_own(const std::string& name) const {
  for (;;) {
    Descriptor file{
        openat(folder_, name.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666)};
    struct stat status {
    }, named{};
    const bool opened = file.number >= 0 && fstat(file.number, &status) == 0;
    if ((opened && (!S_ISREG(status.st_mode) || is_noted(status))) || (!opened && (errno == ELOOP || errno == ENXIO)))
      throw InputError(beside(name).string(), "is in the way: the trace is made under this name", "move it away");
    if (!opened) output_failed(shown_, errno);
    if (flock(file.number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse_recorded(shown_);
    // Whoever had it may have given it its last name before it was ours.
    if (fstatat(folder_, name.c_str(), &named, AT_SYMLINK_NOFOLLOW) != 0 || !is_one_file(status, named)) continue;
    if (ftruncate(file.number, 0) != 0) output_failed(shown_, errno);
    return OpenFile(fdopen(file.release(), "wb"));
  }
}

void OutputPlace::take(const std::string& name) const {
  check_replaceable();
  if (renameat(folder_, name.c_str(), folder_, name_.c_str()) != 0) output_failed(shown_, errno);
}

#else

OutputPlace::OutputPlace(const fs::path& path, Inputs inputs, Links links)
    : path_(links == Links::followed ? where_it_leads(path) : path),
      shown_(path.string()),
      name_(path_.filename().string()),
      inputs_(inputs) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (path.filename().empty() || fs::is_directory(status)) throw InputError(shown_, "is a folder", "name a file in it");
  device_ = fs::exists(status) && !fs::is_regular_file(status);
  if (path_.has_parent_path() && !fs::is_directory(path_.parent_path(), ignored))
    throw InputError(shown_, fmt::format("there is no folder {}", path_.parent_path().string()),
                     "make it first, or write to another place");
  if (fs::is_regular_file(status) && !OpenFile(std::fopen(path_.string().c_str(), "r+b"))) output_failed(shown_, errno);
  check_replaceable();
}
OutputPlace::~OutputPlace() = default;

void OutputPlace::check_replaceable() const {
  std::error_code error;
  if (inputs_ == Inputs::no_matter) return;
  for (const fs::path& input : noted_inputs())
    if (fs::equivalent(path_, input, error) && !error) refuse_input(shown_);
}

OpenFile OutputPlace::open_device() const { return make(name_); }
OpenFile OutputPlace::make_own(const std::string& name) const { return make(name); }
OpenFile OutputPlace::make(const std::string& name) const {
  OpenFile file(std::fopen(beside(name).string().c_str(), "wb"));
  if (!file) output_failed(shown_, errno);
  return file;
}

void OutputPlace::take(const std::string& name) const {
  check_replaceable();
  std::error_code error;
  fs::rename(beside(name), path_, error);
  if (error) output_failed(shown_, error.value());
}

#endif

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
