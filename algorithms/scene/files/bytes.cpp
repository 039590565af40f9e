#include "algorithms/scene/files/bytes.hpp"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/file/output.hpp"

namespace zstep::scene {

std::string read_bytes(const std::filesystem::path& path, std::size_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw InputError(path.string(), "there is no such file", "check its name and folder");
  if (!std::filesystem::is_regular_file(status))
    throw InputError(path.string(), "it is not a file that can be read whole", "name a file, not a folder or a device");
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path.string(), error.message(), "check who may read it");
  if (size > limit)
    throw InputError(path.string(),
                     fmt::format("it is {:.1f} MiB large, the most is {:.1f}", static_cast<double>(size) / 1048576,
                                 static_cast<double>(limit) / 1048576),
                     "give a smaller file (a decimated mesh, say)");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw InputError(path.string(), "it cannot be read", "check who may read it");
  note_input(path);
  return bytes;
}

}  // namespace zstep::scene
