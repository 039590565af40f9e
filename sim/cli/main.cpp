#include <string>
#include <vector>

#include "sim/cli/app.hpp"
#include "sim/cli/messages.hpp"

int main(int argc, char** argv) {
  zstep::cli::hold_standard_streams();
  return zstep::cli::run(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
}
