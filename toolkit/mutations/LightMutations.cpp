// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Edits.h"

#include "base/math/Half.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <set>

namespace filament_core::tools {
namespace {

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

/// The brightest sun on the other side, for shading and for its shadow alike.
class SunMirroredEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, sunDirection);
        writeFloat(bytes, at, -readFloat(bytes, at));
    }
};

/// The brightest sun twice: as a light, and in the environment that it was taken out of.
class SunTwiceEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, sunIlluminance);
        for (size_t i = 0; i < 3; ++i) writeFloat(bytes, at + 4 * i, 2 * readFloat(bytes, at + 4 * i));
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

/// The images of all rectangles upside down: half edges the other way.
class AreaImageTurnEdit final : public FrameEdit {
    void changeLights(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        for (size_t at = 0; at + sizeof(shader::PunctualLight) <= bytes.size(); at += sizeof(shader::PunctualLight)) {
            const size_t color = at + offsetof(shader::PunctualLight, colorIntensity);
            if (readFloat(bytes, color + 3 * sizeof(float)) < float{ shader::kShapeImaged }) continue;
            const size_t edge = at + offsetof(shader::PunctualLight, directionScale);
            for (const size_t i : { 0, 1, 2, 3, 4, 7 })
                writeFloat(bytes, edge + 4 * i, -readFloat(bytes, edge + 4 * i));
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

/// The image of the first light that has one, moved by 2 % of its width; of a point light turned.
class CookieShiftEdit final : public FrameEdit {
    void changeImages(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        shader::ImagedLight light;
        std::memcpy(&light, bytes.data(), sizeof(light));
        light.positionRange += 0.02f * light.directionScale;
        std::memcpy(bytes.data(), &light, sizeof(light));
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

constexpr Mutation kLightMutations[] = {
    { kOneList, "one list of lights instead of froxels: must not be noticed", make<OneListEdit> },
    { "lightOff", "one light off", make<LightOffEdit> },
    { "sunMirrored", "the brightest sun on the other side", make<SunMirroredEdit> },
    { "sunTwice", "the brightest sun counts twice", make<SunTwiceEdit> },
    { "irradiance", "irradiance + 1 %", make<IrradianceEdit> },
    { "irradianceSh", "irradiance in harmonics + 1 %", make<IrradianceShEdit> },
    { "froxelEnd", "froxels without their last light", make<FroxelEndEdit> },
    { "channelsOff", "every light shines on everything, whatever the channels", make<ChannelsOffEdit> },
    { "shadowShift", "shadow maps drawn one texel to the side", make<ShadowShiftEdit> },
    { "listedShadows", "no shadows of lights besides the brightest sun", make<ListedShadowsEdit> },
    { "contactReach", "contact shadows 10 % shorter", make<ContactReachEdit> },
    { "occlusionRadius", "ambient occlusion reaches 2 % farther", make<OcclusionRadiusEdit> },
    { "discWider", "the discs of suns 1 % wider", make<DiscWiderEdit> },
    { "areaEdge", "the first area light 1 % wider", make<AreaEdgeEdit> },
    { "profileTurn", "the last light profile turned by half a degree", make<ProfileTurnEdit> },
    { "profileTable", "light profiles 1 % narrower", make<ProfileTableEdit> },
    { "areaImageTurn", "the images of rectangles upside down", make<AreaImageTurnEdit> },
    { "cookieShift", "the first light cookie moved by 2 % of its width", make<CookieShiftEdit> },
    { "ltcTable", "the lobes of area lights 1 % wider", make<LtcTableEdit> },
};

} // namespace

std::span<const Mutation> lightMutations() { return kLightMutations; }

} // namespace filament_core::tools
