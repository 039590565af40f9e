// All guesses, for those who ask for them: see foreteller.hpp.
#pragma once

#include "traces/codec/foretell_areas.hpp"
#include "traces/codec/foretell_pieces.hpp"
#include "traces/codec/foretell_polygons.hpp"
#include "traces/codec/foretell_rows.hpp"
