// An event from its line of JSON Lines.
#pragma once

#include <nlohmann/json.hpp>

#include "traces/events/vocabulary.hpp"

namespace zstep {

/// Throws MalformedJson where the line's members are not the fields of this kind.
Event event_from_json(std::uint8_t kind, const nlohmann::json& line);

}  // namespace zstep
