// Hidden-line removal in object space: each edge is cut into the pieces that are seen and those that some face hides.
//
// L. G. Roberts, "Machine Perception of Three-Dimensional Solids", MIT Lincoln Laboratory TR 315, 1963; A. Appel, "The
// Notion of Quantitative Invisibility and the Machine Rendering of Solids", ACM National Conference, 1967; P. P.
// Loutrel, "A Solution to the Hidden-Line Problem for Computer-Drawn Polyhedra", IEEE Transactions on Computers
// C-19(3), 1970; as taught in 002 and 004 (Foley, van Dam, Feiner and Hughes, section 15.3). Of the three this is the
// plain one, every edge against every face that may hide some of it: faces may be concave, penetrate each other, and
// need enclose no solid. Appel counts along each edge how many faces hide it instead, and looks only where a contour
// edge crosses it.
//
// The line in which two faces penetrate each other is no edge, and is not drawn. With --no-cull faces hide what is
// behind them and edges are drawn whichever way they face.
#pragma once

#include <array>

#include "algorithms/hidden_line/lines.hpp"
#include "algorithms/pieces/pieces.hpp"
#include "algorithms/catalog/catalog.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of hidden-line removal.

#define ZSTEP_MODULE hidden_line
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/hidden_line/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::hidden_line {

inline constexpr std::array options{
    Option{"hidden", "none|dashed", "none", "what is drawn where an edge is hidden", false}};

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::hidden_line
