// SPDX-License-Identifier: MIT
// A scene of bare Embree, one thread, that is released with its device.
#pragma once

#include <embree3/rtcore.h>

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

} // namespace threefold
