// Whether a homework can be handed out: all that a class will do is done once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace zstep::homework {

enum class Tried : std::uint8_t {
  right,
  wrong,
  note,  ///< nothing to mend, but to know
};

/// Tries all of it and says what it found, a line each. Returns whether nothing is wrong. Throws InputError where
/// homework.toml or a scene cannot be read. `on_work` is called before what takes time, and while it does.
bool try_homework(const std::filesystem::path& folder, const std::function<void(Tried, const std::string&)>& say,
                  const std::function<void(const std::string&)>& on_work);

}  // namespace zstep::homework
