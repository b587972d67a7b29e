// SPDX-License-Identifier: Apache-2.0
/// ExpressionRig: evaluates a GLSL expression on one device for many random inputs and returns the bits.
///   In      a vec4 expression of a, b, c (vec4, in [-4, 4]), p (vec4, in (0, 1)), m, n (mat4), and the samplers
///           plain (nearest), smooth_ (trilinear, with mips), cube (trilinear).
///   Fails   values(): the error of the compiler or of the driver.
#pragma once

#include "backend/create/CreateDriver.h"
#include "backend/stream/CommandStream.h"
#include "shaders/compiler/CompileProgram.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::shader::test {

inline constexpr uint32_t kSide = 64; ///< inputs: kSide * kSide

class ExpressionRig {
public:
    /// Null where no such device is installed.
    static std::unique_ptr<ExpressionRig> make(Backend type);

    /// 4 words per input: the IEEE bits of the result. `statements` precede the expression.
    Result<std::vector<uint32_t>> values(std::string const& expression, bool exact, std::string const& statements = {});

private:
    explicit ExpressionRig(std::unique_ptr<backend::CommandStream> stream) : mStream(std::move(stream)) {}

    void createInputs();
    backend::TextureHandle randomTexture(backend::CommandBuffer& commands, uint32_t seed, float low, float high);
    backend::TextureHandle mippedTexture(backend::CommandBuffer& commands, backend::TextureKind type, uint32_t seed);
    void draw(backend::CommandBuffer& commands, ProgramShaders const& shaders, backend::BindGroupHandle group);

    std::unique_ptr<backend::CommandStream> mStream;
    std::vector<backend::BindGroupEntry> mEntries;
    backend::TextureHandle mTarget;
};

} // namespace filament_core::shader::test
