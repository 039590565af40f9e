// Traces for the commands that read one: from a file, from JSON Lines, or recorded on the spot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/cli/run_options.hpp"
#include "sim/viewer/viewer.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {

/// "-", for which a trace or JSON Lines are read from standard input.
inline bool is_standard_input(const std::string& path) { return path == "-"; }
/// Throws InputError where it is asked for twice: it can be read once.
void check_reads_once(const std::string& one, const std::string& other);

/// Whether the argument names a trace (standard input, a .ztrace or .jsonl file, or any file that begins like a trace)
/// and not a scene.
bool is_trace(const std::string& path);

/// Whether what is done with a file is limited by its size, or a person sits before it and can end it.
enum class Cost : std::uint8_t { limited, free };
/// Opens a .ztrace or .jsonl file, or standard input, and prints its warnings on stderr, and later what is found to be
/// lost in it.
Trace open_trace(const std::string& path, Cost cost = Cost::limited);
/// The same for who judges a run: JSON Lines are read up to a step that cannot be, of which `impossible` then tells.
Trace open_to_judge(const std::string& path, std::string& impossible, Cost cost = Cost::limited);

/// Records the run to memory. Throws Interrupted after Ctrl-C.
Trace record_to_memory(const Run& run);

/// A run for who waits before a window: one that is too long for a reader's patience is cut off there. Throws
/// InputError where the method cannot draw the scene.
OtherRun record_patiently(const Method& method, const Scene& scene, const Conventions& conventions);
/// This method's, on the scene of a trace; its own options have their standard values.
OtherRun record_by(const Method& method, const Trace& trace);

/// A method's run on the scene of a trace, with these changes made one after the other.
OtherRun run_changed(const Trace& opened, const std::string& method_id, const std::vector<Change>& changes);
/// The same with more patience, on any thread: told false, it ends there, and what there is of it is thrown away.
OtherRun run_watched(const Trace& opened, const std::string& method_id, const std::vector<Change>& changes,
                     const RunWatch& watch);

/// The run of the next (1) or previous (-1) method of the catalog that can draw this trace's scene, in a circle;
/// nullopt when there is no other.
std::optional<OtherRun> record_other_method(const Trace& trace, int direction);

}  // namespace zstep::cli
