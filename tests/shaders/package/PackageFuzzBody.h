// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer (tests/fuzz/PackageFuzz.cpp) and the replay test: any bytes give a package or an error.
#pragma once

#include "base/Assert.h"
#include "base/Hash.h"
#include "shaders/package/Package.h"
#include "shaders/package/RemoveUnusedTextures.h"

#include <cstring>
#include <span>
#include <vector>

namespace filament::shader::test {

inline constexpr size_t kPackageChecksumAt = 8, kPackageContentAt = 16;

/// The same bytes with a valid checksum, so that mutations reach the code behind the check.
inline std::vector<std::byte> withValidChecksum(std::span<const std::byte> bytes) {
    std::vector<std::byte> fixed(bytes.begin(), bytes.end());
    if (fixed.size() < kPackageContentAt) return fixed;
    const uint64_t checksum = hashBytes(std::span<const std::byte>(fixed).subspan(kPackageContentAt));
    std::memcpy(fixed.data() + kPackageChecksumAt, &checksum,
                sizeof checksum); // little-endian hosts only, like the tests
    return fixed;
}

/// A package that was read can be written, and reads back the same. Returns whether the bytes were a package.
inline bool readAndRewrite(std::span<const std::byte> bytes) {
    const Result<MaterialPackage> package = readPackage(bytes);
    if (!package) {
        FILAMENT_ASSERT(!package.error().message.empty(), "every refusal says why");
        return false;
    }
    const Result<MaterialPackage> again = readPackage(writePackage(*package));
    FILAMENT_ASSERT(again.ok(), "what was read can be written and read again");
    FILAMENT_ASSERT(writePackage(*again) == writePackage(*package), "rewriting changes nothing");
    MaterialPackage loaded = *package;
    removeUnusedTextures(loaded, {});
    FILAMENT_ASSERT(readPackage(writePackage(loaded)).ok(), "a package without its unused textures is one, too");
    return true;
}

inline bool fuzzPackage(std::span<const std::byte> bytes) {
    const bool asIs = readAndRewrite(bytes);
    return readAndRewrite(withValidChecksum(bytes)) || asIs;
}

} // namespace filament::shader::test
