// The buffers and their pixels. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

// clang-format off

struct BuffersClear { double z; };
struct DepthInterpolate { std::int32_t x, y; double z; };
struct DepthCompare { std::int32_t x, y; double z; bool nearer; };
struct DepthWrite { std::int32_t x, y; double z; };
struct PixelWrite { std::int32_t x, y, polygon; };
struct AttributeInterpolate { std::int32_t x, y; double over_z, one_over_z, attribute; };

// clang-format on

template <>
inline constexpr KindText kind_text<BuffersClear>{"buffers_clear",
                                                  "the frame becomes background, every depth becomes z"};
template <>
inline constexpr auto fields_of<BuffersClear> =
    Fields{Field{"z", &BuffersClear::z, "depth", "the depth that means nothing was drawn"}};

template <>
inline constexpr KindText kind_text<DepthInterpolate>{"depth_interpolate", "the polygon's depth at a pixel"};
template <>
inline constexpr auto fields_of<DepthInterpolate> = Fields{
    Field{"x", &DepthInterpolate::x, "px", "column", Guess::next}, Field{"y", &DepthInterpolate::y, "px", "row"},
    Field{"z", &DepthInterpolate::z, "depth", "depth of the polygon at the pixel's centre", Guess::formula}};

template <>
inline constexpr KindText kind_text<DepthCompare>{"depth_compare", "a new depth is held against the stored one"};
template <>
inline constexpr auto fields_of<DepthCompare> =
    Fields{Field{"x", &DepthCompare::x, "px", "column"}, Field{"y", &DepthCompare::y, "px", "row"},
               Field{"z", &DepthCompare::z, "depth", "the new depth"},
               Field{"nearer", &DepthCompare::nearer, "1",
                     "it wins: smaller than the stored one, or greater, or also equal, as the trace declares"}};

template <>
inline constexpr KindText kind_text<DepthWrite>{"depth_write", "the depth buffer takes a depth"};
template <>
inline constexpr auto fields_of<DepthWrite> =
    Fields{Field{"x", &DepthWrite::x, "px", "column"}, Field{"y", &DepthWrite::y, "px", "row"},
               Field{"z", &DepthWrite::z, "depth", "the depth stored"}};

template <>
inline constexpr KindText kind_text<PixelWrite>{"pixel_write", "the framebuffer takes a polygon's colour"};
template <>
inline constexpr auto fields_of<PixelWrite> =
    Fields{Field{"x", &PixelWrite::x, "px", "column"}, Field{"y", &PixelWrite::y, "px", "row"},
               Field{"polygon", &PixelWrite::polygon, "index", "the polygon whose colour is stored"}};

template <>
inline constexpr KindText kind_text<AttributeInterpolate>{"attribute_interpolate",
                                                          "the attribute of a polygon's vertices at a pixel"};
template <>
inline constexpr auto fields_of<AttributeInterpolate> =
    Fields{Field{"x", &AttributeInterpolate::x, "px", "column"}, Field{"y", &AttributeInterpolate::y, "px", "row"},
           Field{"over_z", &AttributeInterpolate::over_z, "1", "a/z_v, interpolated; a itself where that is"},
           Field{"one_over_z", &AttributeInterpolate::one_over_z, "1", "1/z_v, interpolated; 1 where a itself is"},
           Field{"attribute", &AttributeInterpolate::attribute, "1", "a: their quotient"}};

// --- Without a compare, in colours of their own, in two passes

enum class Pass : std::uint8_t { eye, light };

template <>
inline constexpr std::array<std::string_view, 2> words_of<Pass>{"eye", "light"};

// clang-format off

struct PixelPaint { std::int32_t x, y; double z; std::int32_t polygon; };
struct ColorWrite { std::int32_t x, y, r8, g8, b8; };
struct ColorBlend { std::int32_t x, y, polygon; double opacity; std::int32_t r8, g8, b8; };
struct PassBegin { Pass pass; };
struct ShadowCompare { std::int32_t x, y; double x_light, y_light, z_light; bool lit; };

// clang-format on

template <>
inline constexpr KindText kind_text<PixelPaint>{"pixel_paint",
                                                "the frame takes a polygon's colour without a compare; its depth is "
                                                "kept beside it, so that methods can be compared"};
template <>
inline constexpr auto fields_of<PixelPaint> =
    Fields{Field{"x", &PixelPaint::x, "px", "column", Guess::next}, Field{"y", &PixelPaint::y, "px", "row"},
               Field{"z", &PixelPaint::z, "depth", "depth of the polygon at the pixel's centre", Guess::formula},
               Field{"polygon", &PixelPaint::polygon, "index", "the polygon whose colour is stored"}};

template <>
inline constexpr KindText kind_text<ColorWrite>{"color_write", "the frame takes a colour that is not a polygon's own"};
template <>
inline constexpr auto fields_of<ColorWrite> =
    Fields{Field{"x", &ColorWrite::x, "px", "column"}, Field{"y", &ColorWrite::y, "px", "row"},
               Field{"r8", &ColorWrite::r8, "1", "red, 0 to 255"}, Field{"g8", &ColorWrite::g8, "1", "green"},
               Field{"b8", &ColorWrite::b8, "1", "blue"}};

template <>
inline constexpr KindText kind_text<ColorBlend>{
    "color_blend",
    "a polygon's colour is laid over the frame's: opacity * its colour + (1 - opacity) * what was there"};
template <>
inline constexpr auto fields_of<ColorBlend> =
    Fields{Field{"x", &ColorBlend::x, "px", "column"},
               Field{"y", &ColorBlend::y, "px", "row"},
               Field{"polygon", &ColorBlend::polygon, "index", "the polygon"},
               Field{"opacity", &ColorBlend::opacity, "1", "0 to 1"},
               Field{"r8", &ColorBlend::r8, "1", "red that results, 0 to 255"},
               Field{"g8", &ColorBlend::g8, "1", "green"},
               Field{"b8", &ColorBlend::b8, "1", "blue"}};

template <>
inline constexpr KindText kind_text<PassBegin>{
    "pass_begin", "the scene is drawn as the eye or as the light sees it; the buffers are that one's from here on"};
template <>
inline constexpr auto fields_of<PassBegin> = Fields{Field{"pass", &PassBegin::pass, "1", "whose"}};

template <>
inline constexpr KindText kind_text<ShadowCompare>{"shadow_compare",
                                                   "a point that the eye sees is held against the shadow buffer"};
template <>
inline constexpr auto fields_of<ShadowCompare> =
    Fields{Field{"x", &ShadowCompare::x, "px", "column of the eye's picture"},
               Field{"y", &ShadowCompare::y, "px", "its row"},
               Field{"x_light", &ShadowCompare::x_light, "px", "column in the light's picture, not rounded"},
               Field{"y_light", &ShadowCompare::y_light, "px", "row there"},
               Field{"z_light", &ShadowCompare::z_light, "depth", "depth of the point as the light sees it"},
               Field{"lit", &ShadowCompare::lit, "1", "nothing lies before it"}};

}  // namespace zstep
