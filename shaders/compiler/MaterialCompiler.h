// SPDX-License-Identifier: Apache-2.0
/// compileMaterial: the text of a .mat file -> a package with every variant in both languages.
///   Steps   parse (Jsonish) -> check (MaterialDefinition) -> which properties does the code set (CodeScan)?
///           -> generate GLSL per variant (GlslGenerator) -> compile (CompileProgram) -> package.
///   Thread  any; with `jobs` the variants are compiled in parallel. The bytes do not depend on it.
///   Memory  what the package holds, and some megabytes a thread while compiling.
///   Fails   InvalidArgument or Unsupported, "file:line: reason" in the author's file, also for errors of the GLSL.
///   Cost    about 50 ms a variant.
#pragma once

#include "base/Result.h"
#include "shaders/compiler/CompileProgram.h"
#include "shaders/compiler/Jsonish.h"
#include "shaders/compiler/PlatformDefaults.h"
#include "shaders/package/Package.h"

#include <string>
#include <string_view>

namespace filament::jobs {
class JobSystem;
}

namespace filament::shader {

struct CompileOptions {
    bool exact = true; ///< same bits on both APIs (ExactLowering.h)
    Optimization optimization = Optimization::Performance;
    bool spirv = true; ///< languages that the package gets
    bool essl = true;
    Platform platform = Platform::All; ///< whose defaults
    uint16_t filteredVariants = 0; ///< VariantBits never asked for, besides those of the material's own variantFilter
    /// Files besides the engine's own (which are asked first): usually those beside the .mat.
    IncludeResolver includes{};
    jobs::JobSystem* jobs = nullptr; ///< null: on the calling thread alone
};

Result<MaterialPackage> compileMaterial(std::string_view text, std::string_view fileName,
                                        CompileOptions const& options = {});

/// What the compiler hands to glslang, for reading: both stages of every variant.
Result<std::string> preprocessMaterial(std::string_view text, std::string_view fileName,
                                       CompileOptions const& options = {});

/// The terms that are in, as their macros, in one line (MaterialAnalysis.h).
Result<std::string> describeTerms(std::string_view text, std::string_view fileName, CompileOptions const& options = {});

/// What the material declares, as JSON: the guide's `--reflect parameters`. The code is not compiled.
Result<std::string> reflectParameters(std::string_view text, std::string_view fileName,
                                      CompileOptions const& options = {});

} // namespace filament::shader
