// This very program as it can be carried to another machine.
#pragma once

#include <filesystem>

namespace zstep::homework {

/// Makes the folder `to`: zstep, a script that starts it, with it and all the libraries that it has loaded, down to the
/// C library. It runs on every Linux of the same kind of processor. Throws InputError on other systems.
void carry_program(const std::filesystem::path& to);

}  // namespace zstep::homework
