// How Dear ImGui draws what it draws itself.
#include <cmath>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {
namespace {

ImVec4 to_vec4(ImU32 c) { return ImGui::ColorConvertU32ToFloat4(c); }

}  // namespace

void apply_style(const Ui& ui) {
  const Theme& c = ui.colors();
  ImGuiStyle& style = ImGui::GetStyle();
  // Straight edges only: the software renderer draws rectangles by blitting, and triangles one pixel at a time.
  style.AntiAliasedLines = style.AntiAliasedLinesUseTex = style.AntiAliasedFill = false;
  style.WindowRounding = style.ChildRounding = style.FrameRounding = style.PopupRounding = style.ScrollbarRounding =
      style.GrabRounding = 0;
  style.WindowBorderSize = style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowMinSize = {1, 1};
  style.ScrollbarSize = std::round(ui.em * 0.6f);
  style.GrabMinSize = std::round(ui.em * 0.75f);  // which versions of Dear ImGui have otherwise
  style.WindowPadding = {std::round(ui.em * 0.5f), std::round(ui.em * 0.35f)};
  style.ItemSpacing = {std::round(ui.em * 0.4f), 0};
  style.Colors[ImGuiCol_Text] = to_vec4(c.text);
  style.Colors[ImGuiCol_WindowBg] = to_vec4(c.window);
  style.Colors[ImGuiCol_ChildBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_PopupBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_Border] = to_vec4(c.rule);
  style.Colors[ImGuiCol_ScrollbarBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_ScrollbarGrab] = to_vec4(c.rule);
  style.Colors[ImGuiCol_ScrollbarGrabHovered] = style.Colors[ImGuiCol_ScrollbarGrabActive] = to_vec4(c.muted);
}

}  // namespace zstep::viewer
