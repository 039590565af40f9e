// Where a run may have NaN or an infinity: everywhere else a finite number must stand.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"

namespace zstep {

/// Of a number that no formula gives: may it be this one, which is not finite? docs/trace-format.md says so of each.
inline bool may_be(const Header& header, std::uint8_t kind, std::string_view field, double value) {
  struct Field {
    std::uint8_t kind;
    std::string_view name;
  };
  // A horizon begins nowhere, nothing is met, nothing is shared, a vertex lies behind the eye, or a ray runs along a
  // plane.
  static constexpr std::array<Field, 8> not_finite{{{kind_of<HorizonMove>, "y_curve"},
                                                    {kind_of<OverlapTest>, "x_at"},
                                                    {kind_of<OverlapTest>, "y_at"},
                                                    {kind_of<FacingTest>, "projected_normal_z"},
                                                    {kind_of<RayPlane>, "t"},
                                                    {kind_of<RayEnd>, "t"},
                                                    {kind_of<BoxTest>, "t_enter"},
                                                    {kind_of<BoxTest>, "t_leave"}}};
  for (const Field& one : not_finite)
    if (one.kind == kind && one.name == field) return true;
  if (kind == kind_of<BuffersClear>) return std::isinf(value);
  // What is written may be the depth of nothing: a buffer may be cleared pixel by pixel.
  return (kind == kind_of<DepthWrite> || kind == kind_of<PixelPaint>)&&value == header.empty_depth();
}

}  // namespace zstep
