// What a number under the mouse is without rounding, in one line.
#pragma once

#include <string>

#include "sim/answers/explain_value.hpp"
#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

/// "exactly 1/3 = 0.3333…; error −1.9e−17, −0.33 ulp"; nothing where the trace does not say where the number comes
/// from. Looks at other steps through the session's replay: what was kept of its state is gone then.
std::string exact_line(Session& session, const answers::Question& question);
/// The same in the middle of drawing a state, through a replay of its own; nothing of a trace too long for that.
std::string exact_line(const Trace& trace, const answers::Question& question);

}  // namespace zstep::viewer
