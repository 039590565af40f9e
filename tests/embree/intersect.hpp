// Embree's header, and what its versions 3 and 4 have different: how one ray is asked.
#pragma once

#if ZSTEP_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace zstep::test {

/// Follows a ray to what it meets first.
inline void intersect(RTCScene scene, RTCRayHit& ray) {
#if ZSTEP_EMBREE == 3
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#else
  rtcIntersect1(scene, &ray);
#endif
}

}  // namespace zstep::test
