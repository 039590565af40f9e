#include "sim/viewer/model/before_change.hpp"

#include <utility>

namespace zstep::viewer {

BeforeChange::BeforeChange(const Session& now, std::shared_ptr<const Trace> before)
    : now_(now),
      trace_(std::move(before)),
      both_(diff::align(now.trace(), *trace_, nullptr, diff::Way::fast, 0)),
      session_(*trace_, nullptr) {}

void BeforeChange::follow() { session_.go_to(moment_in_b(both_, now_.position(), now_.size(), session_.size())); }

std::int64_t moment_in_b(const diff::Alignment& both, std::int64_t at, std::int64_t size_a, std::int64_t size_b) {
  if (at == 0) return 0;
  if (at == size_a) return size_b;
  const std::int64_t partner = both.in_b(at);
  return partner != 0 ? partner : both.before_in_b(at);
}

}  // namespace zstep::viewer
