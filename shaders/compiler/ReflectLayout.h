// SPDX-License-Identifier: Apache-2.0
/// Reads the bind group layout and the vertex inputs from the SPIR-V of one or both stages.
///   Thread  any. Cost: two parses.
///   Fails   InvalidArgument: a set or binding beyond the limits, the same binding declared in two different ways, a
///           kind of resource without a BindingType (storage images, separate samplers, arrays of samplers), a storage
///           buffer that a vertex stage reads or that a fragment stage could write.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"
#include "shaders/compiler/CompileProgram.h"

#include <cstdint>
#include <span>

namespace filament_core::shader {

struct StageResources {
    backend::ProgramLayout layout{};
    uint32_t vertexInputs = 0; ///< bit n: location n is read
};

/// `dynamicBuffers` as in ProgramCompileOptions.
Result<StageResources> reflectStage(std::span<const uint32_t> spirv, backend::ShaderStage stage,
                                    std::optional<std::vector<SetBinding>> const& dynamicBuffers);
Result<StageResources> reflectResources(std::span<const uint32_t> vertexSpirv, std::span<const uint32_t> fragmentSpirv,
                                        std::optional<std::vector<SetBinding>> const& dynamicBuffers);

/// InvalidArgument, naming the binding, unless `layout` has all of `used` with the same types and stages.
Result<void> checkContains(backend::ProgramLayout const& layout, backend::ProgramLayout const& used);

} // namespace filament_core::shader
