#include "traces/codec/foretell.hpp"

namespace zstep::codec {

void Foreteller::forget() {
  whole_.fill(0);
  real_.fill(0);
  facing_ = Facing::front;
  keeps_all_ = false;
  begin_polygon({});
  last_inserted_ = -1;
  divider_ = {};
  held_ = -1;
  sides_ = 0;
  cuts_.clear();
  extents_.clear();
  held_against_ = -1;
  next_axis_ = Axis::x;
  ray_from_ = ray_along_ = glm::dvec3(0);
}

}  // namespace zstep::codec
