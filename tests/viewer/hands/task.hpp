// What a person does in the window, as a list that can be read: tasks.txt, and how a line of it is understood.
#pragma once

#include <string>
#include <vector>

namespace zstep::test {

struct HandTask {
  std::string name;
  std::string from;               ///< what is opened: "lesson z-buffer --at 867", "view pyramid --algorithm bsp --at 9"
  std::vector<std::string> keys;  ///< steps by the keyboard alone
  std::vector<std::string> mouse;  ///< steps by the mouse alone
  std::vector<std::string> then;   ///< what is true afterwards, and was not before
  std::string no_keys, no_mouse;   ///< why it cannot be done so
  bool real = false;               ///< also done with a display server's events
  int line = 0;                    ///< of the file
  std::string not_real{};          ///< why that cannot be compared
};

/// Throws std::runtime_error, with the line, for what is not understood.
std::vector<HandTask> read_hand_tasks(const std::string& path);

/// "from" as words: what is opened, its name, the method or "", and the step or -1.
struct HandStart {
  bool lesson = false, presenter = false;
  std::string name, method;
  long long at = -1;
};
HandStart hand_start(const std::string& from);

}  // namespace zstep::test
