#include "sim/viewer/panes/exact_line.hpp"

#include "sim/answers/origin/exact.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {
namespace {

std::string line_of(const answers::Chain& chain, const Trace& trace) {
  if (chain.links.empty() || chain.links[0].values.empty()) return "";
  const answers::ChainValue& value = chain.links[0].values[0];
  const answers::Exact exact = answers::exactness_of(chain, trace).of[0][0];
  return exact.known && value.word.empty() ? answers::exact_text(value, exact) : "";
}

}  // namespace

std::string exact_line(Session& session, const answers::Question& question) {
  std::string line;
  try {
    session.look_elsewhere([&](Replay& replay) {
      line = line_of(answers::explain_value(session.trace(), replay, question), session.trace());
    });
  } catch (const InputError&) {
    return "";  // a click says what is wrong with it
  }
  return line;
}

std::string exact_line(const Trace& trace, const answers::Question& question) {
  constexpr std::int64_t most_steps = 100'000;  // a frame must not wait for a seek through more
  if (trace.size() > most_steps) return "";
  try {
    return line_of(answers::explain_value(trace, question), trace);
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace zstep::viewer
