#include "sim/cli/app.hpp"
#include "sim/cli/commands.hpp"

namespace zstep::cli {

void add_all_commands(CLI::App& app, Action& action) {
  add_list(app, action);
  add_lesson(app, action);
  add_view(app, action);
  add_render(app, action);
  add_record(app, action);
  add_info(app, action);
  add_dump(app, action);
  add_find(app, action);
  add_history(app, action);
  add_why_not(app, action);
  add_explain(app, action);
  add_check(app, action);
  add_diff(app, action);
  add_homework(app, action);
  add_grade(app, action);
  add_error(app, action);
  add_header(app, action);
  add_query(app, action);
  add_export(app, action);
  add_import(app, action);
  add_publish(app, action);
  add_compare_methods(app, action);
  add_completion(app, action);
}

}  // namespace zstep::cli
