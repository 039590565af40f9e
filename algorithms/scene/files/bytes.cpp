#include "algorithms/scene/files/bytes.hpp"

#include "traces/file/files.hpp"

namespace zstep::scene {

std::string read_bytes(const std::filesystem::path& path, std::size_t limit) {
  std::string bytes = read_whole(path, limit, mend_unreadable, "give a smaller file (a decimated mesh, say)");
  note_input(path);
  return bytes;
}

}  // namespace zstep::scene
