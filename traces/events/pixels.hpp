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
inline constexpr Description description_of<BuffersClear>{
    .name = "buffers_clear",
    .meaning = "the frame becomes background, every depth becomes z",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<BuffersClear> =
    Fields{Field{"z", &BuffersClear::z, "depth", "the depth that means nothing was drawn", As::formula}};

template <>
inline constexpr Description description_of<DepthInterpolate>{.name = "depth_interpolate",
                                                              .meaning = "the polygon's depth at a pixel",
                                                              .work = WorkKind::depths,
                                                              .called = "depth at x = {x} on the span",
                                                              .within = Within::polygon,
                                                              .at_pixel = AtPixel::depth};
template <>
inline constexpr auto fields_of<DepthInterpolate> =
    Fields{Field{"x", &DepthInterpolate::x, Measure::column, "column", As::subject, Guess::next},
           Field{"y", &DepthInterpolate::y, Measure::pixel_row, "row", As::subject},
           Field{"z", &DepthInterpolate::z, "depth", "depth of the polygon at the pixel's centre", As::formula,
                 Guess::formula}};

template <>
inline constexpr Description description_of<DepthCompare>{.name = "depth_compare",
                                                          .meaning = "a new depth is held against the stored one",
                                                          .work = WorkKind::compares,
                                                          .called = "compare at pixel ({x}, {y})",
                                                          .within = Within::polygon,
                                                          .at_pixel = AtPixel::depth | AtPixel::verdict};
template <>
inline constexpr auto fields_of<DepthCompare> = Fields{
    Field{"x", &DepthCompare::x, Measure::column, "column", As::subject},
    Field{"y", &DepthCompare::y, Measure::pixel_row, "row", As::subject},
    Field{"z", &DepthCompare::z, "depth", "the new depth", As::formula},
    Field{"nearer", &DepthCompare::nearer, "1",
          "it wins: smaller than the stored one, or greater, or also equal, as the trace declares", As::formula}};

template <>
inline constexpr Description description_of<DepthWrite>{.name = "depth_write",
                                                        .meaning = "the depth buffer takes a depth",
                                                        .work = WorkKind::writes,
                                                        .called = "depth written at pixel ({x}, {y})",
                                                        .within = Within::polygon,
                                                        .at_pixel = AtPixel::keeps};
template <>
inline constexpr auto fields_of<DepthWrite> =
    Fields{Field{"x", &DepthWrite::x, Measure::column, "column", As::subject},
           Field{"y", &DepthWrite::y, Measure::pixel_row, "row", As::subject},
           Field{"z", &DepthWrite::z, "depth", "the depth stored", As::formula}};

template <>
inline constexpr Description description_of<PixelWrite>{.name = "pixel_write",
                                                        .meaning = "the framebuffer takes a polygon's colour",
                                                        .work = WorkKind::writes,
                                                        .within = Within::polygon,
                                                        .at_pixel = AtPixel::colors};
template <>
inline constexpr auto fields_of<PixelWrite> =
    Fields{Field{"x", &PixelWrite::x, Measure::column, "column", As::subject},
           Field{"y", &PixelWrite::y, Measure::pixel_row, "row", As::subject},
           Field{"polygon", &PixelWrite::polygon, Measure::polygon, "the polygon whose colour is stored", As::formula}};

template <>
inline constexpr Description description_of<AttributeInterpolate>{
    .name = "attribute_interpolate",
    .meaning = "the attribute of a polygon's vertices at a pixel",
    .work = WorkKind::depths,
    .called = "attribute at pixel ({x}, {y})",
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<AttributeInterpolate> = Fields{
    Field{"x", &AttributeInterpolate::x, Measure::column, "column", As::subject},
    Field{"y", &AttributeInterpolate::y, Measure::pixel_row, "row", As::subject},
    Field{"over_z", &AttributeInterpolate::over_z, "1", "a/z_v, interpolated; a itself where that is", As::formula},
    Field{"one_over_z", &AttributeInterpolate::one_over_z, "1", "1/z_v, interpolated; 1 where a itself is",
          As::formula},
    Field{"attribute", &AttributeInterpolate::attribute, "1", "a: their quotient", As::formula}};

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
struct ShadowBias { std::int32_t x, y; double dz_dx_light, dz_dy_light, bias; };
struct ShadowNeighbour { std::int32_t x, y, x_shadow, y_shadow; bool lit; };
struct LightShare { std::int32_t x, y; double share; };

// clang-format on

template <>
inline constexpr Description description_of<PixelPaint>{.name = "pixel_paint",
                                                        .meaning =
                                                            "the frame takes a polygon's colour without a compare; its "
                                                            "depth is kept beside it, so that methods can be compared",
                                                        .work = WorkKind::writes,
                                                        .called = "pixel ({x}, {y}) painted with {polygon}",
                                                        .within = Within::polygon,
                                                        .at_pixel = AtPixel::depth | AtPixel::keeps | AtPixel::colors};
template <>
inline constexpr auto fields_of<PixelPaint> = Fields{
    Field{"x", &PixelPaint::x, Measure::column, "column", As::subject, Guess::next},
    Field{"y", &PixelPaint::y, Measure::pixel_row, "row", As::subject},
    Field{"z", &PixelPaint::z, "depth", "depth of the polygon at the pixel's centre", As::formula, Guess::formula},
    Field{"polygon", &PixelPaint::polygon, Measure::polygon, "the polygon whose colour is stored", As::formula}};

template <>
inline constexpr Description description_of<ColorWrite>{
    .name = "color_write",
    .meaning = "the frame takes a colour that is not a polygon's own",
    .work = WorkKind::writes,
    .within = Within::curve};
template <>
inline constexpr auto fields_of<ColorWrite> =
    Fields{Field{"x", &ColorWrite::x, Measure::column, "column", As::subject},
           Field{"y", &ColorWrite::y, Measure::pixel_row, "row", As::subject},
           Field{"r8", &ColorWrite::r8, Measure::shade, "red, 0 to 255", As::formula},
           Field{"g8", &ColorWrite::g8, Measure::shade, "green", As::formula},
           Field{"b8", &ColorWrite::b8, Measure::shade, "blue", As::formula}};

template <>
inline constexpr Description description_of<ColorBlend>{
    .name = "color_blend",
    .meaning = "a polygon's colour is laid over the frame's: opacity * its colour + (1 - opacity) * what was there",
    .work = WorkKind::writes};
template <>
inline constexpr auto fields_of<ColorBlend> =
    Fields{Field{"x", &ColorBlend::x, Measure::column, "column", As::subject},
           Field{"y", &ColorBlend::y, Measure::pixel_row, "row", As::subject},
           Field{"polygon", &ColorBlend::polygon, Measure::polygon, "the polygon", As::formula | As::subject},
           Field{"opacity", &ColorBlend::opacity, "1", "0 to 1", As::formula},
           Field{"r8", &ColorBlend::r8, Measure::shade, "red that results, 0 to 255", As::formula},
           Field{"g8", &ColorBlend::g8, Measure::shade, "green", As::formula},
           Field{"b8", &ColorBlend::b8, Measure::shade, "blue", As::formula}};

template <>
inline constexpr Description description_of<PassBegin>{
    .name = "pass_begin",
    .meaning = "the scene is drawn as the eye or as the light sees it; the buffers are that one's from here on",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<PassBegin> = Fields{Field{"pass", &PassBegin::pass, "1", "whose", As::subject}};

template <>
inline constexpr Description description_of<ShadowCompare>{
    .name = "shadow_compare",
    .meaning = "a point that the eye sees is held against the shadow buffer",
    .work = WorkKind::compares,
    .called = "pixel ({x}, {y}) as the light sees it"};
template <>
inline constexpr auto fields_of<ShadowCompare> =
    Fields{Field{"x", &ShadowCompare::x, Measure::column, "column of the eye's picture", As::subject},
           Field{"y", &ShadowCompare::y, Measure::pixel_row, "its row", As::subject},
           Field{"x_light", &ShadowCompare::x_light, "px", "column in the light's picture, not rounded", As::formula},
           Field{"y_light", &ShadowCompare::y_light, "px", "row there", As::formula},
           Field{"z_light", &ShadowCompare::z_light, "depth", "depth of the point as the light sees it", As::formula},
           Field{"lit", &ShadowCompare::lit, "1", "nothing lies before it", As::formula}};

template <>
inline constexpr Description description_of<ShadowBias>{
    .name = "shadow_bias",
    .meaning = "how far behind the shadow buffer a point may lie and still be lit, by the slope of its polygon",
    .work = WorkKind::tests,
    .called = "bias at pixel ({x}, {y})"};
template <>
inline constexpr auto fields_of<ShadowBias> = Fields{
    Field{"x", &ShadowBias::x, Measure::column, "column of the eye's picture", As::subject},
    Field{"y", &ShadowBias::y, Measure::pixel_row, "its row", As::subject},
    Field{"dz_dx_light", &ShadowBias::dz_dx_light, "view",
          "what the polygon's distance from the light, z_v there, gains from column to column of the light's picture",
          As::formula},
    Field{"dz_dy_light", &ShadowBias::dz_dy_light, "view", "and from row to row", As::formula},
    Field{"bias", &ShadowBias::bias, "view",
          "constant share of z_v + factor * the greater one of the two, without sign", As::formula}};

template <>
inline constexpr Description description_of<ShadowNeighbour>{
    .name = "shadow_neighbour",
    .meaning = "the same point is held against a neighbour in the shadow buffer",
    .work = WorkKind::compares,
    .called = "pixel ({x}, {y}) against shadow[{x_shadow}, {y_shadow}]"};
template <>
inline constexpr auto fields_of<ShadowNeighbour> =
    Fields{Field{"x", &ShadowNeighbour::x, Measure::column, "column of the eye's picture", As::formula | As::subject},
           Field{"y", &ShadowNeighbour::y, Measure::pixel_row, "its row", As::formula | As::subject},
           Field{"x_shadow", &ShadowNeighbour::x_shadow, Measure::column,
                 "column of the neighbour in the light's picture", As::formula | As::subject},
           Field{"y_shadow", &ShadowNeighbour::y_shadow, Measure::pixel_row, "row there", As::formula | As::subject},
           Field{"lit", &ShadowNeighbour::lit, "1", "the depth there does not lie before the point", As::formula}};

template <>
inline constexpr Description description_of<LightShare>{
    .name = "light_share",
    .meaning = "the mean outcome of a point's compares with the shadow buffer",
    .work = WorkKind::tests,
    .called = "share of light at pixel ({x}, {y})"};
template <>
inline constexpr auto fields_of<LightShare> =
    Fields{Field{"x", &LightShare::x, Measure::column, "column of the eye's picture", As::formula | As::subject},
           Field{"y", &LightShare::y, Measure::pixel_row, "its row", As::formula | As::subject},
           Field{"share", &LightShare::share, "1", "of the light, 0 to 1", As::formula}};

}  // namespace zstep
