// Who takes part in a race: a method, with something of it other than usual.
#pragma once

#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"

namespace zstep::compare {

struct Entrant {
  const Method* method = nullptr;
  std::vector<Change> changes;  ///< options of the method, and conventions
  std::string text;             ///< "bsp:root=random"
  std::string title;            ///< "BSP tree, root = random"
};

/// "z-buffer", "z-buffer:interpolation=increments". Throws InputError, whose line begins with `who`.
Entrant read_entrant(const std::string& text, const std::string& who = "--race");

/// Each method that can draw a scene, and after it each word that its options and conventions may have instead. The
/// conventions are those of a run of the method named.
std::vector<Entrant> all_entrants(const Scene& scene, const Conventions& conventions);

}  // namespace zstep::compare
