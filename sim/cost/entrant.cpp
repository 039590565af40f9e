#include "sim/cost/entrant.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "traces/error.hpp"

namespace zstep::compare {

Entrant read_entrant(const std::string& text, const std::string& who) {
  Entrant entrant{nullptr, {}, text, ""};
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    const std::string part = text.substr(at, end - at);
    at = end + 1;
    if (entrant.method) {
      entrant.changes.push_back(read_change(part, who + " " + text + ":"));
      entrant.title += fmt::format(", {} = {}", entrant.changes.back().name, entrant.changes.back().value);
      continue;
    }
    std::string ids;
    for (const Method& method : methods()) {
      if (method.id == part) entrant.method = &method, entrant.title = method.title;
      ids += (ids.empty() ? "" : ", ") + std::string(method.id);
    }
    if (!entrant.method)
      throw InputError(fmt::format("{} {}", who, text), fmt::format("there is no method '{}'", part),
                       fmt::format("give one of {}, or one with a change, as bsp:root=random", ids));
  }
  return entrant;
}

namespace {

/// A convention's key or word as a trace's header has it.
std::string with_underscores(std::string text) {
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

Conventions with(Conventions conventions, const Method& method, const std::string& name, const std::string& word) {
  const auto is_it = [&](const Option& option) { return option.name == name; };
  if (std::any_of(method.options.begin(), method.options.end(), is_it)) conventions.options[name] = word;
  else ConventionChoices{{{with_underscores(name), with_underscores(word)}}}.apply(conventions);
  return conventions;
}

}  // namespace

std::vector<Entrant> all_entrants(const Scene& scene, const Conventions& conventions) {
  std::vector<Entrant> all;
  for (const Method& method : methods()) {
    const Conventions its = conventions_for(method, conventions);
    if (!can_draw(method, scene, its)) continue;
    all.push_back(read_entrant(std::string(method.id)));
    for (const Changeable& what : changeables(method, scene, its)) {
      if (what.name == "cull") continue;
      for (const std::string& word : what.choices)
        if (word != what.value && can_draw(method, scene, with(its, method, what.name, word)))
          all.push_back(read_entrant(fmt::format("{}:{}={}", method.id, what.name, word)));
    }
  }
  return all;
}

}  // namespace zstep::compare
