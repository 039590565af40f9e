// What a reader sees at a step, as text: for a terminal, and for what reads a page aloud.
#pragma once

#include <string>

#include "sim/viewer/app.hpp"

namespace zstep::viewer {

/// Where the session stands and what happened there, what the lesson says and asks, and every table that has rows, each
/// under its title; one thing a line, signs as words. Draws each pane alone: the App is for nothing else afterwards.
std::string describe(App& app);

/// The same without the tables; changes nothing.
std::string describe_step(App& app);

/// Lists for what builds a page of them: their items are parted by the characters that Unicode has for it, cells of a
/// row by U+001F, rows by U+001E, tables and groups by U+001D.
///
/// Tables with rows: the title's row, the headings' row, and a row for each of theirs, signs as words.
std::string tables_as_list(const std::vector<TableSeen>& tables);
/// All commands by groups: the group's row, then a row for each: id, title, keys.
std::string commands_as_list();

}  // namespace zstep::viewer
