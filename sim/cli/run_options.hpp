// What render, record and view have in common: a scene, how it is looked at, and under which conventions it is drawn.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {

struct RunOptions {
  std::string scene;  ///< a built-in scene's name, a scene file or a mesh
  std::string algorithm = "z-buffer";
  ViewOptions view;
  ConventionChoices conventions;
  WrittenAs written;                    ///< for commands that write a header
  std::set<std::string> written_given;  ///< the options of these that were given
  std::string like;                     ///< whose conventions they are where none is given
  bool no_cull = false;
  std::map<std::string, std::string> options;  ///< of the method
  std::vector<Change> changes;                 ///< made last, one after the other
  std::vector<CLI::Option*> declared;          ///< all of the options below

  /// The first of these options that the command line gives, or "".
  std::string given() const;
};

/// Adds --algorithm, --option, --size, the camera's and the conventions' options to a command; they fill `options` when
/// parsed. Without `of_one_method` the first two are left out.
void add_run_options(CLI::App& command, RunOptions& options, bool of_one_method = true);

/// Adds --pixel-centre and --view-coordinates to a command that writes a header.
void add_written_options(CLI::App& command, RunOptions& options);

/// The scene itself, as a positional argument that must be given.
void add_scene(CLI::App& command, RunOptions& options);

/// A scene that a method may run on.
struct Run {
  Scene scene;
  Conventions conventions;
  const Method* method;
  WrittenAs written{};
};
/// Of a trace of it.
Header header_of(const Run& run);
/// Loads the scene, prints what there is to note about it on stderr, and applies the options. Throws InputError.
Run prepare(const RunOptions& options);

/// The same once more, without the notes.
Run prepare_again(const RunOptions& options);

/// The same, where the command has a budget: what a scene file or a mesh may cost follows from its size and from
/// --size, a byte a pixel. Built-in scenes and formulas cost what they cost.
Run prepare_within_budget(const RunOptions& options);

/// Adds an option that takes a number, a size, or one of some words, with errors that say what was expected.
CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<double>& value,
                        const std::string& help);
CLI::Option* add_whole(CLI::App& command, const std::string& name, std::optional<std::int64_t>& value,
                       std::int64_t least, const std::string& help);

}  // namespace zstep::cli
