// Files of the reader's own on the start page: those that were opened before, and those that a typed path may mean.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

class OwnFiles {
 public:
  /// Which of these, the newest last, are still there.
  void look_for(const std::vector<std::string>& opened_before);

  /// What may be meant by what is typed, the likeliest first: files that were opened before and have it in their paths;
  /// what the folder it names, or else the current one, has whose name begins so, folders first; and last the path
  /// itself, where it is one or a formula. A folder ends in "/".
  std::vector<const Offer*> find(const std::string& typed);

 private:
  std::vector<Offer> before_, listed_;
  std::string listed_for_;
};

/// Whether choosing it leads into a folder.
bool is_folder(const Offer& offer);

}  // namespace zstep::viewer
