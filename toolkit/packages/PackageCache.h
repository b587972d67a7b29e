// SPDX-License-Identifier: Apache-2.0
/// compilePackage: compileMaterial() and writePackage(), or what they gave before, for programs that compile the same
/// materials again and again: tests, and filament-conformance. Not for tests of the compiler.
///   In      FILAMENT_PACKAGE_CACHE names the folder; unset or empty, everything is compiled.
///   Key     the text, its name, every option, the contents of every file that it includes or asks for in vain, and the
///           compiler: the bytes of the matc of this build. An entry holds all of it, of the matc a hash, so that no
///           material is mistaken for another.
///   Limits  the entries that were used longest ago are deleted until the rest fits.
///   Thread  any, and several processes: entries are written under another name and renamed.
///   Fails   as compileMaterial(), whose errors are not kept. An entry that cannot be read or written counts as
///           missing.
///   Cost    a hit: reading the entry and what it includes, less than a millisecond.
#pragma once

#include "shaders/compiler/MaterialCompiler.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::tools {

struct PackageCache {
    std::filesystem::path folder;
    std::string compiler;             ///< whatever changes with the compiler
    uint64_t maxBytes = 512ull << 20; ///< of all entries
};

/// That of FILAMENT_PACKAGE_CACHE with this build's compiler.
std::optional<PackageCache> packageCacheOfEnvironment();

struct CompiledPackage {
    std::vector<std::byte> bytes;
    bool isKept = false; ///< was compiled before: nothing was compiled now
};

/// With options.warnings everything is compiled.
Result<CompiledPackage> compilePackage(std::string_view text, std::string_view fileName,
                                       shader::CompileOptions const& options = {},
                                       std::optional<PackageCache> const& cache = packageCacheOfEnvironment());

/// A hash of the bytes of this build's matc (cmake/WriteCompilerIdentity.cmake).
std::string_view compilerIdentity();

} // namespace filament_core::tools
