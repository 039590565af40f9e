// Charts: where their marks stand, and that they need no window.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/charts/sheet.hpp"

using namespace zstep;

namespace {

struct Box {
  int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1, count = 0;
};

// Where a colour of the theme stands in a picture.
Box box_of(const Image& image, ImU32 color) {
  Box box;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* rgb = &image.rgb[static_cast<std::size_t>((y * image.width + x) * 3)];
      if (rgb[0] != (color & 255) || rgb[1] != (color >> 8 & 255) || rgb[2] != (color >> 16 & 255)) continue;
      box.left = std::min(box.left, x), box.right = std::max(box.right, x);
      box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y);
      ++box.count;
    }
  }
  return box;
}

DotChart dots(std::vector<ChartValue> values) {
  DotChart chart;
  chart.title = "A title";
  for (std::size_t k = 0; k < values.size(); ++k) chart.rows.push_back("row");
  chart.columns = {{"Column", "unit", std::move(values)}};
  return chart;
}

const viewer::Theme& theme = viewer::light_theme();

}  // namespace

TEST_SUITE("charts") {
  TEST_CASE("a logarithmic axis takes whole decades, evenly") {
    const viewer::LogAxis axis(0.02, 3000, 100, 700);
    CHECK(axis.first_decade() == -2);
    CHECK(axis.last_decade() == 4);
    CHECK(axis.at(0.01) == doctest::Approx(100));
    CHECK(axis.at(1) == doctest::Approx(300));
    CHECK(axis.at(10000) == doctest::Approx(700));
    CHECK(viewer::LogAxis(10, 10, 0, 1).last_decade() == 2);
  }

  TEST_CASE("decades as they are read") {
    CHECK(viewer::decade_text(0) == "1");
    CHECK(viewer::decade_text(2) == "100");
    CHECK(viewer::decade_text(-2) == "0.01");
    CHECK(viewer::decade_text(4) == "10 000");
    CHECK(viewer::decade_text(7) == "10\u2077");
    CHECK(viewer::decade_text(-12) == "10\u207b\u00b9\u00b2");
  }

  TEST_CASE("each decade moves a dot as far to the right") {
    const auto ink = [](double value) {
      return box_of(draw_chart(dots({{1, "", false}, {value, "", false}, {1000, "", false}})), theme.changed).count;
    };
    const int first = ink(10) - ink(1), second = ink(100) - ink(10), third = ink(1000) - ink(100);
    CHECK(second > 300);                   // a third of the axis
    CHECK(std::abs(first - second) < 25);  // but for the dot that covers the line's end
    CHECK(std::abs(third - second) < 25);
  }

  TEST_CASE("a warning is a cross of its own colour, and a row without a number is text") {
    CHECK(box_of(draw_chart(dots({{5, "five", false}})), theme.bad).count == 0);
    const Image warned = draw_chart(dots({{5, "five", true}}));
    CHECK(box_of(warned, theme.bad).count > 40);
    CHECK(box_of(warned, theme.changed).count == 0);
    const Image none = draw_chart(dots({{std::nan(""), "not within 60 s", false}}));
    CHECK(box_of(none, theme.changed).count == 0);
    CHECK(box_of(none, theme.bad).count > 40);
  }

  TEST_CASE("zero has a place, and charts without rows or lines are pictures, too") {
    CHECK(box_of(draw_chart(dots({{0, "0", false}})), theme.changed).count > 40);
    CHECK(draw_chart(DotChart{}).width == 1280);
    CHECK(draw_chart(LineChart{}).height == 720);
  }

  TEST_CASE("lines: what grows goes up, a dashed one has gaps, the same chart gives the same bytes") {
    LineChart chart;
    chart.x_ticks = {100, 2500, 60000};
    chart.lines = {{"a", {{100, 1}, {60000, 500}}, false, 0}};
    const Box solid = box_of(draw_chart(chart), theme.now);
    chart.lines[0].dashed = true;
    const Image dashed = draw_chart(chart);
    CHECK(box_of(dashed, theme.now).count < solid.count);
    CHECK(dashed == draw_chart(chart));
    CHECK(solid.right - solid.left > 800);
    CHECK(solid.bottom - solid.top > 400);
  }

  TEST_CASE("a mark's text stands beside the lines, and on none of them") {
    for (const double end : {500.0, -500.0}) {
      LineChart chart;
      chart.scale = LineChart::Scale::linear;
      chart.x_reach = {0, 40}, chart.y_reach = {std::min(end, 0.0), std::max(end, 0.0)};
      chart.lines = {{"a", {{0, 0}, {40, end}}, false, 3}};
      chart.now = {{{40, end}, ""}};
      const int alone = box_of(draw_chart(chart), theme.good).count;
      chart.now[0].text = "x = 39: a long word";
      CHECK(box_of(draw_chart(chart), theme.good).count == alone);
    }
  }

  TEST_CASE("as SVG: every text, escaped, every point's mark, and a line between each two") {
    LineChart chart;
    chart.title = "z < 4 & \"near\"";
    chart.x_ticks = {2500, 60000};
    for (const int look : {0, 1, 2, 3})
      chart.lines.push_back({"line " + std::to_string(look), {{100, 1 + look}, {2500, 7}, {60000, 500}}, false, look});
    const std::string svg = draw_chart(chart).svg;
    const auto count = [&](const std::string& word) {
      std::size_t found = 0;
      for (std::size_t at = svg.find(word); at != std::string::npos; at = svg.find(word, at + 1)) ++found;
      return found;
    };
    CHECK(svg.starts_with("<svg xmlns="));
    CHECK(svg.ends_with("</svg>\n"));
    CHECK(count("<svg") == 1);
    CHECK(count(">z &lt; 4 &amp; &quot;near&quot;</text>") == 1);
    for (const char* name : {">line 0<", ">line 1<", ">line 2<", ">line 3<", ">2 500<", ">60 000<"})
      CHECK(count(name) == 1);
    CHECK(count("<line ") == 8);
    CHECK(count("<circle ") == 3);
    CHECK(count("<polygon ") == 9);
    chart.lines.resize(1);
    chart.lines[0].dashed = true;
    CHECK(draw_chart(chart).svg.find("<circle ") != std::string::npos);
  }

  TEST_CASE("whoever was drawing with ImGui goes on") {
    ImGuiContext* mine = ImGui::CreateContext();
    ImGui::SetCurrentContext(mine);
    draw_chart(LineChart{});
    CHECK(ImGui::GetCurrentContext() == mine);
    ImGui::DestroyContext(mine);
  }
}
