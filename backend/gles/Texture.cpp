// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Texture.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

// Creation and uploads bind to this unit. ContextState knows, and draws rebind what they need.
constexpr uint32_t kEditUnit = 0;

struct Area {
    GLint x, y;
    GLsizei width, height;
};

Area areaOf(Rect const& rect) {
    return { rect.x, rect.y, static_cast<GLsizei>(rect.width), static_cast<GLsizei>(rect.height) };
}

void uploadImage(Api const& gl, GLenum target, GLint level, Area area, GlFormat const& format,
                 std::span<const std::byte> bytes) {
    if (format.format == 0) {
        gl.CompressedTexSubImage2D(target, level, area.x, area.y, area.width, area.height, format.internalFormat,
                                   static_cast<GLsizei>(bytes.size()), bytes.data());
    } else {
        gl.TexSubImage2D(target, level, area.x, area.y, area.width, area.height, format.format, format.type,
                         bytes.data());
    }
}

bool is3D(DeviceTextureDesc const& desc) { return desc.type == TextureKind::Texture3D; }

uint32_t mostTexels(DeviceLimits const& limits, DeviceTextureDesc const& desc) {
    return is3D(desc) ? limits.max3DTextureSize : limits.maxTextureSize;
}

uint32_t largestSide(DeviceTextureDesc const& desc) {
    return std::max({ desc.width, desc.height, is3D(desc) ? uint32_t{ desc.layers } : 1u });
}

void uploadLayers(Api const& gl, GLenum target, GLint level, Area area, GLint layer, GLsizei layers,
                  GlFormat const& format, std::span<const std::byte> bytes) {
    if (format.format == 0) {
        gl.CompressedTexSubImage3D(target, level, area.x, area.y, layer, area.width, area.height, layers,
                                   format.internalFormat, static_cast<GLsizei>(bytes.size()), bytes.data());
    } else {
        gl.TexSubImage3D(target, level, area.x, area.y, layer, area.width, area.height, layers, format.format,
                         format.type, bytes.data());
    }
}

} // namespace

Textures::~Textures() {
    mTextures.forEach([this](Texture& texture) { destroy(texture); });
}

void Textures::allocate(Texture const& texture) {
    Api const& gl = mDevice.gl;
    DeviceTextureDesc const& desc = texture.desc;
    const GLenum format = glFormat(desc.format).internalFormat;
    const auto width = static_cast<GLsizei>(desc.width), height = static_cast<GLsizei>(desc.height);
    mDevice.state.bindTexture(kEditUnit, texture.target, texture.name);
    if (desc.samples > 1) {
        gl.TexStorage2DMultisample(texture.target, desc.samples, format, width, height, GL_TRUE);
        return;
    }
    if (isLayered(texture.target)) {
        gl.TexStorage3D(texture.target, desc.levels, format, width, height, desc.layers);
    } else {
        gl.TexStorage2D(texture.target, desc.levels, format, width, height);
    }
    gl.TexParameteri(texture.target, GL_TEXTURE_MAX_LEVEL, desc.levels - 1);
}

void Textures::create(TextureHandle handle, DeviceTextureDesc const& desc) {
    Texture texture{ .target = glTextureTarget(desc), .desc = desc };
    texture.desc.debugName = {};
    const bool offered = !isCompressed(desc.format) || mDevice.quirks.blockCompression;
    const bool isEncoded =
            has(desc.usage, TextureUsage::ColorAttachment) && attachmentFormat(desc.format) != desc.format;
    if (isEncoded && !mDevice.quirks.srgbWriteControl) {
        mDevice.error(
                DriverErrorKind::Other,
                "texture '{}': this device encodes what passes write to {}, so that it is no attachment; draw to {}, "
                "or see DeviceFeatures::srgbAttachments",
                desc.debugName, formatInfo(desc.format).name, formatInfo(attachmentFormat(desc.format)).name);
    } else if (!offered) {
        mDevice.error(DriverErrorKind::Other,
                      "texture '{}': this device has no {}; see DeviceFeatures::blockCompression", desc.debugName,
                      formatInfo(desc.format).name);
    } else if (const uint32_t most = mostTexels(mDevice.info.limits, desc); largestSide(desc) > most) {
        // Reported here, because GL_INVALID_VALUE would name neither the size nor the limit.
        mDevice.error(DriverErrorKind::Other, "texture '{}': {} texels a side; this device supports at most {}",
                      desc.debugName, largestSide(desc), most);
    } else {
        mDevice.beginCreation();
        mDevice.gl.GenTextures(1, &texture.name);
        allocate(texture);
        if (mDevice.created("texture", desc.debugName)) {
            mDevice.label(GL_TEXTURE, texture.name, desc.debugName);
            texture.bytes = textureBytes(desc);
            mDevice.statistics.deviceBytes += texture.bytes;
        } else {
            destroy(texture);
            texture.name = 0;
        }
    }
    mTextures.put(handle, std::make_unique<Texture>(texture));
}

void Textures::destroy(Texture const& texture) {
    if (texture.name == 0) return;
    for (Texture::View const& view : texture.views) {
        mDevice.state.forgetTexture(view.name);
        mDevice.gl.DeleteTextures(1, &view.name);
    }
    mDevice.state.forgetTexture(texture.name);
    mDevice.gl.DeleteTextures(1, &texture.name);
    mDevice.statistics.deviceBytes -= texture.bytes;
}

void Textures::upload(CmdUploadTexture const& command) {
    Texture const* texture = find(command.texture);
    if (!texture) return;
    const uint64_t layerBytes = imageBytes(texture->desc.format, command.rect.width, command.rect.height);
    FILAMENT_ASSERT(command.bytes.size() == layerBytes * command.layerCount, "an upload brings exactly its texels");
    GlFormat const& format = glFormat(texture->desc.format);
    const Area area = areaOf(command.rect);
    mDevice.state.bindTexture(kEditUnit, texture->target, texture->name);
    if (isLayered(texture->target)) {
        uploadLayers(mDevice.gl, texture->target, command.level, area, command.layer, command.layerCount, format,
                     command.bytes);
        return;
    }
    const GLenum first = texture->target == GL_TEXTURE_CUBE_MAP ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : texture->target;
    for (uint32_t i = 0; i < command.layerCount; ++i) {
        uploadImage(mDevice.gl, first + command.layer + i, command.level, area, format,
                    command.bytes.subspan(i * layerBytes, layerBytes));
    }
}

Texture const* Textures::find(TextureHandle handle) const {
    Texture const* texture = mTextures.find(handle);
    return texture && texture->name ? texture : nullptr;
}

// ---------------------------------------------------------------------------------------------- parts

GLuint Textures::sampledName(TextureHandle handle, TextureRange const& range, std::string_view what) {
    Texture* texture = mTextures.find(handle);
    if (!texture || texture->name == 0) return 0;
    DeviceTextureDesc const& desc = texture->desc;
    const TextureRange part = withCounts(range, desc.levels, desc.layers);
    if (part == TextureRange{ 0, desc.levels, 0, desc.layers }) return texture->name;
    for (Texture::View const& view : texture->views) {
        if (view.range == part) return view.name;
    }
    const GLuint name = createView(*texture, part, what);
    if (name != 0) texture->views.push_back({ part, name });
    return name;
}

GLuint Textures::createView(Texture const& texture, TextureRange const& range, std::string_view what) {
    if (!mDevice.quirks.textureViews) {
        mDevice.error(DriverErrorKind::Other,
                      "bind group '{}': this device has no texture views, so it cannot show a part of a texture; see "
                      "DeviceFeatures::textureViews",
                      what);
        return 0;
    }
    Api const& gl = mDevice.gl;
    GLuint name = 0;
    mDevice.beginCreation();
    gl.GenTextures(1, &name); // has no target until it becomes a view
    gl.TextureView(name, texture.target, texture.name, glFormat(texture.desc.format).internalFormat, range.level,
                   range.levelCount, range.layer, range.layerCount);
    if (mDevice.created("view for bind group", what)) return name;
    gl.DeleteTextures(1, &name);
    return 0;
}

} // namespace filament_core::backend::gles
