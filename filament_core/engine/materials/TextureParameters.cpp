// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/TextureParameters.h"

#include "backend/api/Format.h"

namespace filament_core::engine {
namespace {

using namespace backend;
using shader::Parameter;
using shader::ParameterType;

const char* kindName(TextureKind type) {
    switch (type) {
    case TextureKind::Texture2D:
        return "a 2D texture";
    case TextureKind::Texture2DArray:
        return "an array";
    case TextureKind::Cube:
        return "a cube";
    case TextureKind::CubeArray:
        return "an array of cubes";
    case TextureKind::Texture3D:
        return "a 3D texture";
    }
    return "a texture";
}

} // namespace

TextureKind textureKindOf(ParameterType sampler) {
    switch (sampler) {
    case ParameterType::Sampler2DArray:
        return TextureKind::Texture2DArray;
    case ParameterType::SamplerCube:
        return TextureKind::Cube;
    case ParameterType::SamplerCubeArray:
        return TextureKind::CubeArray;
    case ParameterType::Sampler3D:
        return TextureKind::Texture3D;
    default:
        return TextureKind::Texture2D;
    }
}

namespace {

shader::SamplerFormat samplerFormatOf(Format format) {
    switch (formatInfo(format).kind) {
    case FormatKind::UnsignedInteger:
        return shader::SamplerFormat::Uint;
    case FormatKind::SignedInteger:
        return shader::SamplerFormat::Int;
    default:
        return shader::SamplerFormat::Float;
    }
}

/// Integers cannot be interpolated.
Sampler unfiltered(Sampler sampler) {
    sampler.magFilter = sampler.minFilter = Filter::Nearest;
    if (sampler.mipFilter == MipFilter::Linear) sampler.mipFilter = MipFilter::Nearest;
    sampler.anisotropy = 1;
    return sampler;
}

Sampler filtered(Sampler sampler, TextureFilter filter) {
    if (filter == TextureFilter::AsAuthored) return sampler;
    sampler.magFilter = sampler.minFilter = Filter::Linear;
    sampler.mipFilter = filter == TextureFilter::Bilinear ? MipFilter::Nearest : MipFilter::Linear;
    sampler.anisotropy = filter == TextureFilter::Anisotropic ? 16 : 1;
    return sampler;
}

} // namespace

Result<void> checkSampler(scene::Material const& material, Parameter const& parameter) {
    if (shader::isTexture(parameter.type) && parameter.type != ParameterType::SubpassInput) return {};
    return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, not a sampler", parameter.name,
                material.name, toString(parameter.type));
}

Result<void> checkTexture(scene::Material const& material, Parameter const& parameter, DeviceTextureDesc const& texture,
                          std::string_view name) {
    if (texture.type != textureKindOf(parameter.type)) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, but texture '{}' is {}",
                    parameter.name, material.name, toString(parameter.type), name, kindName(texture.type));
    }
    static constexpr const char* kFormats[] = { "float", "int", "uint" };
    const shader::SamplerFormat format = samplerFormatOf(texture.format);
    if (format == parameter.format) return {};
    return fail(ErrorCode::InvalidArgument,
                "parameter '{}' of material '{}' is a sampler of format {}, and texture '{}' has the format {}, which "
                "is read with format : {}",
                parameter.name, material.name, kFormats[static_cast<size_t>(parameter.format)], name,
                formatInfo(texture.format).name, kFormats[static_cast<size_t>(format)]);
}

size_t textureSlot(shader::MaterialPackage const& package, Parameter const& parameter) {
    size_t slot = 0;
    for (Parameter const& at : package.parameters) {
        if (&at == &parameter) break;
        slot += shader::isTexture(at.type);
    }
    return slot;
}

Sampler samplerFor(Parameter const& parameter, Sampler const& authored, TextureFilter filter) {
    return parameter.format == shader::SamplerFormat::Float ? filtered(authored, filter) : unfiltered(authored);
}

} // namespace filament_core::engine
