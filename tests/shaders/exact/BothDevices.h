// SPDX-License-Identifier: Apache-2.0
/// BothDevices: a test that asks a rig on Vulkan and the same rig on OpenGL ES, and is skipped where one is missing.
///   Rig     static std::unique_ptr<Rig> make(backend::BackendType), null where no such device is installed.
///   Memory  the rigs are made once a process: a context takes longer than a hundred pictures.
#pragma once

#include "backend/create/CreateDriver.h"

#include <gtest/gtest.h>

#include <memory>

namespace filament::shader::test {

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
        std::unique_ptr<Rig> vulkan = Rig::make(backend::BackendType::Vulkan);
        std::unique_ptr<Rig> gles = Rig::make(backend::BackendType::Gles);
    };

    static Rigs& rigs() {
        static auto* const made = new Rigs; // ends with the process: drivers do not like static destruction
        return *made;
    }
};

} // namespace filament::shader::test
