// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/ShaderObject.h"

#include "backend/gles/ProgramCache.h"
#include "base/Hash.h"

#include <array>
#include <ranges>
#include <string>
#include <string_view>

namespace filament_core::backend::gles {
namespace {

/// Drivers list warnings, which reject nothing, before or after the error.
std::string reasonIn(std::string_view log) {
    std::string_view first, error;
    for (const auto line : std::views::split(log, '\n')) {
        const std::string_view text(line.begin(), line.end());
        const std::string_view trimmed = text.substr(0, text.find_last_not_of(" \r\t") + 1);
        if (first.empty()) first = trimmed;
        if (error.empty() && trimmed.find("error") != std::string_view::npos) error = trimmed;
    }
    if (first.empty()) return "the driver gives no reason";
    return std::string(error.empty() ? first : error);
}

template <class GetInteger, class GetLog>
std::string readLog(GLuint object, GetInteger getInteger, GetLog getLog) {
    GLint length = 0;
    getInteger(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    GLsizei written = 0;
    getLog(object, length, &written, log.data());
    log.resize(static_cast<size_t>(written));
    return reasonIn(log);
}

const char* nameOf(GLenum stage) {
    return stage == GL_VERTEX_SHADER ? "vertex" : stage == GL_FRAGMENT_SHADER ? "fragment" : "compute";
}

GLuint compile(Device& device, StageText const& text, std::string_view name) {
    std::array<const GLchar*, std::tuple_size_v<decltype(StageText::pieces)>> pieces{};
    std::array<GLint, std::tuple_size_v<decltype(StageText::pieces)>> lengths{};
    for (size_t i = 0; i < pieces.size(); ++i) {
        pieces[i] = text.pieces[i].data() ? text.pieces[i].data() : "";
        lengths[i] = static_cast<GLint>(text.pieces[i].size());
    }
    Api const& gl = device.gl;
    const GLuint shader = gl.CreateShader(text.stage);
    gl.ShaderSource(shader, static_cast<GLsizei>(pieces.size()), pieces.data(), lengths.data());
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;
    device.error(DriverErrorKind::ShaderCompile, "program '{}', {} shader: {}; what uses it is skipped", name,
                 nameOf(text.stage), readLog(shader, gl.GetShaderiv, gl.GetShaderInfoLog));
    gl.DeleteShader(shader);
    return 0;
}

/// Compiles every stage into the program, until one fails.
bool attachStages(Device& device, GLuint program, std::span<const StageText> stages, std::string_view name) {
    for (StageText const& stage : stages) {
        const GLuint shader = compile(device, stage, name);
        if (!shader) return false;
        device.gl.AttachShader(program, shader);
        device.gl.DeleteShader(shader); // kept by the program
    }
    return true;
}

GLuint link(Device& device, std::span<const StageText> stages, std::string_view name) {
    Api const& gl = device.gl;
    const GLuint program = gl.CreateProgram();
    if (attachStages(device, program, stages, name)) {
        // Before linking, when the driver decides whether to keep the binary.
        if (device.programs) gl.ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
        gl.LinkProgram(program);
        GLint linked = GL_FALSE;
        gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
        if (linked) return program;
        device.error(DriverErrorKind::ShaderCompile, "program '{}' does not link: {}; what uses it is skipped", name,
                     readLog(program, gl.GetProgramiv, gl.GetProgramInfoLog));
    }
    gl.DeleteProgram(program);
    return 0;
}

uint64_t keyOf(std::span<const StageText> stages) {
    uint64_t key = 0;
    for (StageText const& stage : stages) {
        key = hashCombine(key, stage.stage);
        for (std::string_view piece : stage.pieces) key = hashString(piece, key);
    }
    return key;
}

} // namespace

GLuint linkProgram(Device& device, std::span<const StageText> stages, std::string_view name) {
    if (!device.programs) return link(device, stages, name);
    const uint64_t key = keyOf(stages);
    if (const GLuint program = loadProgramBinary(device, key)) return program;
    const GLuint program = link(device, stages, name);
    if (program) keepProgramBinary(device, key, program);
    return program;
}

} // namespace filament_core::backend::gles
