// SPDX-License-Identifier: Apache-2.0
// Size: a list of small classes, one for each defect, and their table.
#include "toolkit/mutations/Mutations.h"

#include "base/math/Half.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/Package.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>

namespace filament::tools {
namespace {

using namespace backend;

using Bytes = std::vector<std::byte>;

float readFloat(Bytes const& bytes, size_t at) {
    float value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}
void writeFloat(Bytes& bytes, size_t at, float value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); }

/// Memory for changed payloads, valid until the next stream.
class PayloadEdit : public StreamEdit {
public:
    void inspect(CommandView) override { mPayloads.clear(); }

protected:
    Bytes& copy(std::span<const std::byte>& bytes) {
        Bytes& own = mPayloads.emplace_back(bytes.begin(), bytes.end());
        bytes = own;
        return own;
    }

private:
    std::deque<Bytes> mPayloads; // grows without moving its elements
};

/// Changes values of specialization constants.
class ConstantEdit : public StreamEdit {
public:
    using StreamEdit::edit;
    void inspect(CommandView) override { mChanged.clear(); }
    void edit(CmdCreateProgram& command) override {
        auto& constants = mChanged.emplace_back(command.desc.constants.begin(), command.desc.constants.end());
        for (ConstantValue& constant : constants) editConstant(command.desc.debugName, constant);
        command.desc.constants = constants;
    }

protected:
    /// `program`: its name, with the values of the constants in full-screen materials: "fxaa/0/0/0".
    virtual void editConstant(std::string_view program, ConstantValue& constant) const = 0;

private:
    std::deque<std::vector<ConstantValue>> mChanged; // grows without moving its elements
};

/// The lit glTF materials: their parameter blocks, and the layouts that identify their bind groups.
std::vector<shader::MaterialPackage> const& litPackages() {
    static const std::vector<shader::MaterialPackage> packages = [] {
        std::vector<shader::MaterialPackage> read;
        for (const char* name :
             { "gltf_lit_opaque", "gltf_lit_masked", "gltf_lit_blended", "gltf_transmissive_solid_opaque" }) {
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

/// The discs of suns 1 % wider.
class DiscWiderEdit final : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mRadii.clear();
        replay(commands, *this);
    }
    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBindGroup const& command) {
        constexpr uint64_t kTangent = 11 * sizeof(float); // axisZ.w of sun_disc.mat
        mGroups.erase(command.handle);
        if (command.desc.debugName != "sun_disc") return;
        for (BindGroupEntry const& entry : command.desc.entries)
            mGroups[command.handle].emplace_back(entry.buffer, entry.offset + kTangent);
    }
    void execute(CmdBindGroup const& command) {
        const auto group = mGroups.find(command.group);
        if (group != mGroups.end()) mRadii.insert(mRadii.end(), group->second.begin(), group->second.end());
    }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) override {
        for (auto const& [buffer, at] : mRadii) {
            if (buffer != command.buffer || at + sizeof(float) > command.bytes.size()) continue;
            Bytes& bytes = copy(command.bytes);
            writeFloat(bytes, at, 1.01f * readFloat(bytes, at));
        }
    }

private:
    using Places = std::vector<std::pair<BufferHandle, uint64_t>>;

    std::map<BindGroupHandle, Places> mGroups;
    Places mRadii; // of blocks that draws of this stream read
};

/// Inverts green in normal maps: the picture of a loader that assumes DirectX's convention.
class NormalYEdit final : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mNormalMaps.clear();
        findLitGroups(commands, [&](shader::MaterialPackage const& package, std::span<const BindGroupEntry> entries) {
            shader::Parameter const* map = package.findParameter("normalMap");
            for (BindGroupEntry const& entry : entries) {
                if (map && entry.texture && entry.binding == map->binding) mNormalMaps.insert(entry.texture);
            }
        });
    }

    using PayloadEdit::edit;
    void edit(CmdUploadTexture& command) override {
        if (!mNormalMaps.contains(command.texture)) return;
        Bytes& texels = copy(command.bytes); // the loader converts every normal map to RGBA8
        for (size_t i = 1; i < texels.size(); i += 4) texels[i] = ~texels[i];
    }

private:
    std::set<TextureHandle> mNormalMaps;
};

/// Changes values in the uniform data of a frame.
class FrameEdit : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mHasLights = false;
        replay(commands, *this);
    }

    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBuffer const& command) {
        if (command.desc.debugName == "frame") mFrames.insert(command.handle);
        if (command.desc.debugName == "lights") mLights.insert(command.handle);
        if (command.desc.debugName == "froxels") mFroxels.insert(command.handle);
    }
    void execute(CmdUpdateBuffer const& command) { mHasLights = mHasLights || mLights.contains(command.buffer); }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) override {
        if (mFrames.contains(command.buffer)) changeFrame(command);
        if (mLights.contains(command.buffer)) changeLights(command);
        if (mFroxels.contains(command.buffer)) changeFroxels(command);
    }

protected:
    virtual void changeFrame(CmdUpdateBuffer&) {}
    virtual void changeLights(CmdUpdateBuffer&) {}
    virtual void changeFroxels(CmdUpdateBuffer&) {}
    bool hasLights() const { return mHasLights; }

private:
    std::set<BufferHandle> mFrames, mLights, mFroxels;
    bool mHasLights = false;
};

/// The first punctual light, or the sun if there is none.
class LightOffEdit final : public FrameEdit {
    void changeLights(CmdUpdateBuffer& command) override {
        zeroColor(command, offsetof(shader::PunctualLight, colorIntensity));
    }
    void changeFrame(CmdUpdateBuffer& command) override {
        if (!hasLights()) zeroColor(command, offsetof(shader::FrameUniforms, sunIlluminance));
    }
    void zeroColor(CmdUpdateBuffer& command, size_t at) {
        Bytes& bytes = copy(command.bytes);
        for (size_t i = 0; i < 3; ++i) writeFloat(bytes, at + 4 * i, 0);
    }
};

/// What blends in any order weighs the same at any distance.
class OneWeightEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        writeFloat(copy(command.bytes), offsetof(shader::FrameUniforms, jitter) + 2 * sizeof(float), 0);
    }
};

/// Diffuse light of the environment in coefficients: where it has no cube, or the quality asks for them.
class IrradianceShEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t begin = offsetof(shader::FrameUniforms, irradianceSh);
        for (size_t at = begin; at < begin + sizeof(shader::FrameUniforms::irradianceSh); at += 4)
            writeFloat(bytes, at, 1.01f * readFloat(bytes, at));
    }
};

/// Diffuse light of the environment in its cube, which shading reads by default.
class IrradianceEdit final : public PayloadEdit {
public:
    using PayloadEdit::edit;
    void edit(CmdCreateTexture& command) override {
        if (command.desc.debugName.ends_with(" irradiance")) mCubes.insert(command.handle);
    }
    void edit(CmdUploadTexture& command) override {
        if (!mCubes.contains(command.texture)) return;
        Bytes& texels = copy(command.bytes); // always RGBA16F
        for (size_t at = 0; at + sizeof(uint16_t) <= texels.size(); at += sizeof(uint16_t)) {
            uint16_t half;
            std::memcpy(&half, texels.data() + at, sizeof(half));
            half = halfFromFloat(1.01f * floatFromHalf(half));
            std::memcpy(texels.data() + at, &half, sizeof(half));
        }
    }

private:
    std::set<TextureHandle> mCubes;
};

/// In every block of the frame: channels of lights have blocks of their own.
class FogDensityEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogMedium);
        writeFloat(bytes, at, readFloat(bytes, at) + 0.00995f); // the logarithm of 1.01
    }
};

class FogGlowEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogSun) + 3 * sizeof(float);
        writeFloat(bytes, at, 1.02f * readFloat(bytes, at));
    }
};

class ContactReachEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, contactShadows);
        writeFloat(bytes, at, 0.9f * readFloat(bytes, at));
    }
};

/// The maps of lights of the list are not read.
class ListedShadowsEdit final : public FrameEdit {
    void changeLights(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t map = offsetof(shader::PunctualLight, offset) + sizeof(float);
        for (size_t at = map; at < bytes.size(); at += sizeof(shader::PunctualLight)) writeFloat(bytes, at, 0);
    }
};

/// What area lights read behind the froxels.
bool isLtcTable(CmdUpdateBuffer const& command) { return command.bytes.size() == sizeof(shader::kLtcTable); }

/// Axes of unit length: words of froxels are tiny as floats.
bool isProfiledLights(CmdUpdateBuffer const& command) {
    if (command.bytes.empty() || command.bytes.size() % (shader::kProfiledLightWords * sizeof(float)) != 0)
        return false;
    float3 axis;
    std::memcpy(&axis, command.bytes.data(), sizeof(axis));
    return std::abs(glm::length(axis) - 1) < 1e-3f;
}

bool isProfileTable(CmdUpdateBuffer const& command) {
    std::array<uint32_t, 2> size{}; // rows, columns
    if (command.bytes.size() < shader::kProfileHeaderWords * sizeof(uint32_t)) return false;
    std::memcpy(size.data(), command.bytes.data(), sizeof(size));
    if (size[0] < 2 || size[0] > 1000 || size[1] < 1 || size[1] > 1000) return false;
    const size_t words = shader::kProfileHeaderWords + (size_t{ size[0] } * size[1] + 1) / 2;
    return command.bytes.size() == words * sizeof(uint32_t);
}

/// The first area of the list, 1 % wider.
class AreaEdgeEdit final : public FrameEdit {
    void changeLights(CmdUpdateBuffer& command) override {
        for (size_t at = 0; at + sizeof(shader::PunctualLight) <= command.bytes.size();
             at += sizeof(shader::PunctualLight)) {
            const size_t color = at + offsetof(shader::PunctualLight, colorIntensity);
            const size_t edge = at + offsetof(shader::PunctualLight, directionScale);
            Bytes& bytes = copy(command.bytes);
            if (readFloat(bytes, color + 3 * sizeof(float)) < float{ shader::kShapeRect }) continue;
            for (size_t i = 0; i < 3; ++i) writeFloat(bytes, edge + 4 * i, 1.01f * readFloat(bytes, edge + 4 * i));
            return;
        }
    }
};

/// Every lobe of area lights 1 % wider.
class LtcTableEdit final : public FrameEdit {
    void changeFroxels(CmdUpdateBuffer& command) override {
        if (!isLtcTable(command)) return;
        Bytes& bytes = copy(command.bytes);
        for (size_t at = 2 * sizeof(float); at < bytes.size(); at += 3 * sizeof(float))
            writeFloat(bytes, at, 1.01f * readFloat(bytes, at));
    }
};

/// The profile of the last light that has one, turned by half a degree.
class ProfileTurnEdit final : public FrameEdit {
    void changeFroxels(CmdUpdateBuffer& command) override {
        if (isLtcTable(command) || !isProfiledLights(command)) return;
        Bytes& bytes = copy(command.bytes);
        const size_t last = bytes.size() - shader::kProfiledLightWords * sizeof(float);
        float3 axis;
        std::memcpy(&axis, bytes.data() + last, sizeof(axis));
        axis += 0.01f * glm::cross(axis, float3(1, -1, 1));
        std::memcpy(bytes.data() + last, &axis, sizeof(axis));
    }
};

/// Every profile 1 % narrower: more rows a radian.
class ProfileTableEdit final : public FrameEdit {
    void changeFroxels(CmdUpdateBuffer& command) override {
        if (!isProfileTable(command)) return;
        Bytes& bytes = copy(command.bytes);
        writeFloat(bytes, 8, 1.01f * readFloat(bytes, 8));
    }
};

/// Every froxel's list without its last light. The first list begins behind the words of the froxels.
class FroxelEndEdit final : public FrameEdit {
    void changeFroxels(CmdUpdateBuffer& command) override {
        if (isLtcTable(command) || isProfiledLights(command) || isProfileTable(command)) return;
        Bytes& bytes = copy(command.bytes);
        uint32_t* const words = reinterpret_cast<uint32_t*>(bytes.data());
        const uint32_t froxels = words[0] >> shader::kFroxelCountBits;
        for (uint32_t i = 0; i < froxels; ++i) words[i] -= words[i] % (1u << shader::kFroxelCountBits) > 0 ? 1 : 0;
    }
};

/// No froxels: every fragment tries every light of the view.
class OneListEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        for (size_t i = 0; i < 4; ++i) writeFloat(bytes, offsetof(shader::FrameUniforms, froxelGrid) + 4 * i, 0);
    }
};

/// Draws whose light list is not that of the view read that of the view: its uniforms replace those of the others.
class ChannelsOffEdit final : public FrameEdit {
    void inspect(CommandView commands) override {
        FrameEdit::inspect(commands);
        mOfView.clear();
    }
    void changeFrame(CmdUpdateBuffer& command) override {
        constexpr size_t kCamera = sizeof(shader::FrameUniforms::clipFromWorld);
        if (mOfView.empty()) mOfView.assign(command.bytes.begin(), command.bytes.end());
        if (std::ranges::equal(command.bytes.first(kCamera), std::span(mOfView).first(kCamera)))
            std::ranges::copy(mOfView, copy(command.bytes).begin());
    }

    Bytes mOfView;
};

class SrgbDroppedEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreateTexture& command) override {
        if (command.desc.format == Format::RGBA8Srgb) command.desc.format = Format::RGBA8;
    }
};

/// Changes one code of one texel of a mip level by one, in textures with one layer and four bytes per texel.
class MipTexelEdit final : public PayloadEdit {
public:
    MipTexelEdit(uint32_t level, uint32_t texel) : mLevel(level), mTexel(texel) {}

    using PayloadEdit::edit;
    void edit(CmdUploadTexture& command) override {
        const bool isSmallest = command.level > 0 && command.rect.width == 1 && command.rect.height == 1;
        if (mLevel == kSmallestLevel ? !isSmallest : command.level != mLevel) return;
        const size_t at = size_t{ mTexel } * 4;
        if (at < command.bytes.size()) copy(command.bytes)[at] ^= std::byte{ 1 };
    }

private:
    uint32_t mLevel, mTexel;
};

class MipBiasEdit final : public PayloadEdit {
public:
    using PayloadEdit::edit;
    void edit(CmdCreateProgram& command) override {
        const std::span words(reinterpret_cast<const uint32_t*>(command.desc.fragment.data()),
                              command.desc.fragment.size() / sizeof(uint32_t));
        const std::vector<uint32_t> biased = withMipBias(words, 0.5f);
        std::span<const std::byte> bytes = std::as_bytes(std::span(biased));
        copy(bytes);
        command.desc.fragment = bytes;
    }
};

/// The condition that hideConstantOutputs() gives constant outputs, as SPIRV-Cross writes it, becomes known.
std::string withShownConstants(std::string_view essl) {
    constexpr std::string_view kNeverTrue = "gl_VertexID == 2147483647";
    std::string text(essl);
    for (size_t at = 0; (at = text.find(kNeverTrue, at)) != std::string::npos;)
        text.replace(at, kNeverTrue.size(), "false");
    return text;
}

/// Undoes hideConstantOutputs() (shaders/compiler/OpaqueOutputs.h): the linker sees constant outputs again.
class ConstantOutputsEdit final : public PayloadEdit {
public:
    using PayloadEdit::edit;
    void edit(CmdCreateProgram& command) override {
        const std::string_view text(reinterpret_cast<const char*>(command.desc.vertex.data()),
                                    command.desc.vertex.size());
        const std::string shown = withShownConstants(text);
        std::span<const std::byte> bytes = std::as_bytes(std::span(shown));
        copy(bytes);
        command.desc.vertex = bytes;
    }
};

/// Edits the blocks of PassUniforms and of the materials of full-screen passes.
class PassBlocksEdit : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        replay(commands, *this);
    }
    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBuffer const& command) {
        if (command.desc.debugName == "pass blocks") mBlocks.insert(command.handle);
    }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) final {
        if (mBlocks.contains(command.buffer)) editBlocks(copy(command.bytes));
    }

private:
    virtual void editBlocks(Bytes& bytes) = 0;

    std::set<BufferHandle> mBlocks;
};

/// The pass that draws the scene believes that its target has 3 % fewer pixels each way: its block is the first.
class TargetSizeEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (const size_t at : { size_t{ 0 }, sizeof(float) }) writeFloat(bytes, at, 0.97f * readFloat(bytes, at));
    }
};

/// Samples a pixel of the PassUniforms that begin here with the size of a target and its reciprocal; 0: none do.
float samplesAt(Bytes const& bytes, size_t at) {
    const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
    const auto isReciprocal = [&](size_t i) { return std::abs(number(i) * number(i + 2) - 1) < 1e-5f; };
    const bool isTarget = number(0) >= 1 && isReciprocal(0) && isReciprocal(1);
    return isTarget && (number(4) == 1 || number(4) == 4) ? number(4) : 0;
}

/// Of all PassUniforms only those of passes that refract or reflect a picture have a third number in `raster`.
bool isBeforePicture(Bytes const& bytes, size_t at) {
    const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
    return samplesAt(bytes, at) > 0 && number(6) >= 1 && number(10) > number(8);
}

/// The last blurred level of the picture that is refracted is not read.
class PictureLevelEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (size_t at = 0; at + sizeof(shader::PassUniforms) <= bytes.size(); at += sizeof(float4)) {
            if (!isBeforePicture(bytes, at)) continue;
            const size_t level = at + offsetof(shader::PassUniforms, raster) + 2 * sizeof(float);
            writeFloat(bytes, level, readFloat(bytes, level) - 1);
        }
    }
};

/// Mirrored rays end after 70 % of their reach.
class ReflectionReachEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        constexpr size_t kSteps = offsetof(shader::PassUniforms, reflection), kReach = kSteps + sizeof(float);
        for (size_t at = 0; at + sizeof(shader::PassUniforms) <= bytes.size(); at += sizeof(float4)) {
            if (!isBeforePicture(bytes, at) || readFloat(bytes, at + kSteps) < 8) continue;
            writeFloat(bytes, at + kReach, 0.7f * readFloat(bytes, at + kReach));
        }
    }
};

/// The second peeled layer is the first once more, and so are all after it.
class LayerAgainEdit final : public ConstantEdit {
    void editConstant(std::string_view, ConstantValue& constant) const override {
        if (constant.id == shader::kQualityTransparency && constant.bits == shader::kTransparencyNextDepth)
            constant.bits = shader::kTransparencyDepth;
    }
};

class ShadowShiftEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdSetViewport& command) override { command.viewport.x += 1; }
};

/// The reach of ambient occlusion in the blocks of passes: a radius below 1 m, followed by its reciprocal.
class OcclusionRadiusEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (size_t at = 0; at + 16 <= bytes.size(); at += 16) {
            const float radius = readFloat(bytes, at);
            const bool isReach = radius > 0 && radius < 1 && readFloat(bytes, at + sizeof(float)) == 1 / radius;
            if (!isReach) continue;
            writeFloat(bytes, at, 1.02f * radius);
            writeFloat(bytes, at + sizeof(float), 1 / (1.02f * radius));
            writeFloat(bytes, at + 2 * sizeof(float), 1.02f * readFloat(bytes, at + 2 * sizeof(float)));
        }
    }
};

class DepthCompareEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.depthStencil.depthWrite) command.desc.depthStencil.depthCompare = CompareOp::Always;
    }
};

/// What moves by itself is not drawn into the texture of motion.
class StillObjectsEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.debugName != "motion") return;
        for (BlendState& blend : command.desc.blend) blend.writeMask = 0;
    }
};

/// Of the lobes of bloom only the narrowest is left.
class BloomLevelsEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.debugName != "bloom_up") return;
        for (BlendState& blend : command.desc.blend) blend.writeMask = 0;
    }
};

/// Turns a switch of a full-screen material over.
class SwitchEdit final : public ConstantEdit {
public:
    /// `constant`: its place among those of the .mat file.
    SwitchEdit(std::string_view material, uint32_t constant) : mMaterial(material), mConstant(constant) {}

private:
    void editConstant(std::string_view program, ConstantValue& constant) const override {
        if (program.substr(0, program.find('/')) == mMaterial && constant.id == mConstant) constant.bits ^= 1;
    }

    std::string_view mMaterial;
    uint32_t mConstant;
};

/// The tone-aware resolve looks at two of four samples.
class ResolveSamplesEdit final : public ConstantEdit {
    void editConstant(std::string_view program, ConstantValue& constant) const override {
        if (program.starts_with("msaa_resolve") && constant.type == ConstantValue::Type::Int) constant.bits = 2;
    }
};

/// Textures are read at the mip levels of the pixels that are drawn.
class DrawnLevelsEdit final : public ConstantEdit {
    void editConstant(std::string_view, ConstantValue& constant) const override {
        if (constant.id == shader::kQualityMipBias) constant.bits = 0;
    }
};

/// Surfaces believe that their target has one sample a pixel.
class CoverageOffEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (size_t at = 0; at + sizeof(shader::PassUniforms) <= bytes.size(); at += sizeof(float4)) {
            if (samplesAt(bytes, at) > 1) writeFloat(bytes, at + offsetof(shader::PassUniforms, raster), 1);
        }
    }
};

/// Those of finish.mat.
enum FinishConstant : uint32_t {
    kAutoExposure = 4,
    kGraded = 5,
    kAberration = 7,
    kHasVignette = 8,
    kGrain = 9,
    kOutputSpace = 10,
    kAdaptsToNight = 11,
    kIsDirty = 13,
    kHasFlare = 14
};
template <uint32_t Constant>
std::unique_ptr<StreamEdit> makeFinish() {
    return std::make_unique<SwitchEdit>("finish", Constant);
}

/// Each frame counts half as much in the picture that is gathered over frames.
class GatheredWeightEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        constexpr size_t kBlock = 24 * sizeof(float); // a matrix, 1 / size, jitter, weight, ramp, 1 / size
        for (size_t at = 0; at + kBlock <= bytes.size(); at += sizeof(float4)) {
            const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
            const auto isReciprocal = [&](size_t i) {
                const float size = number(i) > 0 ? 1 / number(i) : 0;
                return size >= 1 && size < 20'000 && std::abs(size - std::round(size)) < 1e-2f;
            };
            const bool isGathering = isReciprocal(16) && isReciprocal(17) && std::abs(number(18)) <= 0.5f &&
                                     std::abs(number(19)) <= 0.5f && number(20) > 0 && number(20) < 1 &&
                                     number(21) >= 0 && number(21) <= 0.5f && isReciprocal(22) && isReciprocal(23);
            if (isGathering) writeFloat(bytes, at + 20 * sizeof(float), 0.5f * number(20));
        }
    }
};

/// Ghosts and halo of the lens 2 % off: in blocks of flare.mat, which begin with the size of the picture and the
/// reciprocal of whole blocks of pixels, followed by eight ghosts and the halo.
class FlarePlacesEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        constexpr size_t kGhosts = 4, kHalo = 36, kWords = 40;
        for (size_t at = 0; at + kWords * sizeof(float) <= bytes.size(); at += sizeof(float4)) {
            const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
            const auto isWholeBlocks = [&](size_t i) {
                const auto isOf = [&](float block) {
                    return std::abs(block * std::ceil(number(i) / block) * number(i + 2) - 1) < 1e-5f;
                };
                return number(i) >= 1 && (isOf(1) || isOf(2) || isOf(4) || isOf(8));
            };
            const auto isPlace = [&](size_t i) { // radius, level and share behind it
                return number(i + 1) >= 0 && number(i + 2) >= 0 && number(i + 2) == std::floor(number(i + 2)) &&
                       number(i + 3) >= 0 && number(i + 3) <= 1;
            };
            bool isFlare = isWholeBlocks(0) && isWholeBlocks(1) && number(kHalo) >= 0.05f * number(1) &&
                           number(kHalo) <= number(1) && isPlace(kHalo);
            for (size_t i = kGhosts; i < kHalo; i += 4) isFlare = isFlare && isPlace(i);
            if (!isFlare) continue;
            for (size_t i = kGhosts; i <= kHalo; i += 4) writeFloat(bytes, at + i * sizeof(float), 1.02f * number(i));
        }
    }
};

class DebugThroughEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.debugName == "debug_draw") command.desc.depthStencil.depthCompare = CompareOp::Always;
    }
};

class StencilOffEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override { command.desc.depthStencil.stencilTest = false; }
};

class CullFaceEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.raster.cull == CullMode::Back) command.desc.raster.cull = CullMode::Front;
    }
};

class BlendOffEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        for (BlendState& blend : command.desc.blend) blend.enabled = false;
    }
};

class WrapModeEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreateSampler& command) override {
        for (WrapMode* wrap : { &command.desc.wrapU, &command.desc.wrapV }) {
            if (*wrap == WrapMode::Repeat) *wrap = WrapMode::MirroredRepeat;
        }
    }
};

template <class E>
std::unique_ptr<StreamEdit> make() {
    return std::make_unique<E>();
}
std::unique_ptr<StreamEdit> roughness() { return std::make_unique<ParameterEdit>("roughnessFactor", 1, 1.01f); }
std::unique_ptr<StreamEdit> metallic() { return std::make_unique<ParameterEdit>("metallicFactor", 1, 0.98f); }
std::unique_ptr<StreamEdit> emissive() { return std::make_unique<ParameterEdit>("emissiveFactor", 3, 1.02f); }
std::unique_ptr<StreamEdit> lastMip() { return mipTexelEdit(kSmallestLevel, 0); }
std::unique_ptr<StreamEdit> thickness() { return std::make_unique<ParameterEdit>("thickness", 1, 1.05f); }
std::unique_ptr<StreamEdit> bump() { return std::make_unique<ParameterEdit>("bumpFactor", 1, 1.05f); }
std::unique_ptr<StreamEdit> cutoff() { return std::make_unique<ParameterEdit>("_maskThreshold", 1, 1.05f); }

constexpr Mutation kMutations[] = {
    { kNoDefect, "nothing: must not be noticed", make<StreamEdit> },
    { kOneList, "one list of lights instead of froxels: must not be noticed", make<OneListEdit> },
    { "roughness", "roughness + 1 %", roughness },
    { "normalY", "normal maps with y flipped", make<NormalYEdit> },
    { "srgb", "sRGB decoding dropped", make<SrgbDroppedEdit> },
    { "lightOff", "one light off", make<LightOffEdit> },
    { "mipBias", "mip bias + 0.5", make<MipBiasEdit>, Backend::Vulkan },
    { "lastMip", "one code of the smallest mip level one off", lastMip },
    { "depthCompare", "depth test always passes", make<DepthCompareEdit> },
    { "cullFace", "front faces culled instead of back faces", make<CullFaceEdit> },
    { "blendOff", "blending off", make<BlendOffEdit> },
    { "wrapMode", "repeating textures mirrored", make<WrapModeEdit> },
    { "irradiance", "irradiance + 1 %", make<IrradianceEdit> },
    { "irradianceSh", "irradiance in harmonics + 1 %", make<IrradianceShEdit> },
    { "metallic", "metallic - 2 %", metallic },
    { "emissive", "emission + 2 %", emissive },
    { "cutoff", "alpha cutoff + 5 %", cutoff },
    { "targetSize", "the scene's target 3 % smaller, for shaders", make<TargetSizeEdit> },
    { "thickness", "thickness of solids + 5 %", thickness },
    { "bump", "bumps 5 % higher", bump },
    { "pictureLevel", "the refracted picture without its last blurred level", make<PictureLevelEdit> },
    { "reflectionReach", "mirrored rays 30 % shorter", make<ReflectionReachEdit> },
    { "oneWeight", "what blends in any order weighs the same at any distance", make<OneWeightEdit> },
    { "layerAgain", "every peeled layer is the nearest one", make<LayerAgainEdit> },
    { "stillObjects", "objects that move show no motion of their own", make<StillObjectsEdit> },
    { "bloomLevels", "bloom without its wider lobes", make<BloomLevelsEdit> },
    { "bloomResolution", "the picture is halved for bloom where it is to be quartered, and the other way round",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("bloom_down", 1); } },
    { "fxaaBrightness", "FXAA takes the picture's values for light",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("fxaa", 0); } },
    { "upscaleFilter", "another filter makes the picture larger",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("upscale", 0); } },
    { "sharpenedLight", "sharpening takes the picture's values for light",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("sharpen", 0); } },
    { "resolveSamples", "two of four samples become the pixel where displays weigh them", make<ResolveSamplesEdit> },
    { "drawnLevels", "textures at the mip levels of the pixels that are drawn", make<DrawnLevelsEdit> },
    { "coverageOff", "alpha does not reach the coverage", make<CoverageOffEdit> },
    { "alphaSwapped", "colours multiplied by alpha where they are to be divided by it, and the other way round",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("alpha", 0); } },
    { "stencilOff", "stencil test off", make<StencilOffEdit> },
    { "debugThrough", "surfaces do not hide debug drawing", make<DebugThroughEdit> },
    { "exposureOff", "no auto exposure", makeFinish<kAutoExposure> },
    { "histogramOff", "the debug view of the histogram shows none",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("debug_histogram", 0); } },
    { "gradingOff", "no grading by formula", makeFinish<kGraded> },
    { "fringesOff", "no chromatic aberration", makeFinish<kAberration> },
    { "vignetteOff", "no vignette", makeFinish<kHasVignette> },
    { "grainOff", "no grain", makeFinish<kGrain> },
    { "outputSpace", "another colour space of the display", makeFinish<kOutputSpace> },
    { "nightOff", "no vision at night", makeFinish<kAdaptsToNight> },
    { "dirtOff", "no dirt on the lens", makeFinish<kIsDirty> },
    { "flareOff", "no lens flare", makeFinish<kHasFlare> },
    { "flarePlaces", "ghosts and halo of the lens 2 % off their places", make<FlarePlacesEdit> },
    { "toneMapper", "another tone mapper by formula",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("tonemap", 1); } },
    { "focusTiles", "blur does not reach into the next tile",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("focus_tiles", 0); } },
    { "wayTiles", "motion blur does not reach into the next tile",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("motion_blur_tiles", 0); } },
    { "gatheredWeight", "frames count half as much in the gathered picture", make<GatheredWeightEdit> },
    { "froxelEnd", "froxels without their last light", make<FroxelEndEdit> },
    { "channelsOff", "every light shines on everything, whatever the channels", make<ChannelsOffEdit> },
    { "shadowShift", "shadow maps drawn one texel to the side", make<ShadowShiftEdit> },
    { "listedShadows", "no shadows of lights besides the brightest sun", make<ListedShadowsEdit> },
    { "fogDensity", "fog 1 % denser", make<FogDensityEdit> },
    { "fogGlow", "the glow of the sun in the fog 2 % narrower", make<FogGlowEdit> },
    { "contactReach", "contact shadows 10 % shorter", make<ContactReachEdit> },
    { "occlusionRadius", "ambient occlusion reaches 2 % farther", make<OcclusionRadiusEdit> },
    { "discWider", "the discs of suns 1 % wider", make<DiscWiderEdit> },
    { "areaEdge", "the first area light 1 % wider", make<AreaEdgeEdit> },
    { "profileTurn", "the last light profile turned by half a degree", make<ProfileTurnEdit> },
    { "profileTable", "light profiles 1 % narrower", make<ProfileTableEdit> },
    { "ltcTable", "the lobes of area lights 1 % wider", make<LtcTableEdit> },
    { "constantOutputs", "linkers may know constant vertex outputs", make<ConstantOutputsEdit>, Backend::Gles },
};

} // namespace

std::span<const Mutation> mutations() { return kMutations; }

Mutation const* findMutation(std::string_view name) {
    const auto found = std::find_if(std::begin(kMutations), std::end(kMutations),
                                    [&](Mutation const& mutation) { return mutation.name == name; });
    return found == std::end(kMutations) ? nullptr : found;
}

bool isControl(std::string_view name) { return name == kNoDefect || name == kOneList; }

std::vector<std::string_view> mutationNames() {
    std::vector<std::string_view> names;
    for (Mutation const& mutation : kMutations) names.push_back(mutation.name);
    return names;
}

std::unique_ptr<StreamEdit> mipTexelEdit(uint32_t level, uint32_t texel) {
    return std::make_unique<MipTexelEdit>(level, texel);
}

// SPIR-V 1.6 specification: 2.3 (instructions), 3.14 (image operands; Bias is bit 0 and so its operand comes first).
std::vector<uint32_t> withMipBias(std::span<const uint32_t> module, float bias) {
    constexpr uint32_t kHeader = 5, kOpTypeFloat = 22, kOpConstant = 43, kOpImageSampleImplicitLod = 87, kBias = 1;
    std::vector<uint32_t> result(module.begin(), module.begin() + std::min<size_t>(kHeader, module.size()));
    if (module.size() < kHeader) return result;
    const uint32_t constant = result[3]++; // a new id within the bound
    for (size_t at = kHeader; at < module.size();) {
        const uint32_t words = module[at] >> 16, op = module[at] & 0xFFFF;
        if (words == 0 || at + words > module.size()) break;
        std::vector<uint32_t> instruction(module.begin() + at, module.begin() + at + words);
        const bool hasMask = words > 5;
        if (op == kOpImageSampleImplicitLod && !(hasMask && instruction[5] & kBias)) {
            if (!hasMask) instruction.push_back(0);
            instruction[5] |= kBias;
            instruction.insert(instruction.begin() + 6, constant);
            instruction[0] = static_cast<uint32_t>(instruction.size()) << 16 | op;
        }
        result.insert(result.end(), instruction.begin(), instruction.end());
        if (op == kOpTypeFloat && words == 3 && instruction[2] == 32)
            result.insert(result.end(),
                          { 4u << 16 | kOpConstant, instruction[1], constant, std::bit_cast<uint32_t>(bias) });
        at += words;
    }
    return result;
}

} // namespace filament::tools
