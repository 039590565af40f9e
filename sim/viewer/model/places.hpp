// Where a reader wants to be: at the next step that fulfils a condition, at a bookmark. Searches a little each frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/places/bookmarks.hpp"
#include "sim/places/search.hpp"
#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

class Places {
 public:
  using Way = places::Search::Way;

  /// The session must outlive it.
  explicit Places(Session& session);

  // --- Run until a condition holds
  /// Begins to look from where the reader is. What is wrong with the condition, or nothing.
  std::string run_until(const std::string& condition, Way way);
  /// On to the next step that fulfils the last condition.
  void again(Way way);
  bool searching() const { return search_.has_value(); }
  /// Looks on for some milliseconds, and goes to what it finds.
  void look_on();
  void stop();
  /// "looking forwards for `not nearer`: step 41 233 000 of 100 000 000"
  std::string progress() const;
  double share() const { return search_ ? search_->share() : 0; }

  struct Suggestion {
    std::string condition, meaning;
  };
  /// Conditions that are likely wanted here: those asked before, and what is at work or selected.
  std::vector<Suggestion> suggestions() const;

  // --- Bookmarks
  const places::Bookmarks& marks() const { return bookmarks_; }
  const std::vector<places::Bookmark>& bookmarks() const { return bookmarks_.all(); }
  void read_bookmarks();                                   ///< again, as they were changed by another than this
  const std::string& trouble() const { return trouble_; }  ///< why they cannot be read, or nothing
  /// Why none can be set, or nothing; asked before a name is typed.
  std::string why_no_bookmark() const;
  /// Sets one here. What is wrong with that, or nothing.
  std::string bookmark(const std::string& name);
  std::string remove_bookmark(std::size_t place);

 private:
  Session& session_;
  std::optional<places::Search> search_;
  std::int64_t from_ = 0;           ///< where the reader was when it began
  std::vector<std::string> asked_;  ///< newest first
  places::Bookmarks bookmarks_;
  std::string trouble_;
};

}  // namespace zstep::viewer
