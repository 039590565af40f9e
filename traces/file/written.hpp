// Numbers as another program writes them. zstep has the centre of pixel (x, y) at (x, y), and z_v grows away from the
// eye; a program whose header declares it may write positions that are half a pixel larger, or view coordinates that
// are right-handed or those of its own matrices. They are taken over where JSON Lines are read and given back where
// they are written; everything between has zstep's own numbers. The picture is the same.
#pragma once

#include <string_view>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"

namespace zstep {

/// `as_own` from as the program writes them to zstep's own, `as_written` back.
enum class Turned : std::uint8_t { as_own, as_written };

/// One event of a run with such a header. Positions lose ½ or gain it, rounded where it is small; signs change exactly.
/// z_v of a crossing with a clipping plane and the determinant of the back-face test may come with either sign.
/// The camera may have matrices of its own: then view coordinates are those of these, and x_p and y_p are x_c/w_c and
/// y_c/w_c.
void turn(Event& event, const Header& header, const Camera& camera, const Raster& raster, Turned to);

/// Of two depths the nearer one, and the depth at first, where depths change their sign.
void turn(Header& header, Turned to);

/// The points of a scene on the raster, which are positions; of a camera whose matrix is right-handed, its third row.
void turn(Scene& scene, const Header& header, Turned to);

/// Are depths written with the other sign? 1/z_v is negative before a right-handed eye, and so are z_v itself and what
/// is linear in them.
bool depths_change_sign(const Header& header);

/// A kind of event of this run whose numbers could not be taken over, planes or cuts on the raster; empty where all
/// can.
std::string_view kind_that_cannot_turn(const Header& header);

}  // namespace zstep
