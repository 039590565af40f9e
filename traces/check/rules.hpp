// The rules that a run must keep besides its formulas, by name.
#pragma once

#include <string_view>

#include "traces/formulas/situation.hpp"

namespace zstep {

struct RuleText {
  std::string_view name;      ///< "edge_in_bucket", as `zstep check --json` writes it
  std::string_view sentence;  ///< what must hold
  std::string_view broken;    ///< what is said of a step that breaks it
};
RuleText rule_text(formulas::Rule rule);

}  // namespace zstep
