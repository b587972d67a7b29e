// SPDX-License-Identifier: Apache-2.0
/// BothDevices: a test that runs a rig on Vulkan and on OpenGL ES, and is skipped if one is missing.
///   Rig     static std::unique_ptr<Rig> make(Backend), null if no such device is installed.
///   Memory  the rigs are created once per process: a context takes longer than a hundred images.
#pragma once

#include "backend/create/CreateDriver.h"

#include <gtest/gtest.h>

#include <memory>

namespace filament_core::shader::test {

template <class Rig>
class BothDevices : public ::testing::Test {
protected:
    static Rig& vulkan() { return *rigs().vulkan; }
    static Rig& gles() { return *rigs().gles; }

    void SetUp() override {
        if (!rigs().vulkan || !rigs().gles) GTEST_SKIP() << "needs a Vulkan and an OpenGL ES device";
    }

private:
    struct Rigs {
        std::unique_ptr<Rig> vulkan = Rig::make(Backend::Vulkan);
        std::unique_ptr<Rig> gles = Rig::make(Backend::Gles);
    };

    static Rigs& rigs() {
        static auto* const made = new Rigs; // lives until the process ends: drivers do not support static destruction
        return *made;
    }
};

} // namespace filament_core::shader::test
