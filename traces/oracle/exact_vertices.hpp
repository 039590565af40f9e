// Vertices and planes as they are without any rounding, while a trace is gone through.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "traces/formulas/situation.hpp"
#include "traces/oracle/exact_geometry.hpp"

namespace zstep::oracle {

/// What an event's numbers follow from, in fractions: by the formulas of traces/formulas, which are asked with exact
/// operands where these are known and with the recorded ones where not.
using Fields = std::map<std::string_view, Rational>;

class ExactVertices {
 public:
  /// Which numbers count as exact.
  enum class From : std::uint8_t {
    vertices,  ///< each vertex as the method was given it; only what cutting makes is computed anew
    world,     ///< the scene's points and its camera: view, projection, clipping and cutting are computed anew
  };
  explicit ExactVertices(From from) : from_(from) {}

  /// To be called for each step before it is applied; other kinds than these change nothing.
  template <class E>
  void step(const E&, const formulas::Situation&) {}
  void step(const ViewTransform& e, const formulas::Situation& at);
  void step(const Projection& e, const formulas::Situation& at);
  void step(const ViewportTransform& e, const formulas::Situation& at);
  void step(const ClipCross& e, const formulas::Situation& at);
  void step(const SideTest& e, const formulas::Situation&) { cut_by_ = e.plane_of; }
  void step(const SplitVertex& e, const formulas::Situation& at);

  /// (x_s, y_s, depth); nothing where the vertex has not come there, or is not finite.
  std::optional<Point> on_raster(std::int32_t vertex, const formulas::Situation& at) const;
  /// Where pieces are cut: in the world or on the raster.
  std::optional<Point> cutting_point(std::int32_t vertex, const formulas::Situation& at) const;
  /// Of the whole that a piece was cut from; nothing where it encloses no area.
  std::optional<Plane> plane_of(std::int32_t piece, const formulas::Situation& at) const;
  /// The corners of a piece; empty where one is not known.
  std::vector<Point> corners_of(std::int32_t piece, const formulas::Situation& at) const;

  /// The number at a place, where it is known to be other than recorded.
  const Rational* find(const formulas::Place& place) const;

  Fields fields_of(const FacingTest& e, const formulas::Situation& at) const;
  Fields fields_of(const ClipVertex& e, const formulas::Situation& at) const;

 private:
  struct Stages {
    std::optional<Point> world, view, plane, raster;  ///< as VertexStages; plane has (x_p, y_p, z), raster.z is unused
  };
  Stages& stages(std::int32_t vertex) { return stages_[vertex]; }

  From from_;
  std::map<std::int32_t, Stages> stages_;
  std::int32_t cut_by_ = -1;  ///< the piece by whose plane the next cut is
  mutable std::map<std::int32_t, std::optional<Plane>> planes_;
};

}  // namespace zstep::oracle
