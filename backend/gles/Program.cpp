// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Program.h"

#include "backend/gles/ShaderObject.h"

#include <bit>
#include <limits>

namespace filament_core::backend::gles {
namespace {

// ES links no program without a fragment shader, not even one that only writes depth.
constexpr std::string_view kNoFragment = "#version 310 es\nvoid main() {}\n";

std::string_view asText(std::span<const std::byte> bytes) {
    return { reinterpret_cast<const char*>(bytes.data()), bytes.size() };
}

std::string literal(ConstantValue const& constant) {
    switch (constant.type) {
    case ConstantValue::Type::Bool:
        return constant.bits ? "(1 == 1)" : "(1 == 0)"; // the preprocessor knows neither true nor false
    case ConstantValue::Type::Int: {
        const auto value = static_cast<int32_t>(constant.bits);
        // The lowest integer has no literal: the minus sign is an operator.
        if (value == std::numeric_limits<int32_t>::min()) return "(-2147483647 - 1)";
        return fmt::format("({})", value);
    }
    case ConstantValue::Type::Float:
        break;
    }
    // A constant expression (ESSL 3.10, 4.3.3), and exact for every value, infinities included.
    return fmt::format("uintBitsToFloat({:#010x}u) /* {} */", constant.bits, std::bit_cast<float>(constant.bits));
}

/// #version must stay the first line; `#line` keeps the line numbers in compile errors correct.
struct SplitText {
    std::string_view version, body;
};

SplitText splitAfterVersion(std::string_view text) {
    const size_t end = text.find('\n');
    if (!text.starts_with("#version") || end == std::string_view::npos) return { {}, text };
    return { text.substr(0, end + 1), text.substr(end + 1) };
}

struct AttributeShape {
    GLenum scalarType;
    uint32_t locations;
};

AttributeShape shapeOf(GLenum type) {
    switch (type) {
    case GL_INT:
    case GL_INT_VEC2:
    case GL_INT_VEC3:
    case GL_INT_VEC4:
        return { GL_INT, 1 };
    case GL_UNSIGNED_INT:
    case GL_UNSIGNED_INT_VEC2:
    case GL_UNSIGNED_INT_VEC3:
    case GL_UNSIGNED_INT_VEC4:
        return { GL_UNSIGNED_INT, 1 };
    case GL_FLOAT_MAT2:
    case GL_FLOAT_MAT2x3:
    case GL_FLOAT_MAT2x4:
        return { GL_FLOAT, 2 };
    case GL_FLOAT_MAT3:
    case GL_FLOAT_MAT3x2:
    case GL_FLOAT_MAT3x4:
        return { GL_FLOAT, 3 };
    case GL_FLOAT_MAT4:
    case GL_FLOAT_MAT4x2:
    case GL_FLOAT_MAT4x3:
        return { GL_FLOAT, 4 };
    default:
        return { GL_FLOAT, 1 };
    }
}

} // namespace

std::string constantDefinitions(std::span<const ConstantValue> constants) {
    if (constants.empty()) return {};
    std::string lines;
    for (ConstantValue const& constant : constants) {
        lines += fmt::format("#define SPIRV_CROSS_CONSTANT_ID_{} {}\n", constant.id, literal(constant));
    }
    return lines + "#line 2\n";
}

FlatBindings flatBindings(ProgramLayout const& layout) {
    FlatBindings flat;
    for (uint32_t group = 0; group < kMaxBindGroups; ++group) {
        flat[group].fill(0xFF);
        for (uint32_t i = 0; i < layout[group].count; ++i) {
            flat[group][i] = flatBinding(layout, group, layout[group].bindings[i].binding);
        }
    }
    return flat;
}

Program::Program(Device& device, ProgramDesc const& desc)
        : mDevice(device), mIsCompute(!desc.compute.empty()), mBindings(flatBindings(desc.layout)) {
    const std::string constants = constantDefinitions(desc.constants);
    const auto stage = [&constants](GLenum kind, std::string_view text) {
        const SplitText split = splitAfterVersion(text);
        return StageText{ kind, { split.version, constants, split.body } };
    };
    if (mIsCompute) {
        const std::array stages{ stage(GL_COMPUTE_SHADER, asText(desc.compute)) };
        mName = linkProgram(device, stages, desc.debugName);
    } else {
        const std::array stages{ stage(GL_VERTEX_SHADER, asText(desc.vertex)),
                                 stage(GL_FRAGMENT_SHADER,
                                       desc.fragment.empty() ? kNoFragment : asText(desc.fragment)) };
        mName = linkProgram(device, stages, desc.debugName);
    }
    ++device.statistics.programsCreated;
    if (!mName) return;
    device.label(GL_PROGRAM, mName, desc.debugName);
    if (mIsCompute) return;
    readInputs();
    readOutputs();
}

Program::~Program() {
    if (!mName) return;
    mDevice.state.forgetProgram(mName);
    mDevice.gl.DeleteProgram(mName);
}

void Program::readInputs() {
    Api const& gl = mDevice.gl;
    GLint count = 0;
    gl.GetProgramiv(mName, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<GLchar, 256> name{};
        GLint elements = 0;
        GLenum type = 0;
        gl.GetActiveAttrib(mName, static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), nullptr, &elements, &type,
                           name.data());
        const GLint first = gl.GetAttribLocation(mName, name.data());
        if (first < 0) continue; // gl_VertexID and the like
        const AttributeShape shape = shapeOf(type);
        const auto locations = static_cast<GLint>(shape.locations) * elements;
        for (GLint at = first; at < first + locations && at < static_cast<GLint>(kMaxVertexAttributes); ++at) {
            mInputs.push_back({ static_cast<uint8_t>(at), shape.scalarType });
        }
    }
}

// In ES, outputs that a program does not write have undefined values, so the pipeline masks them.
void Program::readOutputs() {
    Api const& gl = mDevice.gl;
    GLint count = 0;
    gl.GetProgramInterfaceiv(mName, GL_PROGRAM_OUTPUT, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) {
        constexpr std::array<GLenum, 2> kProperties{ GL_LOCATION, GL_ARRAY_SIZE };
        std::array<GLint, 2> values{ -1, 1 };
        gl.GetProgramResourceiv(mName, GL_PROGRAM_OUTPUT, static_cast<GLuint>(i), kProperties.size(),
                                kProperties.data(), values.size(), nullptr, values.data());
        const auto [first, elements] = values;
        if (first < 0) continue; // gl_FragDepth and the like
        for (GLint at = first; at < first + elements && at < static_cast<GLint>(kMaxColorAttachments); ++at) {
            mOutputMask |= 1u << at;
        }
    }
}

} // namespace filament_core::backend::gles
