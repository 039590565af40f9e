// A step as pictures see it. Nothing in it depends on the way by which a reader came there.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

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
  const RecordedEvent* event_told() const { return session_.event_told(); }
  const std::optional<RecordedEvent>& event_in_question() const { return session_.event_in_question(); }
  /// The lesson's stop that speaks of it, if any.
  const Stop* told() const { return session_.speaks() ? &session_.lesson()->stops[session_.stop()] : nullptr; }
  bool at_rest() const { return session_.at_rest(); }
  /// The step that the lesson's stop asks about, or nullptr.
  const Event* asked() const { return session_.event_in_question() ? &session_.event_in_question()->event : nullptr; }
  /// Whether the stop that speaks gives this number, `rho` say; `else_so` where none speaks.
  bool tells(std::string_view name, bool else_so) const {
    if (!told()) return else_so;
    return std::find(told()->names.begin(), told()->names.end(), name) != told()->names.end();
  }
  std::int64_t position() const { return session_.position(); }
  /// The buffers, which are those of before() while a reader looks back.
  const Picture& picture() const { return session_.picture(); }
  std::int64_t picture_position() const { return session_.looking_back ? session_.before() : session_.position(); }
  /// The other eyes that the lesson speaks of: those of the runs that it shows beside this one.
  std::vector<const Camera*> other_eyes() const {
    std::vector<const Camera*> eyes;
    if (!session_.lesson() || scene().camera.kind != Camera::Kind::perspective) return eyes;
    for (const Stop& stop : session_.lesson()->stops)
      for (const RunBeside& beside : stop.beside) {
        const Camera& camera = beside.run->scene().camera;
        if (!beside.file.empty() || camera.kind != Camera::Kind::perspective) continue;
        const auto there = [&](const Camera* one) { return glm::length(one->eye - camera.eye) < 1e-9; };
        if (!there(&scene().camera) && std::none_of(eyes.begin(), eyes.end(), there)) eyes.push_back(&camera);
      }
    return eyes;
  }

 private:
  const Session& session_;
};

}  // namespace zstep::viewer
