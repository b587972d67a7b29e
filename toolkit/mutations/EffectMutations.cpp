// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Edits.h"

#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filament_core::tools {
namespace {

/// In every block of the frame: channels of lights have blocks of their own.
class FogDensityEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogMedium);
        writeFloat(bytes, at, readFloat(bytes, at) + 0.00995f); // the logarithm of 1.01
    }
};

class SectionShiftEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, sectionPlanes) + 3 * sizeof(float);
        writeFloat(bytes, at, readFloat(bytes, at) + 0.02f);
    }
};

class SectionHatchEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, sectionHatch);
        writeFloat(bytes, at, readFloat(bytes, at) * 1.02f);
    }
};

class FogGlowEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogSun) + 3 * sizeof(float);
        writeFloat(bytes, at, 1.02f * readFloat(bytes, at));
    }
};

class FogPhaseEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogScattering) + 3 * sizeof(float);
        writeFloat(bytes, at, readFloat(bytes, at) + 0.02f);
    }
};

/// In a lattice of noise, by a twentieth of a cell.
class FogNoiseEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, fogNoise);
        writeFloat(bytes, at, readFloat(bytes, at) + 0.05f);
    }
};

class SkyGroundEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        Bytes& bytes = copy(command.bytes);
        const size_t at = offsetof(shader::FrameUniforms, skyGround) + 3 * sizeof(float);
        writeFloat(bytes, at, 1.03f * readFloat(bytes, at));
    }
};

/// The box of a view's smallest reflection probe, and where its cube was captured.
class ProbeShiftEdit final : public PassBlocksEdit {
    static bool isProbe(shader::ReflectionProbe const& probe) {
        return std::ranges::all_of(probe.axes, [](float4 const& axis) {
            return std::abs(glm::dot(float3(axis), float3(axis)) - 1) < 1e-3f && axis.w > 0;
        });
    }
    static bool isUnused(shader::ReflectionProbe const& probe) {
        return std::ranges::all_of(probe.axes, [](float4 const& axis) { return axis == float4(0, 0, 0, -1); });
    }
    static bool isProbes(Bytes const& bytes, size_t at) {
        shader::ProbeUniforms uniforms;
        std::memcpy(&uniforms, bytes.data() + at, sizeof(uniforms));
        return isProbe(uniforms.probes.front()) && std::ranges::all_of(uniforms.probes, [](auto const& probe) {
                   return isProbe(probe) || isUnused(probe);
               });
    }

    void editBlocks(Bytes& bytes) override {
        for (size_t at = 0; at + sizeof(shader::ProbeUniforms) <= bytes.size(); at += sizeof(float4)) {
            if (!isProbes(bytes, at)) continue;
            const size_t x = at + offsetof(shader::ReflectionProbe, center);
            writeFloat(bytes, x, readFloat(bytes, x) + 0.02f);
        }
    }
};

/// The irradiance fields of objects: as if all grids were a quarter of each object's box further along x.
class FieldShiftEdit final : public NamedBufferEdit {
public:
    FieldShiftEdit() : NamedBufferEdit("objects") {}

private:
    void editBuffer(CmdUpdateBuffer& command) override {
        if (!isOfFields(command.bytes)) return;
        Bytes& bytes = copy(command.bytes);
        for (size_t at = 0; at < bytes.size(); at += sizeof(shader::IrradianceField)) {
            const size_t x = at + offsetof(shader::IrradianceField, center);
            const size_t inverse = at + offsetof(shader::IrradianceField, inverseHalf);
            writeFloat(bytes, x, readFloat(bytes, x) + 0.25f / std::max(readFloat(bytes, inverse), 1e-6f));
        }
    }

    /// Records of objects leave nothing 0 for so long.
    static bool isOfFields(std::span<const std::byte> bytes) {
        constexpr size_t kUnused = offsetof(shader::IrradianceField, unused);
        if (bytes.empty() || bytes.size() % sizeof(shader::IrradianceField) != 0) return false;
        return std::ranges::all_of(bytes.subspan(kUnused, sizeof(shader::IrradianceField) - kUnused),
                                   [](std::byte byte) { return byte == std::byte{ 0 }; });
    }
};

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

/// What moves by itself is not drawn into the texture of motion.
class StillObjectsEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.debugName != "motion") return;
        for (BlendState& blend : command.desc.blend) blend.writeMask = 0;
    }
};

/// Of two levels of detail that fade into each other, both are drawn where they are in front.
class FadedLevelsEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        CompareOp& compare = command.desc.depthStencil.depthCompare;
        if (compare == CompareOp::Equal) compare = CompareOp::GreaterEqual;
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

/// Each frame lights half as many slices of fog.
class FogWeightEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        constexpr size_t kBlock = 28 * sizeof(float); // a matrix, along the view, place and weight, exposure
        for (size_t at = 0; at + kBlock <= bytes.size(); at += sizeof(float4)) {
            const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
            const auto isPlace = [&](size_t i) { return number(i) >= 0 && number(i) < 1; };
            const float3 along(number(16), number(17), number(18));
            const bool isAccumulation = std::abs(glm::dot(along, along) - 1) < 1e-3f && isPlace(20) && isPlace(21) &&
                                        isPlace(22) && number(23) > 0 && number(23) < 1 && number(24) > 0 &&
                                        number(25) == 0 && number(26) == 0 && number(27) == 0;
            if (isAccumulation) writeFloat(bytes, at + 23 * sizeof(float), 0.5f * number(23));
        }
    }
};

/// Each frame counts half as much in the image that is accumulated over frames.
class AccumulationWeightEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        constexpr size_t kBlock = 24 * sizeof(float); // a matrix, 1 / size, jitter, weight, ramp, 1 / size
        for (size_t at = 0; at + kBlock <= bytes.size(); at += sizeof(float4)) {
            const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
            const auto isReciprocal = [&](size_t i) {
                const float size = number(i) > 0 ? 1 / number(i) : 0;
                return size >= 1 && size < 20'000 && std::abs(size - std::round(size)) < 1e-2f;
            };
            const bool isAccumulation = isReciprocal(16) && isReciprocal(17) && std::abs(number(18)) <= 0.5f &&
                                        std::abs(number(19)) <= 0.5f && number(20) > 0 && number(20) < 1 &&
                                        number(21) >= 0 && number(21) <= 0.5f && isReciprocal(22) && isReciprocal(23);
            if (isAccumulation) writeFloat(bytes, at + 20 * sizeof(float), 0.5f * number(20));
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

constexpr Mutation kEffectMutations[] = {
    { "pictureLevel", "the refracted picture without its last blurred level", make<PictureLevelEdit> },
    { "reflectionReach", "mirrored rays 30 % shorter", make<ReflectionReachEdit> },
    { "stillObjects", "objects that move show no motion of their own", make<StillObjectsEdit> },
    { "fadedLevels", "pixels show both of two levels of detail that fade", make<FadedLevelsEdit> },
    { "bloomLevels", "bloom without its wider lobes", make<BloomLevelsEdit> },
    { "bloomResolution", "the picture is halved for bloom where it is to be quartered, and the other way round",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("bloom_down", 1); } },
    { "fxaaBrightness", "FXAA takes the picture's values for light",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("fxaa", 0); } },
    { "subpixelEdges", "subpixel reconstruction beside objects instead of their edges",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("subpixel_reconstruction", 0); } },
    { "upscaleFilter", "another filter makes the picture larger",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("upscale", 0); } },
    { "sharpenedLight", "sharpening takes the picture's values for light",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("sharpen", 0); } },
    { "alphaSwapped", "colours multiplied by alpha where they are to be divided by it, and the other way round",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("alpha", 0); } },
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
    { "passNormals", "passes of the app read the colours of normals instead of normals",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("debug_material", 2); } },
    { "flareOff", "no lens flare", makeFinish<kHasFlare> },
    { "flarePlaces", "ghosts and halo of the lens 2 % off their places", make<FlarePlacesEdit> },
    { "toneMapper", "another tone mapper by formula",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("tonemap", 1); } },
    { "focusTiles", "blur does not reach into the next tile",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("focus_tiles", 0); } },
    { "wayTiles", "motion blur does not reach into the next tile",
      []() -> std::unique_ptr<StreamEdit> { return std::make_unique<SwitchEdit>("motion_blur_tiles", 0); } },
    { "gatheredWeight", "frames count half as much in the accumulated image", make<AccumulationWeightEdit> },
    { "fogDensity", "fog 1 % denser", make<FogDensityEdit> },
    { "fogGlow", "the glow of the sun in the fog 2 % narrower", make<FogGlowEdit> },
    { "sectionShift", "the first section plane 2 cm beside its place", make<SectionShiftEdit> },
    { "sectionHatch", "hatching lines of sections 2 % closer", make<SectionHatchEdit> },
    { "skyGround", "the camera of the panorama 3 % higher above its ground", make<SkyGroundEdit> },
    { "fieldShift", "irradiance fields a quarter of each box beside their places", make<FieldShiftEdit> },
    { "probeShift", "a reflection probe 2 cm beside its place", make<ProbeShiftEdit> },
    { "fogPhase", "volumetric fog scatters light a little more forwards", make<FogPhaseEdit> },
    { "fogWeight", "frames light half as many slices of fog", make<FogWeightEdit> },
    { "fogNoise", "the swirls of varying fog a twentieth of their size beside their places", make<FogNoiseEdit> },
};

} // namespace

std::span<const Mutation> effectMutations() { return kEffectMutations; }

} // namespace filament_core::tools
