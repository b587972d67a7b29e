// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Edits.h"

#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/Package.h"

#include <algorithm>
#include <map>
#include <set>

namespace filament_core::tools {
namespace {

/// The lit glTF materials: their parameter blocks, and the layouts that identify their bind groups.
std::vector<shader::MaterialPackage> const& litPackages() {
    static const std::vector<shader::MaterialPackage> packages = [] {
        std::vector<shader::MaterialPackage> read;
        for (const char* name : { "gltf_lit_opaque", "gltf_lit_masked", "gltf_lit_blended",
                                  "gltf_transmissive_solid_opaque", "gltf_scattering_opaque" }) {
            if (auto package = shader::readPackage(shader::engineMaterial(name))) read.push_back(std::move(*package));
        }
        return read;
    }();
    return packages;
}

/// Whether the group has the package's parameter block and otherwise only bindings of the package. It may have fewer:
/// textures that a material does not use are removed from its layout.
bool isGroupOf(shader::MaterialPackage const& package, BindGroupDesc const& desc) {
    BindGroupLayout const& whole = package.layout[shader::kGroupMaterial];
    const auto bindings = std::span(whole.bindings).first(whole.count);
    const auto isKnown = [&](BindingDesc const& binding) { return std::ranges::count(bindings, binding) > 0; };
    const auto isBlock = [&](BindGroupEntry const& entry) {
        return entry.buffer && entry.size == package.uniformBytes;
    };
    return std::ranges::all_of(std::span(desc.layout.bindings).first(desc.layout.count), isKnown) &&
           std::ranges::any_of(desc.entries, isBlock);
}

/// Calls `found(package, entries)` for each bind group of a lit material.
template <class Found>
struct GroupFinder {
    Found found;
    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBindGroup const& command) {
        for (shader::MaterialPackage const& package : litPackages()) {
            if (isGroupOf(package, command.desc)) found(package, command.desc.entries);
        }
    }
};

template <class Found>
void findLitGroups(CommandView commands, Found found) {
    GroupFinder<Found> finder{ std::move(found) };
    replay(commands, finder);
}

/// Multiplies a parameter of every lit material.
class ParameterEdit final : public PayloadEdit {
public:
    ParameterEdit(std::string_view parameter, uint32_t components, float factor)
            : mParameter(parameter), mComponents(components), mFactor(factor) {}

    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mOffsets.clear();
        std::map<BufferHandle, uint64_t> sizes;
        findLitGroups(commands, [&](shader::MaterialPackage const& package, std::span<const BindGroupEntry> entries) {
            shader::Parameter const* parameter = package.findParameter(mParameter);
            for (BindGroupEntry const& entry : entries) {
                if (parameter && entry.buffer && entry.size == package.uniformBytes)
                    mOffsets[entry.buffer] = parameter->offset;
            }
        });
    }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) override {
        const auto found = mOffsets.find(command.buffer);
        if (found == mOffsets.end() || command.bytes.size() < found->second + 4 * mComponents) return;
        Bytes& bytes = copy(command.bytes);
        for (uint32_t i = 0; i < mComponents; ++i)
            writeFloat(bytes, found->second + 4 * i, mFactor * readFloat(bytes, found->second + 4 * i));
    }

private:
    const std::string_view mParameter;
    const uint32_t mComponents;
    const float mFactor;
    std::map<BufferHandle, uint32_t> mOffsets; // of the parameter, per block created in this stream
};

/// Changes a channel of the maps of one kind.
class MapEdit final : public PayloadEdit {
public:
    MapEdit(std::string_view map, size_t channel, std::byte (*change)(std::byte))
            : mMap(map), mChannel(channel), mChange(change) {}

    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mMaps.clear();
        findLitGroups(commands, [&](shader::MaterialPackage const& package, std::span<const BindGroupEntry> entries) {
            shader::Parameter const* map = package.findParameter(mMap);
            for (BindGroupEntry const& entry : entries) {
                if (map && entry.texture && entry.binding == map->binding) mMaps.insert(entry.texture);
            }
        });
    }

    using PayloadEdit::edit;
    void edit(CmdUploadTexture& command) override {
        if (!mMaps.contains(command.texture)) return;
        Bytes& texels = copy(command.bytes); // the loader converts all of them to RGBA8
        for (size_t i = mChannel; i < texels.size(); i += 4) texels[i] = mChange(texels[i]);
    }

private:
    const std::string_view mMap;
    const size_t mChannel;
    std::byte (*const mChange)(std::byte);
    std::set<TextureHandle> mMaps;
};

/// Changes the texels of lightmaps.
class LightmapEdit : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mLightmaps.clear();
        findLitGroups(commands, [&](shader::MaterialPackage const& package, std::span<const BindGroupEntry> entries) {
            shader::Parameter const* map = package.findParameter("lightMap");
            for (BindGroupEntry const& entry : entries) {
                if (map && entry.texture && entry.binding == map->binding) mLightmaps.insert(entry.texture);
            }
        });
    }

    using PayloadEdit::edit;
    void edit(CmdUploadTexture& command) final {
        if (mLightmaps.contains(command.texture)) change(command, copy(command.bytes));
    }

protected:
    virtual void change(CmdUploadTexture const& command, Bytes& texels) = 0;

private:
    std::set<TextureHandle> mLightmaps;
};

/// Moves the texels of some levels by one, so that those of one chart lie in the next.
class LightmapShift final : public LightmapEdit {
public:
    explicit LightmapShift(uint8_t firstLevel) : mFirstLevel(firstLevel) {}

private:
    void change(CmdUploadTexture const& command, Bytes& texels) override {
        constexpr ptrdiff_t kTexel = 8; // RGBA16F
        if (command.level >= mFirstLevel) std::rotate(texels.begin(), texels.begin() + kTexel, texels.end());
    }

    const uint8_t mFirstLevel;
};

/// All pages have the texels of the first.
class LightmapPages final : public LightmapEdit {
public:
    void inspect(CommandView commands) override {
        LightmapEdit::inspect(commands);
        mFirst.clear();
    }

private:
    void change(CmdUploadTexture const& command, Bytes& texels) override {
        const auto [first, isFirst] = mFirst.try_emplace(command.level, texels);
        if (!isFirst && first->second.size() == texels.size()) texels = first->second;
    }

    std::map<uint8_t, Bytes> mFirst; // by level
};

/// The picture of a loader that assumes DirectX's convention.
std::unique_ptr<StreamEdit> normalY() {
    return std::make_unique<MapEdit>("normalMap", 1, [](std::byte code) { return ~code; });
}
std::unique_ptr<StreamEdit> bentNormalY() {
    return std::make_unique<MapEdit>("occlusionMap", 2, [](std::byte code) { return ~code; });
}
std::unique_ptr<StreamEdit> normalVariance() {
    return std::make_unique<MapEdit>("normalMap", 3, [](std::byte) { return std::byte{ 0 }; });
}
std::unique_ptr<StreamEdit> roughness() { return std::make_unique<ParameterEdit>("roughnessFactor", 1, 1.01f); }
std::unique_ptr<StreamEdit> metallic() { return std::make_unique<ParameterEdit>("metallicFactor", 1, 0.98f); }
std::unique_ptr<StreamEdit> emissive() { return std::make_unique<ParameterEdit>("emissiveFactor", 3, 1.02f); }
std::unique_ptr<StreamEdit> multiscatter() { return std::make_unique<ParameterEdit>("multiscatterColor", 3, 0.95f); }
std::unique_ptr<StreamEdit> thickness() { return std::make_unique<ParameterEdit>("thickness", 1, 1.05f); }
std::unique_ptr<StreamEdit> bump() { return std::make_unique<ParameterEdit>("bumpFactor", 1, 1.05f); }
std::unique_ptr<StreamEdit> bakedLight() { return std::make_unique<ParameterEdit>("lightIntensity", 1, 1.02f); }
std::unique_ptr<StreamEdit> lightmapShift() { return std::make_unique<LightmapShift>(uint8_t{ 0 }); }
std::unique_ptr<StreamEdit> lightmapLevels() { return std::make_unique<LightmapShift>(uint8_t{ 1 }); }
std::unique_ptr<StreamEdit> lightmapPages() { return std::make_unique<LightmapPages>(); }
std::unique_ptr<StreamEdit> cutoff() { return std::make_unique<ParameterEdit>("_maskThreshold", 1, 1.05f); }

constexpr Mutation kMaterialMutations[] = {
    { "roughness", "roughness + 1 %", roughness },
    { "normalY", "normal maps with y flipped", normalY },
    { "bentNormalY", "bent normals with y flipped", bentNormalY },
    { "normalVariance", "roughness without that of averaged normals", normalVariance },
    { "metallic", "metallic - 2 %", metallic },
    { "emissive", "emission + 2 %", emissive },
    { "bakedLight", "baked light + 2 %", bakedLight },
    { "lightmapShift", "lightmaps moved by a texel", lightmapShift },
    { "lightmapLevels", "smaller levels of lightmaps moved by a texel", lightmapLevels },
    { "lightmapPages", "all pages of a lightmap are the first", lightmapPages },
    { "cutoff", "alpha cutoff + 5 %", cutoff },
    { "multiscatter", "colour of light scattered in solids - 5 %", multiscatter },
    { "thickness", "thickness of solids + 5 %", thickness },
    { "bump", "bumps 5 % higher", bump },
};

} // namespace

std::span<const Mutation> materialMutations() { return kMaterialMutations; }

} // namespace filament_core::tools
