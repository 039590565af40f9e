#include "tests/where.hpp"

namespace zstep::test {

std::string in_checkout(const std::string& path) { return ZSTEP_SOURCE_DIR "/" + path; }

std::string program_path() { return ZSTEP_EXECUTABLE; }

}  // namespace zstep::test
