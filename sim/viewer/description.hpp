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

}  // namespace zstep::viewer
