// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer (tests/fuzz/PackageFuzz.cpp) and the replay test: any bytes give a package or an error.
#pragma once

#include "base/Assert.h"
#include "base/Hash.h"
#include "shaders/package/Package.h"
#include "shaders/package/PackageFormat.h"
#include "shaders/package/RemoveUnusedTextures.h"

#include <cstddef>
#include <span>
#include <vector>

namespace filament_core::shader::test {

/// A file of this engine's version and a valid checksum around its sections: mutations of them reach the code behind
/// the header's checks, and a corpus of them outlives a change of the version.
inline std::vector<std::byte> withHeader(std::span<const std::byte> sections) {
    std::vector<std::byte> file;
    const auto append = [&](auto value) { // little-endian hosts only, like the tests
        const auto bytes = std::as_bytes(std::span(&value, 1));
        file.insert(file.end(), bytes.begin(), bytes.end());
    };
    append(format::kMagic);
    append(format::kVersion);
    append(hashBytes(sections));
    file.insert(file.end(), sections.begin(), sections.end());
    return file;
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

/// `bytes`: sections without a header; refused as a file.
inline bool fuzzPackage(std::span<const std::byte> bytes) {
    const bool isFile = readAndRewrite(bytes);
    return readAndRewrite(withHeader(bytes)) || isFile;
}

} // namespace filament_core::shader::test
