// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Quirks.h"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>

namespace filament_core::backend::gles {
namespace {

using Extensions = std::set<std::string, std::less<>>;

GLint integer(Api const& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::string text(Api const& gl, GLenum name) {
    const GLubyte* value = gl.GetString(name);
    return value ? reinterpret_cast<const char*>(value) : "";
}

Extensions readExtensions(Api const& gl) {
    Extensions names;
    const GLint count = integer(gl, GL_NUM_EXTENSIONS);
    for (GLint i = 0; i < count; ++i) {
        names.emplace(reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
    }
    return names;
}

bool hasAny(Extensions const& names, std::initializer_list<const char*> wanted) {
    return std::any_of(wanted.begin(), wanted.end(), [&](const char* name) { return names.contains(name); });
}

uint32_t maxDispatchGroups(Api const& gl) {
    GLint least = 65535; // the minimum that the specification requires
    for (GLuint direction = 0; direction < 3; ++direction) {
        GLint most = 0;
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, direction, &most);
        least = direction == 0 ? most : std::min(least, most);
    }
    return static_cast<uint32_t>(least);
}

bool hasBlockCompression(Extensions const& names) {
    return names.contains("GL_EXT_texture_compression_s3tc") && names.contains("GL_EXT_texture_compression_rgtc") &&
           names.contains("GL_EXT_texture_compression_bptc") &&
           hasAny(names, { "GL_EXT_texture_compression_s3tc_srgb", "GL_NV_sRGB_formats" });
}

} // namespace

Result<Quirks> Quirks::probe(Api const& gl) {
    const GLint version = integer(gl, GL_MAJOR_VERSION) * 10 + integer(gl, GL_MINOR_VERSION);
    const bool es32 = version >= 32;
    const Extensions names = readExtensions(gl);
    if (version < 31) return fail(ErrorCode::Unsupported, "{} is older than OpenGL ES 3.1", text(gl, GL_VERSION));
    if (!names.contains("GL_EXT_clip_control") || !gl.ClipControl) {
        return fail(ErrorCode::Unsupported, "{} lacks EXT_clip_control (clip depth in [0, 1])", text(gl, GL_RENDERER));
    }
    if (!es32 && !names.contains("GL_EXT_color_buffer_float")) {
        return fail(ErrorCode::Unsupported, "{} cannot render to float textures", text(gl, GL_RENDERER));
    }
    Quirks quirks;
    quirks.baseVertex =
            gl.DrawElementsInstancedBaseVertex &&
            (es32 || hasAny(names, { "GL_EXT_draw_elements_base_vertex", "GL_OES_draw_elements_base_vertex" }));
    quirks.baseInstance = quirks.baseVertex && names.contains("GL_EXT_base_instance") &&
                          gl.DrawArraysInstancedBaseInstance && gl.DrawElementsInstancedBaseVertexBaseInstance;
    quirks.readDepth = names.contains("GL_NV_read_depth");
    quirks.indexedBlend = gl.BlendFuncSeparatei && gl.BlendEquationSeparatei && gl.ColorMaski && gl.Enablei &&
                          gl.Disablei &&
                          (es32 || hasAny(names, { "GL_EXT_draw_buffers_indexed", "GL_OES_draw_buffers_indexed" }));
    quirks.framebufferFetch = names.contains("GL_EXT_shader_framebuffer_fetch");
    quirks.textureViews = gl.TextureView && hasAny(names, { "GL_EXT_texture_view", "GL_OES_texture_view" });
    quirks.timers = names.contains("GL_EXT_disjoint_timer_query") && gl.QueryCounter && gl.GetQueryObjectui64v;
    quirks.blockCompression = hasBlockCompression(names);
    quirks.exactSrgbBlocks = text(gl, GL_RENDERER).find("llvmpipe") == std::string::npos;
    quirks.primitiveIds = hasAny(names, { "GL_EXT_geometry_shader" });
    quirks.cubeArrays = es32 || hasAny(names, { "GL_EXT_texture_cube_map_array", "GL_OES_texture_cube_map_array" });
    quirks.srgbWriteControl = names.contains("GL_EXT_sRGB_write_control");
    quirks.depthClamp = names.contains("GL_EXT_depth_clamp");
    quirks.anisotropy = names.contains("GL_EXT_texture_filter_anisotropic");
    quirks.debugMessages = gl.DebugMessageCallback && gl.ObjectLabel && gl.PushDebugGroup && gl.PopDebugGroup &&
                           (es32 || names.contains("GL_KHR_debug"));
    quirks.resetStatus =
            gl.GetGraphicsResetStatus && (es32 || hasAny(names, { "GL_KHR_robustness", "GL_EXT_robustness" }));
    return quirks;
}

DeviceInfo describeDevice(Api const& gl, Quirks const& quirks) {
    DeviceInfo info;
    info.backend = Backend::Gles;
    info.shaderLanguage = ShaderLanguage::Essl310;
    info.deviceName = text(gl, GL_RENDERER);
    info.driverName = text(gl, GL_VERSION);
    DeviceLimits& limits = info.limits;
    limits.maxTextureSize = static_cast<uint32_t>(integer(gl, GL_MAX_TEXTURE_SIZE));
    limits.max3DTextureSize = static_cast<uint32_t>(integer(gl, GL_MAX_3D_TEXTURE_SIZE));
    limits.maxColorAttachments =
            std::min({ static_cast<uint32_t>(integer(gl, GL_MAX_COLOR_ATTACHMENTS)),
                       static_cast<uint32_t>(integer(gl, GL_MAX_DRAW_BUFFERS)), kMaxColorAttachments });
    limits.maxUniformBlockBytes = static_cast<uint32_t>(integer(gl, GL_MAX_UNIFORM_BLOCK_SIZE));
    limits.uniformOffsetAlignment = static_cast<uint32_t>(integer(gl, GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT));
    limits.maxTextureUnits = static_cast<uint32_t>(integer(gl, GL_MAX_TEXTURE_IMAGE_UNITS));
    limits.maxStorageBuffers = static_cast<uint32_t>(std::min(
            { integer(gl, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS), integer(gl, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS) }));
    limits.maxFragmentStorageBuffers = std::min(
            limits.maxStorageBuffers, static_cast<uint32_t>(integer(gl, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS)));
    limits.maxStorageBlockBytes = static_cast<uint32_t>(integer(gl, GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
    limits.storageOffsetAlignment = static_cast<uint32_t>(integer(gl, GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT));
    limits.maxDispatchGroups = maxDispatchGroups(gl);
    limits.maxGroupInvocations = static_cast<uint32_t>(integer(gl, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS));
    limits.maxGroupBytes = static_cast<uint32_t>(integer(gl, GL_MAX_COMPUTE_SHARED_MEMORY_SIZE));
    limits.maxVertexAttributes =
            std::min(static_cast<uint32_t>(integer(gl, GL_MAX_VERTEX_ATTRIBS)), kMaxVertexAttributes);
    limits.maxSamples = std::min(static_cast<uint32_t>(integer(gl, GL_MAX_SAMPLES)), 4u);
    if (quirks.anisotropy) gl.GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &limits.maxAnisotropy);
    info.features = {
        .mergedPasses = quirks.framebufferFetch && quirks.indexedBlend,
        .timers = quirks.timers,
        .blockCompression = quirks.blockCompression,
        .exactSrgbBlocks = quirks.blockCompression && quirks.exactSrgbBlocks,
        .depthClamp = quirks.depthClamp,
        .lastVertexProvokes = true, // the only convention of OpenGL ES
        .depthResolve = true,       // ES 3.1 samples multisampled depth
        .textureViews = quirks.textureViews,
        .cubeArrays = quirks.cubeArrays,
        .srgbAttachments = quirks.srgbWriteControl,
        .primitiveIds = quirks.primitiveIds,
        .halfFloatShaders = true,
    };
    return info;
}

} // namespace filament_core::backend::gles
