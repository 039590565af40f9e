// Pages that hold a run, for commands that make them.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

namespace zstep::cli {

/// Adds --site.
void add_site_option(CLI::App& command, std::string& site);

/// The page of ./zstep web that runs are put into: in the folder that is named, in that of $ZSTEP_SITE, or in the
/// checkout that this program was built in. Throws InputError where there is none.
std::filesystem::path page_without_run(const std::string& site);

}  // namespace zstep::cli
