#include "sim/homework/sandbox_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "sim/homework/temporary_folder.hpp"

namespace zstep::homework {

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
