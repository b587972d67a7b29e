// SPDX-License-Identifier: Apache-2.0
/// storedExr: a file that OpenEXR itself wrote; tests/fuzz/corpus/exr/write.cpp says which there are.
#pragma once

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace filament_core::assets {

inline std::vector<std::byte> storedExr(std::string const& name) {
    const auto bytes = readFileBytes(tools::sourceDir() / "tests/fuzz/corpus/exr" / (name + ".exr"));
    EXPECT_TRUE(bytes) << name;
    return bytes ? *bytes : std::vector<std::byte>{};
}

} // namespace filament_core::assets
