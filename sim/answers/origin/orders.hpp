// The planes of pieces and the planes through corners, for the files of this folder.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/answers/origin/work.hpp"

namespace zstep::answers {

/// A row of the table of pieces; nullptr where there is none.
const Piece* piece_at(const Work& work, std::int32_t piece);

/// Are pieces cut in the world, as those of a tree are?
bool cuts_in_world(const Work& work);

/// Tells a letter of the plane A x + B y + C z + D = 0 through corners: Newell's normal of length 1, through the mean.
/// The numbers on the way stand at the link of `step` and `subject`. `corner(i, axis)` is a coordinate of the i-th of
/// `count`.
using Corner = std::function<Number(std::size_t, Axis3)>;
void tell_plane(Datum& datum, Work& work, std::int64_t step, const std::string& subject, char letter, std::size_t count,
                const Corner& corner);

/// A x + B y + C z + D at a point.
Formula plane_at(Operands& of, const std::function<Number(char)>& plane, const std::function<Number(Axis3)>& point);
/// The same of a piece's plane, as a number with a name of its own at a step's link.
Number plane_value(Work& work, std::int64_t step, const char* name, std::int32_t piece,
                   const std::function<Number(Axis3)>& point);
/// Where a line is cut by a plane that has these values at its ends.
void tell_cut(Datum& datum, const Number& d_0, const Number& d_1);

}  // namespace zstep::answers
