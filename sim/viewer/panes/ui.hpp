// What every pane is given, and how panes draw text. A pane is a function of this; panes/pane.hpp lists them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "sim/answers/explain_value.hpp"
#include "sim/classroom/markdown.hpp"
#include "sim/viewer/draw/fonts.hpp"
#include "sim/viewer/draw/renderer.hpp"
#include "sim/viewer/draw/theme.hpp"
#include "sim/viewer/kept.hpp"
#include "sim/viewer/model/depth_errors.hpp"
#include "sim/viewer/model/findings.hpp"
#include "sim/viewer/model/inquiry.hpp"
#include "sim/viewer/model/label_spots.hpp"
#include "sim/viewer/model/outside.hpp"
#include "sim/viewer/model/places.hpp"
#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/model/session.hpp"
#include "sim/viewer/model/slice.hpp"
#include "sim/viewer/model/summary.hpp"
#include "sim/viewer/motion.hpp"
#include "sim/viewer/touch.hpp"

namespace zstep::viewer {

struct Command;

/// The pixels of a raster as a pane colours them.
struct Cells {
  std::vector<Pixel32> colors;
  std::vector<double> counts;  ///< where these are counts: pixels of the screen that cover several show the greatest
  int decimals = 0;            ///< that the numbers in them need
};

/// A chart as a pane shows it: lines and marks, and the words that are written over them.
struct ChartPicture {
  struct Word {
    ImVec2 at;
    ImU32 color;
    std::string text;
    bool first = false;  ///< what a lesson's stop names: before all others, around its place where that is taken
  };
  Canvas canvas;
  std::vector<Word> words;
};

/// A scene's polygons from outside, and where their letters go. The step changes nothing of it.
struct OutsideSeen {
  Picture polygons;
  std::vector<LabelSpot> letters;
};

/// A vertex that a hand holds, and where it was pulled to.
struct Taken {
  std::int32_t vertex = 0;
  glm::dvec3 place{0};  ///< in the room
  glm::dvec3 point{0};  ///< in the scene's space, as a round number
  bool moved = false;   ///< since it was taken
};

/// A line of what a right click offers where the mouse is: what is done first, then a command of the table, a question
/// or something to copy.
struct HereLine {
  std::string text;
  const char* command = "";
  std::function<void(Session&)> first = {};
  std::optional<answers::Question> asks = {};
  std::string asks_as = {};  ///< how the number that is asked about is written, where it is one of a formula's
  std::string copies = {};
};

/// Where rows of tables are on screen, by table and by what a click on them reports.
using RowPlaces = std::map<std::pair<std::string, int>, Motion::Place>;

/// A table as it was drawn, for who is read it.
struct TableSeen {
  struct Row {
    std::vector<std::string> cells;
    bool now = false;  ///< the step is about it
  };
  std::string title;  ///< of its pane
  std::vector<std::string> headings;
  std::vector<Row> rows;
};

struct Ui {
  Ui(Session& session_, Renderer& renderer_) : session(session_), renderer(renderer_) {}
  Session& session;
  Renderer& renderer;
  const Places* places = nullptr;
  const Findings* findings = nullptr;  ///< what check found, where it was asked
  StepMarks* marks = nullptr;          ///< the same, or where two runs part: on the timeline, and said of the step
  const std::vector<PixelMark>* pixel_marks = nullptr;
  Ui* other = nullptr;   ///< the second run's, where there is one
  Ui* before = nullptr;  ///< the run's before the last change, at the same moment; where that is known
  bool asks = true;      ///< a click on a number asks where it comes from; not in the second run
  Fonts fonts;
  const Theme* theme = &light_theme();
  std::vector<double> marked_depths;  ///< z_v that the stop marks beside whose run this one stands
  DepthScale depth_scale;
  DepthRange depth_range;
  HitCounts hits;
  ScanLineMarks lines;
  CurveMarks curves;
  RowMarks rows;
  SliceLines slices;
  DepthErrors errors;
  RasterView view;
  Look look;                         ///< from where the scene is seen from outside
  std::optional<bool> from_outside;  ///< as the reader chose, or else as it suits the method
  struct ChosenViewing {
    int step, stop;
  };
  std::optional<ChosenViewing> chosen_viewing;  ///< T_1 … T_4, or 0, by the reader at that stop of the lesson
  std::optional<HeatMap> heat;                  ///< painted over the frame
  std::string heat_behind;                      ///< how far it is from being counted, or nothing
  enum class RangeMode : std::uint8_t { whole, fitted, by_hand };
  RangeMode range_mode = RangeMode::whole;  ///< of the depth buffer's colours
  DepthRange hand_range;
  bool histogram = false;             ///< of depths, below the depth buffer
  bool relief = false;                ///< the depth buffer as a surface in space
  Look relief_look;                   ///< from where it is seen
  RowPlaces row_places, rows_before;  ///< in this frame, and when the step before was drawn last
  double arrived = 1;       ///< how far what the last step forwards did has come: from 0 to 1, where nothing moves
  bool axes_turn = false;   ///< that step was one of viewing
  bool on_its_way = false;  ///< something in this frame is
  /// How far this has come, which is drawn on its way.
  double on_way() {
    if (arrived < 1) on_its_way = true;
    return arrived;
  }
  KeptThings<Cells> cells;  ///< by pane
  KeptThings<ChartPicture> charts;
  KeptThings<Canvas> canvases, canvases_before;  ///< by what is painted there; as they were before that step
  KeptThings<Room> rooms;
  KeptThings<OutsideSeen> seen_from_outside;
  KeptThings<std::vector<LabelSpot>> spots;
  float em = 16;   ///< body text in pixels
  float thin = 1;  ///< pixels of a thin line: more than one on a large screen
  bool presenter = false;
  bool still = false;      ///< of a run's picture, at which nothing is at work any more
  bool laboratory = true;  ///< all panes; else a lesson's layout: what leads, and few words
  struct TextHeight {
    float height = 0;
    std::uint64_t moment = 0;     ///< and layout, at which it was measured
    std::vector<float> spared{};  ///< heights of lines that can give way, in the order in which they do
    std::size_t gone = 0;         ///< so many of these have done so
    /// Lets them go until the rest, of this height, has room.
    float fit(float room) {
      float left = height;
      for (gone = 0; gone < spared.size() && left > room;) left -= spared[gone++];
      return left;
    }
  };
  float given_way = 0;                             ///< how high what the pane that was drawn last has left out is
  std::map<std::string, TextHeight> text_heights;  ///< of wrapped panes, as they were drawn last
  bool whole_code = false;                         ///< no line of the pseudo-code is folded
  bool vertices_always = false;                    ///< the way of the vertices is shown even where room is scarce
  std::optional<Cell> pointed;                     ///< cell under the mouse, in either buffer
  std::optional<Cell> pointed_next;                ///< collected while this frame is drawn
  std::optional<std::int32_t> hovered_edge_next;
  ScenePart hovered_part_next;
  std::map<std::string, bool> overflows;  ///< by wrapped child: its text is longer than it is high
  std::uint64_t scroll_follows = 0;  ///< the moment and the layout for which panes have scrolled to what is at work
  int scroll_frames = 0;             ///< frames until they have: a scroll bar that comes wraps lines anew
  bool scroll_now = false;           ///< this frame they must
  std::uint64_t speaks_follows =
      0;  ///< the same for the lesson, which stays where it was scrolled to until another stop speaks
  int speaks_frames = 0;
  bool speaks_now = false;
  std::optional<answers::Question> asked;  ///< the number that was clicked in this frame
  bool changes = false;                    ///< vertices can be taken hold of where they are seen
  std::optional<Taken> taken;              ///< the vertex that a hand holds
  bool moved_vertex = false;               ///< in this frame, to where `taken` says
  std::vector<HereLine> here;              ///< what a right click in this frame offers
  const Command* clicked = nullptr;        ///< the command whose button was clicked in this frame
  std::string asked_as;                    ///< how it is written there, where it is one of a formula's
  bool reads = false;  ///< the keys are at work, and the mouse lies where it was left: nothing may pop up at it
  std::vector<TableSeen>* tables_seen = nullptr;  ///< where they are put while a frame is drawn
  std::string mouse_help;                         ///< what the mouse does here, for the bottom line
  Targets* targets = nullptr;                     ///< what a finger can hit is told there while a frame is drawn
  float least_target = 0;  ///< how wide and high what is hit should be: for fingers and in small windows, else 0

  std::uint64_t read_now() const { return scroll_follows ^ speaks_follows; }  ///< for text_heights
  const Theme& colors() const { return *theme; }
  Moment moment() const { return Moment(session); }
  float line() const { return em * 1.3f; }
};

/// Colours, edges and distances of what Dear ImGui draws itself, in the current context.
void apply_style(const Ui& ui);

// --- Text. All of it goes through Fonts::drawable. Sizes in pixels.

ImVec2 text_size(const Ui& ui, const ImFont* font, const std::string& text);
/// At a place on screen, one line, no wrapping.
void draw_text(const Ui& ui, ImVec2 at, const ImFont* font, ImU32 color, const std::string& text);

/// The same for names in a picture, "x_L = 4.67": what stands behind the "_" of a letter is set below it.
ImVec2 label_size(const Ui& ui, const ImFont* font, const std::string& text);
void draw_label(const Ui& ui, ImVec2 at, const ImFont* font, ImU32 color, const std::string& text);

struct Flow {
  ImU32 color = 0;
  float indent = 0;              ///< of every line but the first
  const ImFont* font = nullptr;  ///< of plain runs; body text by default
  float width = 0;               ///< 0: to the right edge of the pane
  /// Called for each number in the text: how it is written, and between which corners.
  std::function<void(const std::string& number, ImVec2 a, ImVec2 b)> on_number = {};
};
/// Words at the cursor, wrapped; advances the cursor. Words too long for a line are broken.
void flow(Ui& ui, const std::vector<TextRun>& runs, const Flow& how);
void flow(Ui& ui, const std::string& text, const Flow& how);
/// Height that flow() would take.
float flow_height(Ui& ui, const std::string& text, const Flow& how);
/// A lesson's Markdown.
void flow_markdown(Ui& ui, const std::string& markdown);
/// A sentence in muted colour: why a pane is empty.
void say_empty(Ui& ui, const std::string& why);

/// Scrolls the pane so that the line at `top` (on screen) can be read with what follows it. Where it scrolls to depends
/// on the line alone, never on where the pane was: the same step always looks the same. Does so when the step or the
/// layout changed.
void follow(Ui& ui, float top, float height);
/// A child window of text that is wrapped. The place of its scroll bar is kept free: where a bar came and went, it
/// would wrap lines anew, and whether it is needed would depend on whether it was there before. Ends with
/// ImGui::EndChild().
bool begin_wrapped(Ui& ui, const char* id, ImVec2 size, ImGuiWindowFlags flags);
/// The rest of a pane as a part that scrolls by itself; ends with ImGui::EndChild().
void begin_part(Ui& ui, const char* id);
/// Where follow() scrolls to for a line at `at` in what is scrolled, in a pane that shows `view` of it: all of the line
/// is seen.
float scroll_for(float at, float height, float view);

/// A frame of whole pixels, inside these corners; `thickness` in thin lines.
void frame_box(const Ui& ui, ImVec2 a, ImVec2 b, ImU32 color, float thickness = 1);

/// What stands between these corners is a number that can be asked about: under the mouse it is underlined, a click
/// puts the question into `asked`, a right click offers it. `written`: how it is written there, where it is one of a
/// formula's; it can then be copied, too. True under the mouse: whatever else a click does there must then give way.
bool number_at(Ui& ui, ImVec2 a, ImVec2 b, const answers::Question& question, const std::string& written = "");

/// The sign of what is wrong in front of a name: "!" where it is wrong itself, "\u2190" where it follows from that.
std::string with_sign(Findings::Trust trust, const std::string& name);
/// How far what a place holds now can be trusted.
Findings::Trust trust_of(const Ui& ui, formulas::Place::In in, std::int64_t number);

/// A button with a label that fits; true when clicked.
bool button(Ui& ui, const std::string& label, bool lit = false, bool enabled = true);
/// The same, as high as a finger needs it where fingers are at work.
bool tall_button(Ui& ui, const std::string& label, bool lit = false, bool enabled = true);
/// The same of this size, its label in the middle.
bool button_of(Ui& ui, const std::string& label, ImVec2 size, bool lit = false, bool enabled = true);
/// What lies between these corners can be hit, as far as the window shows it.
void can_be_hit(Ui& ui, ImVec2 a, ImVec2 b);
/// A small window beside the mouse, or at this place, with these lines.
void tooltip(Ui& ui, const std::vector<std::string>& lines, std::optional<ImVec2> at = {});

}  // namespace zstep::viewer
