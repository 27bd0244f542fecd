// SPDX-License-Identifier: MIT
// A scene of bare Embree, 3 or 4, one thread, that is released with its device; and its questions under one name.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>

namespace threefold {

class EmbreeScene {
public:
    EmbreeScene() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {}
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene &) = delete;
    EmbreeScene &operator=(const EmbreeScene &) = delete;
    RTCScene get() const { return scene_; }

protected:
    RTCDevice device() const { return device_; }
    void attach(RTCGeometry g) {
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
    }
    void commit() { rtcCommitScene(scene_); }

private:
    RTCDevice device_;
    RTCScene scene_;
};

#if RTC_VERSION_MAJOR >= 4
class EmbreeQuery {
public:
    explicit EmbreeQuery(bool coherent = false) {
        rtcInitIntersectArguments(&arguments_);
        if (coherent) arguments_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    }
    void one(RTCScene scene, RTCRayHit &r) { rtcIntersect1(scene, &r, &arguments_); }
    template <auto shoot, class Hit>
    void packet(const int *valid, RTCScene scene, Hit &r) {
        shoot(valid, scene, &r, &arguments_);
    }

private:
    RTCIntersectArguments arguments_;
};
#else
/// Embree 4 has no streams of rays.
#define THREEFOLD_BENCH_STREAMS
class EmbreeQuery {
public:
    explicit EmbreeQuery(bool coherent = false) {
        rtcInitIntersectContext(&context_);
        if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
    void one(RTCScene scene, RTCRayHit &r) { rtcIntersect1(scene, &context_, &r); }
    void stream(RTCScene scene, RTCRayHit *first, std::size_t count) {
        rtcIntersect1M(scene, &context_, first, static_cast<unsigned>(count), sizeof(RTCRayHit));
    }
    template <auto shoot, class Hit>
    void packet(const int *valid, RTCScene scene, Hit &r) {
        shoot(valid, scene, &context_, &r);
    }

private:
    RTCIntersectContext context_;
};
#endif

} // namespace threefold
