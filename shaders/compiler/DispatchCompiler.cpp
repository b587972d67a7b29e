// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/DispatchCompiler.h"

#include "shaders/compiler/CompileProgram.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslDeclarations.h"
#include "shaders/compiler/StageText.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"

#include <memory>
#include <optional>
#include <string>

namespace filament_core::shader {

Result<StageCode> compileDispatch(std::string_view text, std::string_view fileName) {
    const IncludeResolver includes = [](std::string_view path) -> std::optional<std::string> {
        const auto own = embeddedSource(path);
        return own ? std::optional(std::string(*own)) : std::nullopt;
    };
    StageText out(includes);
    out.line("#version 450");
    out.line("#extension GL_GOOGLE_cpp_style_line_directive : require");
    for (const std::string_view path :
         { "shaders/lib/math.glsl", "shaders/interface/interface.glsl", "shaders/material/api.glsl" }) {
        if (Result<void> done = out.include(path); !done) return done.error();
    }
    declareQuality(out);
    declareVariants(out);
    const GlslBlock block{ .text = std::string(text), .at = { std::make_shared<const std::string>(fileName), 1 } };
    if (Result<void> done = out.block(block); !done) return done.error();
    Result<ComputeShader> compiled =
            compileCompute(out.text(), { .dynamicUniformBuffers = { { { kGroupView, kBindingFrame } } },
                                         .layout = fogLightLayout(),
                                         .computeName = fileName });
    if (!compiled) return compiled.error();
    return StageCode{ std::move(compiled->spirv), std::move(compiled->essl) };
}

} // namespace filament_core::shader
