#include "sim/homework/unfinished_folder.hpp"

#include <system_error>

namespace zstep::homework {

namespace fs = std::filesystem;

UnfinishedFolder::UnfinishedFolder(const fs::path& becomes)
    : becomes_((fs::absolute(becomes) / "").lexically_normal().parent_path()),
      path_(becomes_.parent_path() / ("." + becomes_.filename().string() + ".part")) {
  fs::remove_all(path_);
  fs::create_directory(path_);
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void UnfinishedFolder::finish() { fs::rename(path_, becomes_); }

}  // namespace zstep::homework
