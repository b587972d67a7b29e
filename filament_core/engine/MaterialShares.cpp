// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/MaterialShares.h"

#include "base/math/Half.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/ShareSteps.h"
#include "filament_core/engine/materials/TextureParameters.h"

#include <filament_core/RenderAovs.h>

#include <algorithm>
#include <cmath>
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

// ---- texels

/// Where a material reads a texture.
struct TexelPlace {
    int32_t set = 0; ///< of texture coordinates
    bool isTransformed = false;
    float3x3 transform{ 1 }; ///< uv' = (M * (u, v, 1)).xy
};

template <class T>
std::optional<T> constantOf(scene::Material const& material, std::string const& name) {
    for (ConstantDescription const& constant : material.description.constants)
        if (T const* value = std::get_if<T>(&constant.value); value && constant.name == name) return *value;
    return std::nullopt;
}

/// glTF materials say it in constants, "baseColorUv" and "baseColorTransform", and a matrix "baseColorUvMatrix" whose
/// columns are 16 bytes apart. The built-in ones read the first set with v upwards.
std::optional<TexelPlace> texelPlaceOf(scene::MaterialInstance const& instance, std::string const& parameter) {
    scene::Material const& material = *instance.material;
    if (material.package.name == "litTextured" || material.package.name == "unlitTextured")
        return TexelPlace{ .isTransformed = true, .transform = { 1, 0, 0, 0, -1, 0, 0, 1, 1 } };
    if (!material.package.name.starts_with("gltf_") || !parameter.ends_with("Map")) return std::nullopt;
    const std::string stem = parameter.substr(0, parameter.size() - 3);
    const std::optional<int32_t> set = constantOf<int32_t>(material, stem + "Uv");
    const std::optional<bool> transform = constantOf<bool>(material, stem + "Transform");
    shader::Parameter const* const matrix = material.package.findParameter(stem + "UvMatrix");
    if (!set || *set > 1 || !transform || !matrix || matrix->offset + 48 > instance.parameters.size())
        return std::nullopt;
    TexelPlace place{ .set = *set, .isTransformed = *transform };
    for (int column = 0; column < 3; ++column)
        std::memcpy(&place.transform[column], instance.parameters.data() + matrix->offset + 16 * column,
                    sizeof(float3));
    return place;
}

/// Draws a renderable with another instance, and gives back its own.
class ReplacedMaterial {
public:
    ReplacedMaterial(Scene const& scene, Renderable renderable, scene::MaterialInstance const& own,
                     scene::MaterialInstance const& other)
            : mScene(const_cast<Scene::Impl&>(scene.impl())), mRenderable(renderable), mOwn(own) {
        set(other);
    }
    ~ReplacedMaterial() { set(mOwn); }
    ReplacedMaterial(ReplacedMaterial const&) = delete;
    ReplacedMaterial& operator=(ReplacedMaterial const&) = delete;

private:
    void set(scene::MaterialInstance const& instance) {
        scene::setMaterial(mScene.changedUses().renderables, mRenderable, instance);
    }

    Scene::Impl& mScene;
    Renderable mRenderable;
    scene::MaterialInstance const& mOwn;
};

/// Of the instance that shows a texture as its base colour: whatever its alpha is, it is opaque.
Result<Owned<MaterialInstance>> makeProbe(Engine& engine, Material material, scene::MaterialInstance const& own,
                                          std::string const& parameter, TexelPlace const& place) {
    Engine::Impl& impl = engine.impl();
    Owned<MaterialInstance> probe = engine.own(engine.createInstance(material));
    if (!probe.get()) return fail(ErrorCode::OutOfMemory, "explain pixel: no material instance");
    for (Result<void> const& done :
         { engine.set(probe, "baseColorFactor", float4(1)), engine.set(probe, "baseColorUvMatrix", place.transform) })
        if (!done) return done.error();
    scene::MaterialInstance& state = impl.instances.get(probe);
    state.raster = own.raster;
    state.raster.colorWrite = state.raster.depthWrite = state.raster.depthCulling = true;
    state.raster.stencil.reset();
    shader::Parameter const* const from = own.material->package.findParameter(parameter);
    shader::Parameter const* const to = state.material->package.findParameter("baseColorMap");
    state.textures[textureSlot(state.material->package, *to)] = own.textures[textureSlot(own.material->package, *from)];
    state.texturesDirty = true; // and the new instance is listed
    return probe;
}

std::optional<float3> numberAt(Image const& image, uint2 pixel) {
    float4 number(0);
    std::memcpy(&number, image.pixels.data() + (size_t{ pixel.y } * image.width + pixel.x) * sizeof(number),
                sizeof(number));
    return number.w == 1 ? std::optional(float3(number)) : std::nullopt;
}

/// Of one texture; nothing where the probe does not show the surface: something cuts it that the probe does not know.
Result<void> readTexel(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                       scene::MaterialInstance const& own, PixelSurface const& surface, PixelTexture& texture) {
    const std::optional<TexelPlace> place = texelPlaceOf(own, texture.parameter);
    if (!place) return {};
    const Result<Material> made =
            engine.create(MaterialDesc{ .package = engine.impl().enginePackage("gltf_unlit_opaque"),
                                        .constants = { { "hasBaseColorMap", true },
                                                       { "baseColorUv", place->set },
                                                       { "baseColorTransform", place->isTransformed } },
                                        .name = "texels" });
    if (!made) return made.error();
    const Owned<Material> material = engine.own(*made);
    scene::Renderables const& renderables = scene.impl().upToDate().renderables;
    const uint32_t layout =
            renderables.drawables[renderables.drawable[renderables.index.at(surface.renderable)]].geometry.layout;
    if (!missingAttributes(engine.impl().materials.get(material), engine.impl().layouts[layout].vertices).empty())
        return {};
    const Result<Owned<MaterialInstance>> probe = makeProbe(engine, material, own, texture.parameter, *place);
    if (!probe) return probe.error();
    const ReplacedMaterial replaced(scene, surface.renderable, own, engine.impl().instances.get(*probe));
    const Result<std::vector<Image>> numbers =
            renderAovs(engine, scene, view, std::array{ Aov::Depth, Aov::BaseColor, Aov::TextureCoordinates });
    if (!numbers) return numbers.error();
    const std::optional<float3> depth = numberAt((*numbers)[0], pixel);
    if (!depth || std::abs(double{ depth->x } - surface.distanceMeters) > 1e-3 * surface.distanceMeters) return {};
    texture.texel = numberAt((*numbers)[1], pixel);
    const std::optional<float3> uv = numberAt((*numbers)[2], pixel);
    if (uv && place->set == 0) // the number is of the first set
        texture.uv = place->isTransformed ? float2(place->transform * float3(uv->x, uv->y, 1)) : float2(*uv);
    return {};
}

} // namespace

Result<void> readTexels(Engine& engine, Scene const& scene, View const& view, uint2 pixel, MaterialInstance handle,
                        PixelSurface const& surface, std::vector<PixelTexture>& textures) {
    scene::MaterialInstance const& own = engine.impl().instances.get(handle);
    for (PixelTexture& texture : textures) {
        if (texture.parameter.empty()) continue;
        if (Result<void> read = readTexel(engine, scene, view, pixel, own, surface, texture); !read) return read;
    }
    return {};
}

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
