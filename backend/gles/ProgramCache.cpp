// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/ProgramCache.h"

#include "base/Hash.h"

#include <cstring>
#include <vector>

namespace filament_core::backend::gles {

void openProgramCache(Device& device, std::filesystem::path const& directory) {
    if (directory.empty()) return;
    GLint formats = 0;
    device.gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats <= 0) return;
    const uint64_t identity = hashString(device.info.driverName, hashString(device.info.deviceName));
    device.programs.emplace(directory / fmt::format("gles-{:016x}.programs", identity), identity, kProgramCacheBytes);
}

GLuint loadProgramBinary(Device& device, uint64_t key) {
    const std::span<const std::byte> blob = device.programs->find(key);
    GLenum format = 0;
    if (blob.size() <= sizeof(format)) return 0;
    std::memcpy(&format, blob.data(), sizeof(format));
    Api const& gl = device.gl;
    const GLuint program = gl.CreateProgram();
    gl.ProgramBinary(program, format, blob.data() + sizeof(format), static_cast<GLsizei>(blob.size() - sizeof(format)));
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) {
        ++device.statistics.programsFromCache;
        return program;
    }
    gl.DeleteProgram(program);
    gl.GetError(); // clear the error: the driver no longer knows the format
    device.programs->erase(key);
    return 0;
}

void keepProgramBinary(Device& device, uint64_t key, GLuint program) {
    Api const& gl = device.gl;
    GLint length = 0;
    gl.GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;
    GLenum format = 0;
    std::vector<std::byte> blob(sizeof(format) + static_cast<size_t>(length));
    GLsizei written = 0;
    gl.GetProgramBinary(program, length, &written, &format, blob.data() + sizeof(format));
    std::memcpy(blob.data(), &format, sizeof(format));
    device.programs->put(key, std::span(blob).first(sizeof(format) + static_cast<size_t>(written)));
}

} // namespace filament_core::backend::gles
