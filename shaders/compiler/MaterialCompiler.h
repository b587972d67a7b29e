// SPDX-License-Identifier: Apache-2.0
/// compileMaterial: compiles the text of a .mat file to a package with every variant in both languages.
///   Steps   parse (Jsonish) -> check (MaterialDefinition) -> which properties does the code set (CodeScan)?
///           -> generate GLSL per variant (GlslGenerator) -> compile (CompileProgram) -> package.
///   Thread  any; with `jobs` the variants are compiled in parallel. The bytes do not depend on it.
///   Memory  the contents of the package, and some megabytes per thread while compiling.
///   Fails   InvalidArgument or Unsupported, "file:line: reason" in the author's file, also for errors of the GLSL; a
///           line for each mistake, as far as one does not hide the next.
///   Cost    about 50 ms per variant.
#pragma once

#include "base/Result.h"
#include "shaders/compiler/CompileProgram.h"
#include "shaders/compiler/Jsonish.h"
#include "shaders/compiler/PlatformDefaults.h"
#include "shaders/package/Package.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::jobs {
class JobSystem;
}

namespace filament_core::shader {

struct CompileOptions {
    bool exact = true; ///< identical bits on both APIs (ExactLowering.h)
    Optimization optimization = Optimization::Performance;
    bool spirv = true; ///< languages in the package
    bool essl = true;
    Platform platform = Platform::All; ///< which defaults
    uint16_t filteredVariants = 0;     ///< VariantBits never requested, besides the material's own variantFilter
    std::optional<uint16_t> onlyVariant = std::nullopt; ///< compiles this one alone, for tests of shaders
    /// Files besides the engine's own (which come first): usually those beside the .mat.
    IncludeResolver includes{};
    jobs::JobSystem* jobs = nullptr; ///< null: compile on the calling thread only
    /// Macros in front of both blocks: name, value.
    std::vector<std::pair<std::string, std::string>> defines{};
    /// Receives "file:line: what is odd", in the order of the text (MaterialWarnings.h). Null: no warnings.
    std::vector<std::string>* warnings = nullptr;
};

Result<MaterialPackage> compileMaterial(std::string_view text, std::string_view fileName,
                                        CompileOptions const& options = {});

/// The text passed to glslang, for reading: both stages of every variant.
Result<std::string> preprocessMaterial(std::string_view text, std::string_view fileName,
                                       CompileOptions const& options = {});

/// The terms in the material, as macros on one line (MaterialAnalysis.h).
Result<std::string> describeTerms(std::string_view text, std::string_view fileName, CompileOptions const& options = {});

/// The material's declarations as JSON: the guide's `--reflect parameters`. The code is not compiled.
Result<std::string> reflectParameters(std::string_view text, std::string_view fileName,
                                      CompileOptions const& options = {});

} // namespace filament_core::shader
