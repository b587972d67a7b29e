// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/MaterialShares.h"

#include "base/math/Half.h"
#include "filament_core/engine/ShareSteps.h"
#include "filament_core/engine/materials/TextureParameters.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace filament_core::engine {
namespace {

using backend::TextureHandle;

// ---- lobes

/// In the order in which they are switched on, after the specular one; by one of the two parameters.
struct LobeParameters {
    std::string_view name, parameter, other;
};
constexpr std::array kLobes{ LobeParameters{ "diffuse", "baseColorFactor", "baseColor" },
                             LobeParameters{ "diffuseTransmission", "diffuseTransmission" },
                             LobeParameters{ "transmission", "transmission" },
                             LobeParameters{ "sheen", "sheenColor" },
                             LobeParameters{ "clearCoat", "clearCoat" },
                             LobeParameters{ "iridescence", "iridescence" },
                             LobeParameters{ "emission", "emissiveFactor", "emissive" } };

/// Of vectors red, green and blue: alpha stays.
size_t factorBytes(ParameterType type) {
    switch (type) {
    case ParameterType::Float:
        return sizeof(float);
    case ParameterType::Float3:
    case ParameterType::Float4:
        return sizeof(float3);
    default:
        return 0;
    }
}

/// The base colour of what is not metal is its diffuse one, and of metal its specular one.
std::string nameOf(LobeParameters const& lobe, PixelSurface const& surface) {
    const bool isOfBase = lobe.name == "diffuse";
    const bool isDiffuse = surface.roughness && surface.metallic.value_or(0) == 0;
    return std::string(isOfBase && !isDiffuse ? "baseColor" : lobe.name);
}

/// Changes the factors of one instance, and gives them back.
class SwitchedInstance {
public:
    SwitchedInstance(Engine::Impl& engine, MaterialInstance handle)
            : mEngine(engine), mHandle(handle), mInstance(engine.instances.get(handle)),
              mParameters(mInstance.parameters), mChanges(engine.instanceChanges) {}
    ~SwitchedInstance() {
        set(mParameters);
        mEngine.instanceChanges = mChanges; // nothing has changed
    }
    SwitchedInstance(SwitchedInstance const&) = delete;
    SwitchedInstance& operator=(SwitchedInstance const&) = delete;

    /// Those that the instance has, and that are not 0.
    std::vector<LobeParameters const*> lobes() const {
        std::vector<LobeParameters const*> found;
        for (LobeParameters const& lobe : kLobes)
            if (!factorOf(lobe).empty()) found.push_back(&lobe);
        return found;
    }

    void switchOff(std::span<LobeParameters const* const> off) {
        std::vector<std::byte> parameters = mParameters;
        for (LobeParameters const* lobe : off) {
            const std::span<const std::byte> factor = factorOf(*lobe);
            std::memset(parameters.data() + (factor.data() - mParameters.data()), 0, factor.size());
        }
        set(parameters);
    }

private:
    std::span<const std::byte> factorOf(LobeParameters const& lobe) const {
        for (const std::string_view name : { lobe.parameter, lobe.other }) {
            shader::Parameter const* const found =
                    name.empty() ? nullptr : mInstance.material->package.findParameter(name);
            const size_t bytes = found && found->arraySize == 0 ? factorBytes(found->type) : 0;
            if (bytes == 0 || found->offset + bytes > mParameters.size()) continue;
            const std::span<const std::byte> factor = std::span(mParameters).subspan(found->offset, bytes);
            if (std::ranges::any_of(factor, [](std::byte byte) { return byte != std::byte{ 0 }; })) return factor;
        }
        return {};
    }

    void set(std::vector<std::byte> const& parameters) {
        mEngine.markDirty(mHandle);
        std::ranges::copy(parameters, mInstance.parameters.begin());
        mInstance.parametersDirty = true;
    }

    Engine::Impl& mEngine;
    MaterialInstance mHandle;
    scene::MaterialInstance& mInstance;
    const std::vector<std::byte> mParameters;
    uint64_t mChanges;
};

// ---- textures

/// Values of a texture that has no effect.
enum class Neutral { White, Black, Normal, Anisotropy, Occlusion };
constexpr size_t kNeutrals = 5;

/// White is 1 for what a texture multiplies. An anisotropy map points along the tangent; the occlusion map of bent
/// normals holds their bend, whose code 128 is straight up.
Neutral neutralOf(scene::Material const& material, std::string_view parameter) {
    if (parameter.ends_with("normalMap") || parameter.ends_with("NormalMap")) return Neutral::Normal;
    if (parameter == "anisotropyMap") return Neutral::Anisotropy;
    if (parameter == "lightMap") return Neutral::Black;
    const auto isBent = [](ConstantDescription const& constant) {
        return constant.name == "hasBentNormals" && constant.value == std::variant<bool, int32_t, float>(true);
    };
    const bool bends = parameter == "occlusionMap" && std::ranges::any_of(material.description.constants, isBent);
    return bends ? Neutral::Occlusion : Neutral::White;
}

/// Of one texel. Half floats hold 0.5 exactly, and codes of bytes 128.
Texture makeNeutral(Engine& engine, Neutral neutral) {
    const auto make = [&](Format format, auto const& texel) {
        return engine.create(
                TextureDesc{ .format = format, .pixels = std::as_bytes(std::span(texel)), .name = "neutral" });
    };
    if (neutral == Neutral::Occlusion) return make(Format::RGBA8, std::array<uint8_t, 4>{ 255, 128, 128, 255 });
    if (neutral == Neutral::Black) return make(Format::RGBA8, std::array<uint8_t, 4>{});
    const float blue = 1, green = 0.5f, red = neutral == Neutral::Normal ? 0.5f : 1.0f;
    const float alpha = neutral == Neutral::Normal ? 0.0f : 1.0f; // no roughness of lost detail
    return make(Format::RGBA16F,
                std::array{ halfFromFloat(red), halfFromFloat(green), halfFromFloat(blue), halfFromFloat(alpha) });
}

struct ShownTexture {
    std::string parameter;
    size_t slot = 0;
    TextureHandle neutral;
};

/// Replaces textures of one instance, and gives them back. Those of the app stand behind all others meanwhile, where no
/// parameter reads them, so that they stay in use and follow what streams them.
class ReplacedTextures {
public:
    ReplacedTextures(Engine& engine, MaterialInstance handle)
            : mApi(engine), mEngine(engine.impl()), mHandle(handle), mInstance(mEngine.instances.get(handle)),
              mCount(mInstance.textures.size()), mChanges(mEngine.instanceChanges) {
        mInstance.textures.reserve(2 * mCount);
        for (size_t slot = 0; slot < mCount; ++slot) mInstance.textures.push_back(mInstance.textures[slot]);
    }
    ~ReplacedTextures() {
        replace({});
        mInstance.textures.resize(mCount);
        mEngine.instanceChanges = mChanges; // nothing has changed
    }
    ReplacedTextures(ReplacedTextures const&) = delete;
    ReplacedTextures& operator=(ReplacedTextures const&) = delete;

    /// Those that the material reads and that the app has set.
    Result<std::vector<ShownTexture>> shown() {
        std::vector<ShownTexture> found;
        scene::Material const& material = *mInstance.material;
        for (shader::Parameter const& parameter : material.package.parameters) {
            if (!shader::isTexture(parameter.type) || !parameter.isBound || parameter.currentPixel ||
                parameter.format != shader::SamplerFormat::Float)
                continue;
            const size_t slot = textureSlot(material.package, parameter);
            const TextureHandle unset = mEngine.textureHandle(mEngine.unsetTexture(parameter));
            if (mInstance.textures[slot].texture == unset) continue;
            const Neutral neutral =
                    parameter.type == ParameterType::Sampler2D ? neutralOf(material, parameter.name) : Neutral::White;
            const Result<TextureHandle> replacement = neutral == Neutral::White ? unset : textureOf(neutral);
            if (!replacement) return replacement.error();
            found.push_back({ parameter.name, slot, *replacement });
        }
        return found;
    }

    void replace(std::span<const ShownTexture> off) {
        mEngine.markDirty(mHandle);
        const auto own = mInstance.textures.begin() + static_cast<std::ptrdiff_t>(mCount);
        std::copy(own, mInstance.textures.end(), mInstance.textures.begin());
        for (ShownTexture const& texture : off) mInstance.textures[texture.slot].texture = texture.neutral;
        mInstance.texturesDirty = true;
    }

    /// Name and size.
    PixelTexture describe(ShownTexture const& shown) const {
        PixelTexture texture{ .parameter = shown.parameter };
        const TextureHandle own = mInstance.textures[mCount + shown.slot].texture;
        mEngine.textures.forEachHeld([&](Texture, TextureState const& state) {
            if (state.handle != own) return;
            texture.texture = state.name;
            texture.size = { state.desc.width, state.desc.height };
        });
        return texture;
    }

private:
    Result<TextureHandle> textureOf(Neutral neutral) {
        Owned<Texture>& texture = mNeutral[static_cast<size_t>(neutral)];
        if (!texture.get()) texture = mApi.own(makeNeutral(mApi, neutral));
        if (!texture.get()) return fail(ErrorCode::OutOfMemory, "explain pixel: no texture");
        return mEngine.textureHandle(texture);
    }

    Engine& mApi;
    Engine::Impl& mEngine;
    MaterialInstance mHandle;
    scene::MaterialInstance& mInstance;
    const size_t mCount;
    const uint64_t mChanges;
    std::array<Owned<Texture>, kNeutrals> mNeutral{};
};

} // namespace

Result<std::vector<PixelLobe>> pixelLobes(Engine& engine, MaterialInstance handle, PixelSurface const& surface,
                                          std::array<uint16_t, 4> const& whole, DrawPixel const& draw) {
    std::vector<PixelLobe> terms;
    SwitchedInstance instance(engine.impl(), handle);
    std::vector<LobeParameters const*> off = instance.lobes();
    // All that metal reflects has the base colour.
    if (surface.metallic == 1.0f) std::erase_if(off, [](auto const* lobe) { return lobe->name == "diffuse"; });
    std::string name = off.empty() ? "all" : surface.roughness ? "specular" : "rest"; // unlit ones reflect nothing
    std::array<uint16_t, 4> before{};
    while (!off.empty()) {
        instance.switchOff(off);
        const Result<std::array<uint16_t, 4>> after = draw();
        if (!after) return after.error();
        terms.push_back({ std::move(name), shareOf(before, *after) });
        before = *after;
        name = nameOf(*off.front(), surface);
        off.erase(off.begin());
    }
    terms.push_back({ std::move(name), shareOf(before, whole) });
    return terms;
}

Result<std::vector<PixelTexture>> pixelTextures(Engine& engine, MaterialInstance handle,
                                                std::array<uint16_t, 4> const& whole, DrawPixel const& draw) {
    std::vector<PixelTexture> terms;
    ReplacedTextures instance(engine, handle);
    Result<std::vector<ShownTexture>> off = instance.shown();
    if (!off) return off.error();
    PixelTexture next; // without any
    std::array<uint16_t, 4> before{};
    while (!off->empty()) {
        instance.replace(*off);
        const Result<std::array<uint16_t, 4>> after = draw();
        if (!after) return after.error();
        next.value = shareOf(before, *after);
        terms.push_back(std::exchange(next, instance.describe(off->front())));
        before = *after;
        off->erase(off->begin());
    }
    if (terms.empty()) return terms;
    next.value = shareOf(before, whole);
    terms.push_back(std::move(next));
    return terms;
}

} // namespace filament_core::engine
