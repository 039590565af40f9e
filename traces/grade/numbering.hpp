// Programs that number polygons or vertices otherwise than the scene does: then every step of theirs is about something
// else, and each is called missing, though all that is wrong is the number.
#pragma once

#include <cstdint>

#include "traces/file/trace.hpp"

namespace zstep::grade {

enum class Numbering : std::uint8_t {
  as_scene,             ///< or nothing tells
  polygons_from_1,      ///< the scene's begin at 0
  vertices_from_1,      ///< likewise
  vertices_of_polygon,  ///< each polygon's from 0, where a vertex is known by its number in the scene
};

/// By the edges that a run names: how its numbers would have to be meant for them to be edges of the scene.
Numbering numbering_of(const Trace& run);

/// The scene as it is for a program that numbers so from 1: what is numbered 0 there is something that no run names.
Scene numbered_from_1(Scene scene, Numbering numbering);

}  // namespace zstep::grade
