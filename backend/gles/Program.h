// SPDX-License-Identifier: Apache-2.0
/// Program: a linked vertex and fragment shader, with what draws need to know about it; or a compute shader.
///   In      ESSL 3.10 text whose blocks and textures carry `layout(binding = flatBinding(...))`; an empty fragment
///           shader means that only depth is written. Specialisation constants become `#define
///           SPIRV_CROSS_CONSTANT_ID_<id> value` after the #version line: SPIRV-Cross uses these names and defines
///           their defaults inside #ifndef. Bools are comparisons, so that #if reads them, too.
///   Thread  the driver thread.
///   Fails   reported as ShaderCompile; name() is 0 and draws are skipped.
#pragma once

#include "backend/gles/Device.h"

#include <string>
#include <vector>

namespace filament_core::backend::gles {

/// The lines that define the constants.
std::string constantDefinitions(std::span<const ConstantValue> constants);

/// The number of every binding among the uniform blocks, storage blocks or texture units of the program; 0xFF: none.
using FlatBindings = std::array<std::array<uint8_t, kMaxBindings>, kMaxBindGroups>;
FlatBindings flatBindings(ProgramLayout const& layout);

/// A vertex attribute that the linked program reads.
struct ProgramInput {
    uint8_t location = 0;
    GLenum scalarType = GL_FLOAT; ///< GL_FLOAT, GL_INT or GL_UNSIGNED_INT
};

class Program {
public:
    Program(Device& device, ProgramDesc const& desc);
    ~Program();
    Program(Program const&) = delete;
    Program& operator=(Program const&) = delete;

    GLuint name() const { return mName; }
    bool isCompute() const { return mIsCompute; }
    FlatBindings const& bindings() const { return mBindings; }
    std::span<const ProgramInput> inputs() const { return mInputs; }
    uint32_t outputMask() const { return mOutputMask; } ///< bit i: the fragment stage has an output at location i

private:
    void readInputs();
    void readOutputs();

    Device& mDevice;
    bool mIsCompute;
    GLuint mName = 0;
    FlatBindings mBindings{};
    std::vector<ProgramInput> mInputs;
    uint32_t mOutputMask = 0;
};

} // namespace filament_core::backend::gles
