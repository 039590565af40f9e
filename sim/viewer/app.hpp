// The viewer without its window: takes SDL's events, draws one frame into a picture, asks the window for what it cannot
// do itself. Never blocks.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <SDL.h>

#include "algorithms/catalog/changes.hpp"
#include "sim/answers/explain_value.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/places/typed_place.hpp"
#include "sim/viewer/board.hpp"
#include "sim/viewer/field.hpp"
#include "sim/viewer/film.hpp"
#include "sim/viewer/finder.hpp"
#include "sim/viewer/model/against.hpp"
#include "sim/viewer/model/findings.hpp"
#include "sim/viewer/model/places.hpp"
#include "sim/viewer/model/race.hpp"
#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/motion.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/ui.hpp"
#include "sim/viewer/settings.hpp"
#include "sim/viewer/touch.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

// What a reader changed of a run.

/// What a reader changed, against the run that was opened.
struct Changed {
  struct Made {
    Change change;
    std::string was;  ///< its value in the run that was opened
  };
  std::vector<Made> made;         ///< each thing once
  std::vector<PixelMark> pixels;  ///< that end otherwise than in the run before
  std::string told;               ///< what the last change did, in a sentence
  std::optional<TaskState> task;  ///< how the run stands to what is to be tried
};

// What the window is asked to do.

/// Whoever owns the window takes the requests and clears them.
struct WindowRequests {
  bool quit = false, toggle_full_screen = false;
  bool leave_page = false;                  ///< that it is embedded in: to a window with everything
  bool toggle_notes = false;                ///< the speaker's, in a window of their own
  bool choose_file = false;                 ///< by the desktop's own dialogue
  bool save_progress = false;               ///< and settings and bookmarks, as one file
  bool check = false;                       ///< whether each step follows from its own operands
  std::optional<std::string> compare_with;  ///< the run of a file, or of what can be opened; empty: zstep's own
  bool marks_kept = false;                  ///< other bookmarks are in their file than before
  std::optional<std::string> clipboard;
  std::optional<std::string> save_picture;  ///< of the window: a path without the end of its name
  std::optional<std::string> save_slide;    ///< of what leads, with a caption: the same
  int switch_method = 0;                    ///< 1 or -1: to another method on the same scene
  std::optional<Offer> open;
  bool for_class = false;       ///< and that in presenter mode, a lesson from its first stop on
  std::vector<Change> changes;  ///< of the run, one after the other
  bool change_goes_on = false;  ///< it takes the place of the one before, which a hand has not let go
  bool end_run = false;         ///< the one that is made while the window goes on
  int back_to_lesson = 0;       ///< from a run in its place: to its next stop (1), or the previous one (-1)
  int undo_change = 0;          ///< 1, or -1: make what was undone again

  /// Whether what was asked for may show something else: the next key is meant for that, and waits for it.
  bool may_show_other() const {
    return check || compare_with || switch_method != 0 || open || !changes.empty() || end_run || undo_change != 0 ||
           back_to_lesson != 0;
  }
};

/// What lies over the window for a moment.
enum class Overlay { none, keys, palette, go_to, menu, start, here, settings, racers, film };
/// What is asked about the run, in the drawer.
enum class Drawer {
  none,
  history,
  why_ask,
  why,
  explain,
  until,
  query,
  name_bookmark,
  bookmarks,
  range,
  compare,
  what_if
};

class App {
 public:
  /// `dpi_scale`: pixels of this picture per pixel of a common screen.
  App(const Trace& trace, const Lesson* lesson, const Settings& settings, int width, int height, float dpi_scale = 1);
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  /// True when a frame should be drawn before the next event is taken: a mouse button changed, or a field got a key.
  bool handle(const SDL_Event& event, float pixels_per_point = 1);
  /// What a finger that rests means by now, in SDL's milliseconds; seconds until that is to be asked again.
  double wait_for_finger(std::int64_t now);
  /// Left, top, right and bottom of the line that is typed into now, in pixels.
  std::optional<ImVec4> typed_line() const { return typing() ? std::optional(field_.place()) : std::nullopt; }
  void resize(int width, int height);
  void set_dpi_scale(float scale);

  /// Every pane that can be shown of such a trace.
  static std::vector<Pane> all_panes(const Header& header, bool with_lesson);
  /// From now on draws this pane and nothing else. False where there is none of this name.
  bool show_only(const std::string& pane);

  /// Marks what check found. `checked` must live as long.
  void show_findings(const CheckedRun& checked);
  /// Shows a second run beside this one. What it points to must live as long.
  void show_against(const AgainstRun& with);
  bool compares() const { return against_.has_value(); }
  void end_against();  ///< and shows this one alone
  // The drawer's page of it (drawer/compare.cpp)
  void open_compare();  ///< or ends comparing
  void compare_typed();
  /// To the next (1) or previous (-1) cause of what is wrong, or of why two runs part.
  void to_cause(int direction);
  void to_first_cause();
  bool opens_at_cause() const { return opens_at_cause_; }
  /// To the next or previous step that is marked, and to the first pixel in which two runs part.
  void to_marked(int direction);
  void to_pixel_apart();
  /// To the next or previous difference in the same fields.
  void to_alike(int direction);

  /// Frames after a change until nothing moves any more.
  static constexpr int frames_to_settle = 4;
  /// Draws what is to be seen now into renderer().picture(). A field that opens has the keyboard afterwards.
  void frame();
  /// Frames until nothing moves any more: hovering, scrolling and sizes need more than one.
  void settle();
  // For slides (app_slide.cpp): pictures of what is seen now, in which nothing is pointed at.
  Drawing of_window();
  /// What leads, alone, with a caption below it: of which lesson, stop and step, and what that did. Throws InputError
  /// where no picture leads.
  Drawing slide();

  Ui& ui() { return ui_; }
  Session& session() { return session_; }
  Renderer& renderer() { return renderer_; }
  Settings& settings() { return settings_; }
  const Settings& settings() const { return settings_; }
  WindowRequests requests;

  /// What the start page offers, and it can be opened; asked for once, when the page is first shown.
  void offer(std::function<std::vector<Offer>()> offers) { ask_for_offers_ = std::move(offers); }
  /// What has the typed text in its name or title, in the order in which the page shows it; last, if a path is typed,
  /// the file.
  std::vector<const Offer*> choices();
  const std::vector<Offer>& offers();  ///< all of them
  void open_start();                   ///< with the lesson picked that was open last
  void open_start(Offer::What what);   ///< with the first of these picked that is not what is shown
  void open_offer(const Offer& offer);
  void see_file();                            ///< if what is shown is a file of the reader's, it is offered from now on
  void take_file(const std::string& path);    ///< that was chosen, or dropped on the window
  void say_on_start(const std::string& why);  ///< that it could not be opened

  // --- What if (app_changes.cpp, drawer/what_if.cpp)
  void allow_changes(Race::RunBy run_by) { run_by_ = std::move(run_by); }
  bool may_change() const { return run_by_ != nullptr; }
  bool waits_for_run = false;  ///< one is made while the window goes on
  /// `before`: the run that it is compared with.
  void show_changes(Changed changed, std::shared_ptr<const Trace> before = nullptr);
  const Changed& changed() const { return changed_; }
  const std::string& saved_scene() const { return saved_scene_; }
  /// What has the typed name in its name, as it is now; empty where the method is none of zstep's.
  std::vector<Changeable> found_changeables() const;
  void open_what_if();  ///< or closes it
  /// What the lesson asks to be tried where it stands, also once its run was changed; null where it asks for nothing.
  const Task* task() const;
  std::size_t hints_given() const { return hints_given_; }
  void give_hint();  ///< the next one, and after the last the solution
  void change_typed();
  void ask_change(Change change, bool goes_on = false);
  void nudge(const Changeable& what, int direction);  ///< a little more, or the next of its words
  void save_scene();  ///< of the run that is shown, as a scene file in the folder zstep was started in
  void say_unchanged(const std::string& why);  ///< that it could not be changed
  /// Looks at this run as a reader did at the one before: the same panes, places and what is typed.
  void look_as(const App& before);

  // --- Race: methods side by side in place of the panes (race_view.cpp, race_chart.cpp)
  void open_race(const std::optional<RaceAsked>& asked = {});  ///< throws InputError for what is asked and cannot be
  void close_race();
  bool racing() const { return race_shown_; }
  Race& race() { return race_->race; }
  GrowthChart& growth() { return race_->growth; }
  bool shows_growth() const { return race_shown_ && race_->shows_growth; }
  void race_by(compare::Measure clock);
  void turn_racer(const std::string& entrant);                  ///< in or out
  std::vector<const compare::Entrant*> found_entrants() const;  ///< what is typed is in their names

  // --- A lesson that waits while its run is changed, or another method's is shown in its place
  bool lesson_waits = false;
  /// The next stop, or the previous one; from a changed run back to the lesson, and there. As Session::next_stop().
  bool next_stop(int direction);
  void turn_key_sheet();  ///< every key; from the start page, and back to it
  // --- What commands do
  /// Runs it, or says that it is not for a race.
  void run(const Command& command);
  /// To the next or previous unit; of a race's clock so many parts.
  void move(Unit unit, int direction);
  void go_to(std::int64_t position);  ///< of the race's clock while there is one
  void toggle_play();
  void change_speed(int direction);
  /// As Session::play().
  double play(double now);
  void open(Overlay overlay);  ///< over the drawer, which stays as it is
  Overlay overlay() const { return overlay_; }
  void open(Drawer drawer);  ///< in place of what it showed; takes overlays away
  Drawer drawer() const { return drawer_; }
  /// Whether keys that it has a use for are its own: from when it opens until a click elsewhere, and after a click in
  /// it.
  bool drawer_has_keys() const { return drawer_ != Drawer::none && overlay_ == Overlay::none && keys_in_drawer_; }
  bool drawer_is_beside() const { return drawer_at_.size.x < drawer_at_.size.y * 1.5f; }
  void set_dark(bool dark);
  void set_presenter(bool presenter);
  void turn_laboratory();  ///< from a lesson's layout to every pane, and back
  void set_reduced_motion(bool reduced);
  /// Which pane leads on the stage, by its id; empty: what the method has. The reader chooses it, until a stop of the
  /// lesson speaks that is about something else.
  std::string lead() const;
  void set_lead(const std::string& pane);
  /// Selects a pixel, and lets a pane lead, where they are given. Throws InputError where that cannot lead here.
  void look_at(std::optional<Trace::Pixel> pixel, const std::string& lead);
  /// Where what leads, the drawer and the timeline with the transport were drawn last; of no size where they were not.
  const Motion::Place& stage_place() const { return stage_at_; }
  const Motion::Place& drawer_place() const { return drawer_at_; }
  const Motion::Place& timeline_place() const { return timeline_at_; }
  void turn_lead(int direction);            ///< to the next pane that can lead, or the one before
  void scale_text(float factor);            ///< 0: back to the usual size
  std::string command_line() const;         ///< what opens this place, or this race
  std::optional<std::string> link() const;  ///< the same as a link; none where it is of a file
  /// Goes where a link says. False where the link opens something else than what is shown. Throws InputError.
  bool go_to_link(const std::string& link);
  std::string copied;                  ///< last, of what opens a place
  std::vector<std::string> opened_by;  ///< as in ViewerOptions; what command_line() begins with
  std::string typed;                   ///< in the field of a box
  void put(const std::string& text);   ///< in place of what is typed
  void draw_field(const std::string& hint);
  void draw_drawer_field(const std::string& hint);  ///< which is one while the keys are the drawer's
  int picked = 0;                                   ///< of what is found, and of an answer's rows
  const std::vector<Found>& found() { return finder_.find(*this); }
  void take_found(std::size_t row);
  Inquiry& inquiry() { return inquiry_; }
  std::string tables() const;  ///< that can be asked, by name
  bool scroll_to_picked = false;
  bool pick_among(std::size_t rows, SDL_Keycode code);  ///< ↑ ↓: the row before, or the next; false for another key
  void ask_typed();                                     ///< asks what is typed; again: goes where the picked row leads
  /// Set by who shows a window: asked while a question is at work whether a person ends it.
  std::function<bool()> ends_waiting;
  bool asking() const { return asking_ > 0; }
  void ask_now();
  void go_to_row(std::size_t row);
  void open_history();  ///< of the selected pixel, or the one at work
  const std::vector<answers::Visit>& history() const { return history_; }
  const answers::Visit& told_visit(std::size_t visit);  ///< with why
  Cell history_of() const { return history_of_; }
  void go_to_visit(std::size_t visit);
  /// With the link picked that tells of the number written so, if one is named.
  void open_explain(const answers::Question& question, const std::string& written = "");
  void explain_step();  ///< the main number of the step where the reader stands
  const answers::Chain& chain() const { return chain_; }
  void go_to_origin(std::size_t link);
  void copy_origin();  ///< the number of the picked link, all its digits
  // Why a polygon is not what is seen (drawer/why.cpp)
  void open_why();  ///< of the selected pixel, or the one at work, or of the whole picture where there is none
  void ask_why(std::int32_t polygon);
  void turn_why();                                   ///< from the pixel to the whole picture and back
  std::vector<std::int32_t> why_candidates() const;  ///< polygons whose label or number has what is typed
  const answers::Verdict& why() const { return why_; }
  /// Answers are of the whole run: what the pixel shows at this step, and what of the answer is still to come; empty at
  /// the end. `decides`: the step that does, 0 where none does.
  std::string at_this_step(std::optional<Cell> cell, std::int64_t decides) const;
  bool is_to_come(std::int64_t step) const { return step > session_.position(); }
  bool why_decides() const {
    return why_decides_;
  }  ///< whether the verdict's step decides it, and does not only begin work on something
  std::int32_t why_polygon() const { return why_polygon_; }
  std::optional<Cell> why_of() const { return why_anywhere_ ? std::nullopt : why_of_; }  ///< nullopt: the whole picture
  void go_to_link(std::size_t link);
  PixelOverlay& pixel_overlay() { return pixel_overlay_; }
  void turn_overlay(int direction);
  void end_painting();  ///< of anything over the frame
  void take_range();    ///< of depths, as typed
  Places& places() { return places_; }
  std::string wrong;  ///< with what is typed; said below it
  void run_until(const std::string& condition, Places::Way way);
  void keep_bookmark();  ///< here, by the name typed, or else by the step's number
  void go_to_bookmark(std::size_t place);
  void remove_bookmark(std::size_t place);
  void paint_answer();                ///< over the frame, or no longer
  places::Place place_typed() const;  ///< throws InputError where what is typed names none
  void go_to(const places::Place& place);
  void go_to_typed();  ///< "12041", "25 %", "polygon 3", "9, 17"; what is none of these stays, with what is wrong
  void take_settings(const Settings& settings);  ///< as another App was left
  void say(std::string message);
  // A film of what the window shows (app_film.cpp, film_overlay.cpp)
  void open_film();
  /// What is likely wanted as a film here, the likeliest first.
  std::vector<FilmRange> film_ranges() const;
  void film(std::int64_t first, std::int64_t last);  ///< begins it; each frame of the window makes more of it
  void film_typed();                                 ///< "300 420", or what is picked
  const Film* filming() const { return film_.get(); }
  // --- Embedded in a page of others: what leads and the transport, no title, no menus (app_embed.cpp)
  bool embedded() const { return settings_.embedded; }
  void end_embedding();
  std::string link_of_whole() const;  ///< to the same place, with everything; empty where there is none
  void end_film(std::string why);     ///< and leaves no file
  Board& board() { return board_; }
  const std::vector<HereLine>& here() const { return here_; }  ///< what the last right click offers
  void take_here(std::size_t line);
  /// The time, as a clock on the board counts it; seconds until what it shows changes, for who waits.
  double clock_time = 0;
  bool moves = false;   ///< panes and rows move to where they go, by that time; else they are there at once
  bool moving() const;  ///< and the next frame is another
  /// Something is done from frame to frame: the next one goes on with it, and is another.
  bool works() const;
  /// What changes without anybody's hand: by a clock, or by what was done beside.
  std::uint64_t moment();
  double until_clock() const { return board_.clock_runs() ? 1 : 1e9; }
  void make_black() { black_ = true; }  ///< until the next key or click, which does nothing else
  bool black() const { return black_; }
  bool has_causes() const { return findings_.has_value() || against_.has_value(); }
  void hold(const Command& command);  ///< what a key is held for, until the next key or click

  // --- Keys of what the drawer shows; false if they are none (drawer/drawer.hpp)
  bool pick_visit(SDL_Keycode code, unsigned modifiers);
  bool pick_candidate(SDL_Keycode code, unsigned modifiers);
  bool pick_link(SDL_Keycode code, unsigned modifiers);
  bool pick_origin(SDL_Keycode code, unsigned modifiers);
  bool edit_until(SDL_Keycode code, unsigned modifiers);
  bool edit_query(SDL_Keycode code, unsigned modifiers);
  bool name_typed(SDL_Keycode code, unsigned modifiers);
  bool pick_bookmark(SDL_Keycode code, unsigned modifiers);
  bool edit_range(SDL_Keycode code, unsigned modifiers);
  bool edit_compare(SDL_Keycode code, unsigned modifiers);
  bool pick_changeable(SDL_Keycode code, unsigned modifiers);

 private:
  void draw();
  void update_fonts();
  void begin_motion();
  void begin_arriving();
  const EdgeEnter* entering_edge() const;
  void draw_entering_edge();
  void begin_scrolling();
  void take_clicks();
  void take_vertex();
  void draw_title(ImVec2 at, ImVec2 size);
  void draw_panes(ImVec2 at, ImVec2 size);
  float pixel_on(ImVec2 stage, std::size_t leading) const;
  struct Docked {
    enum class Side { nowhere, beside, below } side = Side::nowhere;
    float room = 0;  ///< that the drawer takes of the width, or of the height
  };
  /// `size`: of all panes; `beside`, `below`: what the stage and the small panes have there before the drawer takes its
  /// part; so many panes lead.
  Docked docked(ImVec2 size, ImVec2 beside, ImVec2 below, std::size_t leading) const;
  void pull_drawer(const Docked& docked, ImVec2 size);
  void draw_pane(const Pane& pane, ImVec2 at, ImVec2 size) { draw_pane(ui_, pane, pane.title, at, size); }
  void draw_pane(Ui& ui, const Pane& pane, const std::string& title, ImVec2 at, ImVec2 size);
  void draw_panes_of_both(ImVec2 at, ImVec2 size);
  void share_look(Ui& beside) const;
  bool draw_beside(Ui& beside, const Pane& pane, const std::string& title, ImVec2 at, ImVec2 size);
  std::vector<std::string> opening_words() const;
  std::vector<std::string> place_words() const;  ///< the same with the place in it
  void draw_race(ImVec2 at, ImVec2 size);
  float draw_race_head(ImVec2 at, float width);
  void draw_racers(ImVec2 at, ImVec2 size);
  void draw_race_clock(ImVec2 at, float width);
  void draw_growth(ImVec2 at, ImVec2 size);
  std::vector<std::string> race_place() const;
  bool race_key(SDL_Keycode code, unsigned modifiers);
  void draw_of(bool first, const Pane& pane, ImVec2 at, ImVec2 size);
  void follow_marks();
  void mark_changed_pixels();
  void draw_column(ImVec2 at, ImVec2 size, const Pane& upper, const Pane& lower, float& share, const char* id);
  void draw_on_stage(const Pane& pane, ImVec2 at, ImVec2 size, bool leading);
  void draw_leading(const std::vector<Pane>& leading, ImVec2 at, ImVec2 size);
  void draw_small(std::vector<Pane> panes, ImVec2 at, ImVec2 size);
  void draw_folded(const std::vector<Pane>& panes, ImVec2 at, ImVec2 size);
  void draw_lesson_layout(ImVec2 at, ImVec2 size);
  std::vector<Ui*> runs_beside();
  void draw_runs_beside(ImVec2 at, ImVec2 first, ImVec2 second_at, ImVec2 second);
  void draw_words(std::vector<Pane> panes, ImVec2 at, ImVec2 size);
  std::vector<Pane> words_of_step();
  float frame_height(float width) const;
  void draw_embedded(ImVec2 at, ImVec2 size);
  std::string caption_title() const;
  std::string caption_sentence() const;
  void draw_slide();
  Drawing drawn(const Motion::Place& part);
  void point_nowhere();
  void draw_way_out(ImVec2 at, ImVec2 size);
  void draw_pane_body(Ui& ui, const Pane& pane, ImVec2 at, ImVec2 size);
  // Fingers (app_touch.cpp)
  bool handle_finger(const SDL_TouchFingerEvent& finger);
  bool scrolls_at(Touch::Point at);
  void take_acts(const std::vector<Touch::Act>& acts);
  ImVec2 aim(Touch::Point at) const;
  void act_by_fingers();
  // A window too small for all panes at once (app_small.cpp)
  bool too_small(ImVec2 panes) const;
  float small_row() const;
  void draw_small_window(ImVec2 size);
  void draw_small_title(ImVec2 at, ImVec2 size);
  void draw_menu_button(ImVec2 size);
  void draw_small_stage(ImVec2 at, ImVec2 names, ImVec2 size);
  void draw_small_words(ImVec2 at, ImVec2 names, ImVec2 size);
  std::string words_shown() const;
  std::optional<std::size_t> draw_names(const std::vector<Pane>& panes, std::size_t shown, ImVec2 at, ImVec2 size);
  bool splitter(const char* id, ImVec2 at, ImVec2 size, bool vertical, float& share, float whole);
  void draw_overlay();
  void draw_drawer();
  void take_keys_by_click();
  void follow_selected();
  bool key(const SDL_KeyboardEvent& event);
  bool typing() const;
  bool type(SDL_Keycode code, unsigned modifiers);
  /// A key of the overlay, or else of the drawer; false if it is none.
  bool key_of_box(SDL_Keycode code, unsigned modifiers);
  bool pick_found(SDL_Keycode code);
  bool pick_offer(SDL_Keycode code);
  bool pick_here(SDL_Keycode code);
  bool pick_racer(SDL_Keycode code);
  bool pick_setting(SDL_Keycode code);
  void follow_overlay();
  bool pick_film(SDL_Keycode code);
  void film_on();
  void back_from_film();
  bool handle_filming(const SDL_Event& event);
  void look_at_history(Cell cell);
  void pick_visit_before();
  void find_why();
  void ask_again(const App& before);

  struct Context {  // created before everything that uses Dear ImGui, destroyed after it
    Context();
    ~Context();
    ImGuiContext* context;
  };
  Context context_;
  Field field_;
  Settings settings_;
  Renderer renderer_;
  Session session_;
  Inquiry inquiry_;
  std::vector<HereLine> here_;
  ImVec2 here_at_{0, 0};
  int asking_ = 0;  ///< frames until the question that is typed is asked, so that one sees that it is
  Places places_;
  std::optional<Findings> findings_;
  std::optional<Against> against_;
  bool opens_at_cause_ = false;
  PixelOverlay pixel_overlay_;
  std::vector<answers::Visit> history_;
  Cell history_of_;
  std::optional<answers::FacetsNear> facets_near_;  ///< made when first needed
  answers::Verdict why_;
  bool why_decides_ = false;
  std::int32_t why_polygon_ = 0;
  std::optional<Cell> why_of_;
  std::optional<Cell> why_selected_;  ///< by the reader, before a why-not that picks its own pixel
  bool why_anywhere_ = false;
  answers::Chain chain_;
  Targets targets_;
  Touch touch_{[this](Touch::Point at) { return scrolls_at(at); }};
  std::deque<Touch::Act> acts_;  ///< what fingers did, until a frame has taken it
  ImVec2 finger_at_{0, 0};       ///< where the mouse stands for it
  bool zooms_ = false;           ///< the last frame took a wheel
  bool by_touch_ = false;        ///< the last that was done was done by a finger
  Ui ui_;
  std::unique_ptr<Ui> other_ui_;  ///< of the second run
  Motion motion_;
  std::int64_t rows_of_step_ = 0;              ///< whose rows' places are known
  int stop_before_ = -1, viewing_before_ = 0;  ///< a frame ago
  std::optional<Pane> only_;
  Motion::Place stage_at_, drawer_at_, timeline_at_;
  std::vector<Pane> leading_;           ///< there
  std::optional<Motion::Place> slide_;  ///< while one is drawn: its part of the window
  struct ChosenLead {
    std::string pane;  ///< empty: what the method has
    int stop;          ///< of the lesson, where it was chosen
  };
  std::optional<ChosenLead> chosen_lead_, lead_before_against_;
  std::optional<ChosenLead> chosen_words_;  ///< in a window too small for all panes
  std::function<std::vector<Offer>()> ask_for_offers_;
  std::vector<Offer> offers_;
  OwnFiles own_files_;
  Finder finder_;
  float dpi_scale_;
  float built_for_ = 0;
  Overlay overlay_ = Overlay::none;
  Drawer drawer_ = Drawer::none;
  bool keys_in_drawer_ = false;
  struct InDrawer {
    std::string typed, wrong;
    int picked = 0;
  };
  InDrawer under_overlay_;  ///< what is typed and picked in the drawer, while an overlay lies over it
  Board board_;
  std::unique_ptr<Film> film_;  ///< while one is made
  Changed changed_;
  std::vector<PixelMark> changed_here_;  ///< of its pixels those that are marked at this moment
  std::unique_ptr<BeforeChange> before_;
  std::unique_ptr<Ui> before_ui_;
  struct Beside {
    Beside(const Trace& trace, Renderer& renderer) : session(trace, nullptr), ui(session, renderer) {}
    Session session;
    Ui ui;
    std::int64_t of =
        -3;  ///< the step of the first run at whose moment it stands; −1: at its beginning, −2: at its end
  };
  std::vector<std::unique_ptr<Beside>> beside_;  ///< other runs, while a stop of the lesson shows their pictures
  std::string saved_scene_;                      ///< what was said of it; until the next change
  Race::RunBy run_by_;                           ///< none: nothing can be run from here
  struct RaceView {
    RaceView(const Trace& shown, Race::RunBy run_by) : race(shown, std::move(run_by)) {}
    Race race;
    GrowthChart growth;
    bool shows_growth = false;
    std::vector<std::unique_ptr<Ui>> looks;  ///< one a racer; none after others were chosen
  };
  std::unique_ptr<RaceView> race_;
  bool race_shown_ = false;
  bool keys_over_start_ = false;       ///< the sheet of keys lies where the start page was
  const Task* task_before_ = nullptr;  ///< of the lesson whose run this one changes
  std::size_t hints_given_ = 0;
  bool laboratory_ = false;  ///< a reader has asked for every pane
  bool black_ = false;
  bool clicker_ = false;     ///< what is picked on the start page was picked by a clicker's keys
  bool text_taken_ = false;  ///< the text of the key that went down last is not typed: a command was run by it
  const Command* held_ = nullptr;
};

/// Goes where `options` say, else to where the reader left it, else to the lesson's first stop. Throws InputError where
/// that cannot be.
void go_to_start(App& app, const ViewerOptions& options);

}  // namespace zstep::viewer
