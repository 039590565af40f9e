#include "sim/homework/pack_program.hpp"

#ifdef __linux__
#include <link.h>
#endif

#include <fstream>
#include <string>
#include <vector>

#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

#ifdef __linux__
/// The files of the libraries of this process, the loader among them.
std::vector<fs::path> loaded_libraries() {
  std::vector<fs::path> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* list) {
        // The program itself has no name here; what the kernel brings along is no file.
        if (std::error_code ignored; info->dlpi_name != nullptr && fs::is_regular_file(info->dlpi_name, ignored))
          static_cast<std::vector<fs::path>*>(list)->emplace_back(info->dlpi_name);
        return 0;
      },
      &files);
  return files;
}
#endif

}  // namespace

void carry_program([[maybe_unused]] const fs::path& to) {
#ifdef __linux__
  const fs::path self = fs::read_symlink("/proc/self/exe");
  if (self.filename().string().starts_with("ld-"))
    throw InputError("homework pack", "this zstep came in a pack itself", "use the one that was built or installed");
  fs::create_directories(to / "lib");
  fs::copy_file(self, to / "lib" / "zstep");
  std::string loader;
  for (const fs::path& library : loaded_libraries()) {
    const std::string name = library.filename().string();
    fs::copy_file(library, to / "lib" / name, fs::copy_options::skip_existing);
    if (name.starts_with("ld-")) loader = name;
  }
  std::ofstream(to / "zstep") << "#!/bin/sh\n"
                                 "# zstep with the libraries that it was made with, whatever this machine has.\n"
                                 "lib=$(cd \"$(dirname \"$0\")/lib\" && pwd) || exit 2\n"
                              << (loader.empty()
                                      ? "exec \"$lib/zstep\" \"$@\"\n"
                                      : "exec \"$lib/" + loader + "\" --library-path \"$lib\" \"$lib/zstep\" \"$@\"\n");
  for (const char* file : {"zstep", "lib/zstep"}) fs::permissions(to / file, fs::perms(0755));
  if (!loader.empty()) fs::permissions(to / "lib" / loader, fs::perms(0755));
#else
  throw InputError("homework pack", "the services run Linux, and this zstep does not", "pack it on Linux");
#endif
}

}  // namespace zstep::homework
