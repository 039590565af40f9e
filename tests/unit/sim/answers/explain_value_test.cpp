// The chain behind a number: every formula of it gives the number beside it, and it ends at the lines of the file.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "tests/golden/golden.hpp"

using namespace zstep;
using answers::Chain, answers::ChainLink, answers::ChainValue, answers::explain_value, answers::Question;

namespace {

const ChainLink* link_with(const Chain& chain, const std::string& what) {
  const auto found = std::find_if(chain.links.begin(), chain.links.end(), [&](const ChainLink& link) { return link.what.find(what) != std::string::npos; });
  return found == chain.links.end() ? nullptr : &*found;
}

/// Every formula gives its number; every operand is the number of the link that it names.
void check_numbers(const Chain& chain) {
  for (const ChainLink& link : chain.links)
    for (const ChainValue& value : link.values) {
      CAPTURE(link.step);
      CAPTURE(link.what);
      CAPTURE(answers::line_text(value));
      if (!value.formula.empty()) {
        CAPTURE(answers::evaluate(value));
        CHECK(answers::holds(value));
      }
      for (const answers::Operand& operand : value.operands) {
        if (operand.link < 0) continue;
        const ChainLink& other = chain.links.at(static_cast<std::size_t>(operand.link));
        const auto told = std::find_if(other.values.begin(), other.values.end(), [&](const ChainValue& one) { return one.name == operand.name; });
        REQUIRE(told != other.values.end());
        CHECK((told->value == operand.value || (std::isnan(told->value) && std::isnan(operand.value))));
      }
    }
}

}  // namespace

TEST_SUITE("explain a value") {
  TEST_CASE("of every field of steps of every golden trace: each formula gives its number") {
    std::map<std::string, int> asked;  // of each kind and field, in all traces
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      std::map<std::pair<std::size_t, std::string>, int> here;
      const std::int64_t stride = std::max<std::int64_t>(1, trace.size() / 1500);
      for (std::int64_t step = 1; step <= trace.size(); step += stride) {
        const std::size_t kind = trace.event(step).event.index();
        for (const std::string& field : answers::fields_of_step(trace, step)) {
          int& times = here[{kind, field}];
          if (++times > 8 && times % 64 != 0) continue;
          CAPTURE(step);
          CAPTURE(field);
          const Chain chain = explain_value(trace, Question{step, field, {}, {}, {}});
          REQUIRE_FALSE(chain.links.empty());
          check_numbers(chain);
          ++asked[field];
        }
      }
    });
    CHECK(asked.size() > 60);
  }
}
