// The commands of zstep, a file each. Every add_… declares one command; parsing a command line chooses its action.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "sim/cli/messages.hpp"

namespace zstep::cli {

/// What the parsed command line asks for; returns the exit code. Throws InputError.
using Action = std::function<int()>;

void add_list(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_record(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_dump(CLI::App& app, Action& action);
void add_find(CLI::App& app, Action& action);
void add_history(CLI::App& app, Action& action);
void add_why_not(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_diff(CLI::App& app, Action& action);
void add_homework(CLI::App& app, Action& action);
void add_grade(CLI::App& app, Action& action);
void add_error(CLI::App& app, Action& action);
void add_header(CLI::App& app, Action& action);
void add_query(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_import(CLI::App& app, Action& action);
void add_emit(CLI::App& app, Action& action);
void add_publish(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_lesson(CLI::App& app, Action& action);
void add_compare_methods(CLI::App& app, Action& action);
void add_completion(CLI::App& app, Action& action);

/// `zstep` alone: the Z-buffer lesson in the viewer, or its first picture where there is no display.
int start();

}  // namespace zstep::cli
