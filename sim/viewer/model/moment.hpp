// A step as pictures see it. Nothing in it depends on the way by which a reader came there.
#pragma once

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

class Moment {
 public:
  explicit Moment(const Session& session) : session_(session) {}

  const Trace& trace() const { return session_.trace(); }
  const Scene& scene() const { return session_.scene(); }
  const Header& header() const { return session_.header(); }
  const State& state() const { return session_.state(); }
  const RecordedEvent* event() const { return session_.event(); }
  /// The lesson's stop that speaks of it, if any.
  const Stop* told() const { return session_.speaks() ? &session_.lesson()->stops[session_.stop()] : nullptr; }
  bool at_rest() const { return session_.at_rest(); }
  std::int64_t position() const { return session_.position(); }
  /// The buffers, which are those of before() while a reader looks back.
  const Picture& picture() const { return session_.picture(); }
  std::int64_t picture_position() const { return session_.looking_back ? session_.before() : session_.position(); }

 private:
  const Session& session_;
};

}  // namespace zstep::viewer
