#include "sim/homework/temporary_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

/// A folder that is open while this lives; one that was closed to its owner is opened to them first.
class OpenFolder {
 public:
  OpenFolder(int in, const char* name) : number_(open(in, name)) {
    if (number_ < 0 && errno == EACCES && fchmodat(in, name, S_IRWXU, 0) == 0) number_ = open(in, name);
  }
  ~OpenFolder() {
    if (number_ >= 0) close(number_);
  }
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;
  int number() const { return number_; }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    const int copy = openat(number_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const entries = copy < 0 ? nullptr : fdopendir(copy);
    if (entries == nullptr) return all;
    while (const dirent* entry = readdir(entries))
      if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
        all.emplace_back(entry->d_name);
    closedir(entries);
    return all;
  }

 private:
  static int open(int in, const char* name) {
    return openat(in, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  }
  int number_;
};

/// Removes `name` of a folder, a file or a folder. Folders in it come up beside it, to be removed in their turn: then
/// `more` is set.
bool remove_or_lift(const OpenFolder& top, const std::string& name, std::uint64_t& number, bool& more) {
  if (unlinkat(top.number(), name.c_str(), 0) == 0) return true;
  const OpenFolder inner(top.number(), name.c_str());
  if (inner.number() < 0) return false;
  for (const std::string& file : inner.names()) {
    if (unlinkat(inner.number(), file.c_str(), 0) == 0 || unlinkat(inner.number(), file.c_str(), AT_REMOVEDIR) == 0)
      continue;
    const std::string free = ".zstep-lifted-" + std::to_string(number++);
    const auto lift = [&] { return renameat(inner.number(), file.c_str(), top.number(), free.c_str()) == 0; };
    // What is moved is written to, as it holds who it is in.
    more |= lift() || (fchmodat(inner.number(), file.c_str(), S_IRWXU, 0) == 0 && lift());
  }
  return unlinkat(top.number(), name.c_str(), AT_REMOVEDIR) == 0;
}

}  // namespace

bool remove_all_of(const fs::path& path) {
  if (unlink(path.c_str()) == 0 || errno == ENOENT) return true;
  {
    const OpenFolder top(AT_FDCWD, path.c_str());
    if (top.number() < 0) return false;
    std::uint64_t number = 0;
    for (bool more = true; more;) {
      more = false;
      for (const std::string& name : top.names()) remove_or_lift(top, name, number, more);
    }
  }
  return rmdir(path.c_str()) == 0;
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::error_code error;
  const char* const wish = std::getenv("TMPDIR");
  const fs::path place = fs::temp_directory_path(error);
  const std::string where = !error ? place.string() : wish != nullptr ? wish : "/tmp";
  std::string pattern = (fs::path(where) / (name + "-XXXXXX")).string();
  if (error || mkdtemp(pattern.data()) == nullptr)
    throw InputError(where,
                     std::string("no folder can be made there: ") + (error ? error.message() : std::strerror(errno)),
                     "set TMPDIR to a folder that can be written to");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() { remove_all_of(path_); }

}  // namespace zstep::homework
