// A trace as others may have it: without where files lay on the computer that it was recorded on.
#pragma once

#include <string>

#include "traces/file/bytes.hpp"

namespace zstep {

/// The bytes of a .ztrace file with nothing but the names left of the files that its scene came from. Its events stay
/// as they are, and so does what was cut off or damaged of them. Throws MalformedBytes for what is no trace.
Bytes without_paths(const Bytes& trace);
/// The same of JSON Lines, whose first line is a header. Throws nlohmann::json::exception where it is none.
std::string without_paths_of_jsonl(std::string lines);

/// "pyramid.toml" of "/home/ada/pyramid.toml" or "C:\\ada\\pyramid.toml".
std::string last_part(const std::string& path);

}  // namespace zstep
