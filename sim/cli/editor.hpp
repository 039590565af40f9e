// The editor in which a person looks at the program that printed a step.
#pragma once

#include <string_view>

namespace zstep::cli {

/// Opens a place as "raster.cpp:417" with the command that ZSTEP_EDITOR names, as "code -g {}": its words are
/// separated by spaces, {} is the place, and no shell is involved. Nothing where the variable is not set or the place
/// is not a line of an existing file: a run may name anything. What cannot be started is said on stderr, and is no
/// fault.
void open_in_editor(std::string_view place);

}  // namespace zstep::cli
