#include "sim/viewer/field.hpp"

#include <algorithm>
#include <cmath>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/lists.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

/// The keys that a line of text needs; none for others.
std::optional<ImGuiKey> key_of(SDL_Keycode code) {
  switch (code) {
    case SDLK_LEFT:
      return ImGuiKey_LeftArrow;
    case SDLK_RIGHT:
      return ImGuiKey_RightArrow;
    case SDLK_HOME:
      return ImGuiKey_Home;
    case SDLK_END:
      return ImGuiKey_End;
    case SDLK_DELETE:
      return ImGuiKey_Delete;
    case SDLK_BACKSPACE:
      return ImGuiKey_Backspace;
    case SDLK_INSERT:
      return ImGuiKey_Insert;
    case SDLK_a:
      return ImGuiKey_A;
    case SDLK_c:
      return ImGuiKey_C;
    case SDLK_v:
      return ImGuiKey_V;
    case SDLK_x:
      return ImGuiKey_X;
    case SDLK_y:
      return ImGuiKey_Y;
    case SDLK_z:
      return ImGuiKey_Z;
    default:
      return std::nullopt;
  }
}

void set_modifiers(unsigned modifiers) {
  ImGuiIO& io = ImGui::GetIO();
  const bool ctrl = (modifiers & Chord::ctrl) != 0, shift = (modifiers & Chord::shift) != 0;
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(io.ConfigMacOSXBehaviors ? ImGuiMod_Super : ImGuiMod_Ctrl, ctrl);
  io.AddKeyEvent(ImGuiMod_Shift, shift);
#else
  (io.ConfigMacOSXBehaviors ? io.KeySuper : io.KeyCtrl) = ctrl;
  io.KeyShift = shift;
#endif
}

void set_key(ImGuiKey key, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(key, down);
#else
  ImGui::GetIO().KeysDown[key] = down;
#endif
}

}  // namespace

std::vector<std::string> in_text_events(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    std::size_t end = std::min<std::size_t>(text.size(), SDL_TEXTINPUTEVENT_TEXT_SIZE - 1);
    while (end < text.size() && end > 0 && continues_character(text[end])) --end;
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return parts;
}

/// One line: what parts lines or columns elsewhere is a space here.
const char* Field::paste(Field& field) {
  if (SDL_WasInit(SDL_INIT_VIDEO)) {
    char* text = SDL_GetClipboardText();
    field.clipboard_ = text ? text : "";
    SDL_free(text);
  }
  for (char& c : field.clipboard_)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return field.clipboard_.c_str();
}

void Field::copy(Field& field, const char* text) {
  field.clipboard_ = text;
  if (SDL_WasInit(SDL_INIT_VIDEO)) SDL_SetClipboardText(text);
}

void Field::connect() {
#if IMGUI_VERSION_NUM >= 19110
  ImGuiPlatformIO& io = ImGui::GetPlatformIO();
  io.Platform_ClipboardUserData = this;
  io.Platform_GetClipboardTextFn = [](ImGuiContext*) {
    return paste(*static_cast<Field*>(ImGui::GetPlatformIO().Platform_ClipboardUserData));
  };
  io.Platform_SetClipboardTextFn = [](ImGuiContext*, const char* text) {
    copy(*static_cast<Field*>(ImGui::GetPlatformIO().Platform_ClipboardUserData), text);
  };
#else
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = this;
  io.GetClipboardTextFn = [](void* field) { return paste(*static_cast<Field*>(field)); };
  io.SetClipboardTextFn = [](void* field, const char* text) { copy(*static_cast<Field*>(field), text); };
#endif
#if IMGUI_VERSION_NUM < 18700
  for (int key = 0; key < ImGuiKey_COUNT; ++key) ImGui::GetIO().KeyMap[key] = key;
#endif
}

bool Field::takes(SDL_Keycode code, unsigned modifiers) {
  switch (code) {
    case SDLK_LEFT:
    case SDLK_RIGHT:
    case SDLK_HOME:
    case SDLK_END:
    case SDLK_DELETE:
    case SDLK_BACKSPACE:
    case SDLK_INSERT:
      return true;
    default:
      break;
  }
  if ((modifiers & Chord::ctrl) != 0) return key_of(code).has_value();
  return code >= SDLK_SPACE && (code & SDLK_SCANCODE_MASK) == 0;  // a letter; its text comes by itself
}

void Field::press(SDL_Keycode code, unsigned modifiers) {
  const auto key = key_of(code);
  const bool letter = code >= SDLK_SPACE && code < SDLK_DELETE;
  if (!key || (letter && (modifiers & Chord::ctrl) == 0)) return;
  set_modifiers(modifiers);
  set_key(*key, true);
  down_ = key;
}

void Field::after_frame() {
  if (!down_) return;
  set_key(*down_, false);
  set_modifiers(0);
  down_.reset();
}

int Field::on_event(ImGuiInputTextCallbackData* data) {
  Field& field = *static_cast<Field*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
    field.typed_->resize(static_cast<std::size_t>(data->BufTextLen));
    data->Buf = field.typed_->data();
  } else if (field.put_) {
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, field.put_->c_str());
    data->ClearSelection();
    field.put_.reset();
  }
  return 0;
}

void Field::draw_idle(Ui& ui, const std::string& typed, const std::string& hint) {
  const Theme& c = ui.colors();
  const ImVec2 at = ImGui::GetCursorScreenPos(), pad{std::round(ui.em * 0.4f), std::round(ui.em * 0.3f)};
  const ImVec2 end{at.x + std::max(1.0f, ImGui::GetContentRegionAvail().x), at.y + ui.fonts.text->FontSize + 2 * pad.y};
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, c.head);
  ImGui::PushClipRect({at.x + pad.x, at.y}, {end.x - pad.x, end.y}, true);
  draw_text(ui, {at.x + pad.x, at.y + pad.y}, ui.fonts.text, typed.empty() ? c.muted : c.text,
            fitted(ui, ui.fonts.text, typed.empty() ? hint : typed, end.x - at.x - 2 * pad.x));
  ImGui::PopClipRect();
  frame_box(ui, at, end, c.rule);
  ImGui::Dummy({1, end.y - at.y + std::round(ui.em * 0.3f)});
}

bool Field::draw(App& app, const std::string& hint) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  typed_ = &app.typed;
  const bool held = ImGui::IsAnyItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);  // a list that is dragged
  if (!active_ && !held) ImGui::SetKeyboardFocusHere();
  ImGui::PushFont(ui.fonts.text);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {std::round(ui.em * 0.4f), std::round(ui.em * 0.3f)});
  ImGui::PushStyleColor(ImGuiCol_FrameBg, c.head);
  ImGui::PushStyleColor(ImGuiCol_TextSelectedBg, c.now_soft);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, c.muted);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const bool replaced = put_.has_value();
  const bool changed =
      ImGui::InputTextWithHint("##typed", ui.fonts.drawable(hint).c_str(), app.typed.data(), app.typed.capacity() + 1,
                               ImGuiInputTextFlags_CallbackResize | ImGuiInputTextFlags_CallbackAlways, on_event, this);
  active_ = ImGui::IsItemActive();
  ImGui::PopStyleColor(3);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  place_ = {low.x, low.y, high.x, high.y};
  can_be_hit(ui, low, high);
  frame_box(ui, low, high, c.now);
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
  return changed && !replaced;
}

}  // namespace zstep::viewer
