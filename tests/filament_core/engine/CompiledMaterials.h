// SPDX-License-Identifier: Apache-2.0
/// Materials from .mat text, each text compiled once per process: tests draw the same material on several engines, and
/// compiling it takes longer than drawing it.
///   Thread  one.   Memory: the packages are kept.   Fails: by failing the running test.
#pragma once

#include "shaders/package/Package.h"
#include "toolkit/packages/PackageCache.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::test {

/// Variants that an image does not need.
inline constexpr uint16_t kNoShadows = shader::kVariantShadowReceiver, // most of a lit material
        kSunOnly = kNoShadows | shader::kVariantPunctual, kNoLights = kSunOnly | shader::kVariantSun;

/// Empty, and a test failure, if the text does not compile. Filter variants that a test does not need: they only take
/// time.
inline std::span<const std::byte> compiledPackage(std::string_view text, uint16_t filteredVariants = 0) {
    static std::map<std::pair<std::string, uint16_t>, std::vector<std::byte>> known;
    std::vector<std::byte>& bytes = known[{ std::string(text), filteredVariants }];
    if (!bytes.empty()) return bytes;
    Result<tools::CompiledPackage> package =
            tools::compilePackage(text, "test.mat", { .filteredVariants = filteredVariants });
    if (package)
        bytes = std::move(package->bytes);
    else
        ADD_FAILURE() << package.error().message;
    return bytes;
}

} // namespace filament_core::test
