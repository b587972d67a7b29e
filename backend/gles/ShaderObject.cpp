// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/ShaderObject.h"

#include "backend/gles/ProgramCache.h"
#include "base/Hash.h"

#include <array>
#include <string>

namespace filament::backend::gles {
namespace {

std::string firstLine(std::string log) {
    log.resize(log.find_last_not_of(" \n\r\t", std::string::npos) + 1);
    log.resize(std::min(log.find_first_of("\r\n"), log.size()));
    return log.empty() ? "the driver gives no reason" : log;
}

template <class GetInteger, class GetLog>
std::string readLog(GLuint object, GetInteger getInteger, GetLog getLog) {
    GLint length = 0;
    getInteger(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    GLsizei written = 0;
    getLog(object, length, &written, log.data());
    log.resize(static_cast<size_t>(written));
    return firstLine(std::move(log));
}

GLuint compile(Device& device, GLenum stage, ShaderText text, std::string_view name) {
    constexpr size_t kMaxPieces = 4;
    std::array<const GLchar*, kMaxPieces> pieces{};
    std::array<GLint, kMaxPieces> lengths{};
    size_t count = 0;
    for (std::string_view piece : text) {
        pieces[count] = piece.data() ? piece.data() : "";
        lengths[count++] = static_cast<GLint>(piece.size());
    }
    Api const& gl = device.gl;
    const GLuint shader = gl.CreateShader(stage);
    gl.ShaderSource(shader, static_cast<GLsizei>(count), pieces.data(), lengths.data());
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;
    device.error(DriverErrorKind::ShaderCompile, "program '{}', {} shader: {}; draws with it are skipped", name,
                 stage == GL_VERTEX_SHADER ? "vertex" : "fragment",
                 readLog(shader, gl.GetShaderiv, gl.GetShaderInfoLog));
    gl.DeleteShader(shader);
    return 0;
}

GLuint link(Device& device, ShaderText vertex, ShaderText fragment, std::string_view name) {
    Api const& gl = device.gl;
    const GLuint vertexShader = compile(device, GL_VERTEX_SHADER, vertex, name);
    const GLuint fragmentShader = vertexShader ? compile(device, GL_FRAGMENT_SHADER, fragment, name) : 0;
    GLuint program = 0;
    if (fragmentShader) {
        program = gl.CreateProgram();
        gl.AttachShader(program, vertexShader);
        gl.AttachShader(program, fragmentShader);
        if (device.programs) gl.ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
        gl.LinkProgram(program);
    }
    gl.DeleteShader(vertexShader); // kept by the program; 0 is ignored
    gl.DeleteShader(fragmentShader);
    GLint linked = GL_FALSE;
    if (program) gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!program || linked) return program;
    device.error(DriverErrorKind::ShaderCompile, "program '{}' does not link: {}; draws with it are skipped", name,
                 readLog(program, gl.GetProgramiv, gl.GetProgramInfoLog));
    gl.DeleteProgram(program);
    return 0;
}

uint64_t keyOf(ShaderText vertex, ShaderText fragment) {
    uint64_t key = 0;
    for (std::string_view piece : vertex) key = hashString(piece, key);
    for (std::string_view piece : fragment) key = hashString(piece, hashCombine(key, 1));
    return key;
}

} // namespace

GLuint linkProgram(Device& device, ShaderText vertex, ShaderText fragment, std::string_view name) {
    if (!device.programs) return link(device, vertex, fragment, name);
    const uint64_t key = keyOf(vertex, fragment);
    if (const GLuint program = loadProgramBinary(device, key)) return program;
    const GLuint program = link(device, vertex, fragment, name);
    if (program) keepProgramBinary(device, key, program);
    return program;
}

} // namespace filament::backend::gles
