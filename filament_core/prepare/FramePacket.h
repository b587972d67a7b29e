// SPDX-License-Identifier: Apache-2.0
/// FramePacket: what the views of one frame see (a ViewPacket each), and what they share. Passes read nothing else of a
/// scene.
///   In      made by prepareFrame (PrepareFrame.h).
///   Thread  a plain value, read-only once made.
///   Memory  spans into the frame arena and the columns of the scene: valid until the end of the frame, or until the
///           scene changes.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/api/Handles.h"
#include "filament_core/prepare/FrameSettings.h"
#include "filament_core/prepare/GridPacket.h"
#include "filament_core/prepare/ProbePacket.h"
#include "filament_core/prepare/SceneColorCopy.h"
#include "filament_core/prepare/SceneDemand.h"
#include "filament_core/prepare/ShadowMaps.h"
#include "filament_core/prepare/SortKey.h"
#include "filament_core/prepare/SplatPacket.h"
#include "filament_core/prepare/ViewCounts.h"
#include "filament_core/prepare/ViewInput.h"
#include "filament_core/scene/SceneData.h"
#include "shaders/interface/ShaderInterface.h"

#include <cstdint>
#include <span>

namespace filament_core::prepare {

inline constexpr uint32_t kNowhere = ~0u;

/// Where a pose is among those of the frame, in bones (shader::kBonesPerRow).
struct PosePlace {
    uint32_t begin = kNowhere; ///< ObjectData::flags.w; kNowhere: it is not uploaded
    uint32_t bones = 0;        ///< the first bone of the skin
};

/// Of one deformation.
struct DeformationPlace {
    PosePlace now;                 ///< kNowhere: it is not visible
    PosePlace last;                ///< in the last frame; kNowhere: unused
    uint32_t block = kNowhere;     ///< of uniforms, a byte offset into the buffer of the frame
    bool ownsBlock = false;        ///< false: it is that of an earlier deformation of the same kind
    bool ownsLastBones = false;    ///< false: they are those of another deformation with the same skin
    backend::TextureHandle deltas; ///< none: no morph targets
};

/// Where the objects of a view are read from; writeObjects() (ObjectData.h) converts them for the shaders.
struct ObjectList {
    std::span<const SortItem> order; ///< of drawing
    std::span<const scene::Placement> placements;
    double3 cameraWorld{ 0.0 };
    std::span<const uint32_t> deformations{};   ///< by renderable: into `places`
    std::span<const DeformationPlace> places{}; ///< of the frame; none: nothing is deformed
    bool hasLastFrames = false;                 ///< odd renderables are as in the last frame (PrepareMotion.h)

    size_t size() const { return order.size(); }
    bool empty() const { return order.empty(); }
    /// ObjectData::flags.w
    float poseBegin(uint32_t renderable) const {
        const uint32_t slot = places.empty() ? scene::kNotDeformed : deformations[renderable];
        if (slot == scene::kNotDeformed) return 0;
        DeformationPlace const& place = places[slot];
        PosePlace const& pose = hasLastFrames && (renderable & 1) != 0 ? place.last : place.now;
        return pose.begin == kNowhere ? 0.0f : static_cast<float>(pose.begin);
    }
};

/// What a material with two passes (materials guide, 4.2.18) draws: depth, then colour; or back faces, then front
/// faces.
enum class DrawPass : uint8_t { Only, First, Second };

/// Instances [firstObject, firstObject + instanceCount) of ViewPacket::objects, all of one window, share geometry,
/// material and raster state.
struct DrawCall {
    scene::MaterialInstance const* material = nullptr;
    scene::Geometry const* geometry = nullptr;
    uint32_t firstObject = 0;
    uint32_t instanceCount = 1;
    bool mirrored = false;
    scene::DrawProperties properties{};
    DrawPass pass = DrawPass::Only;             ///< First and Second of an object follow each other
    uint32_t deformation = scene::kNotDeformed; ///< into DeformationList::places: that of the first object
    LevelFade fade = 0; ///< of all instances; the depth prepass says which pixels show them (passes/DepthPass.h)
    /// Into FramePacket::fields(): that of the first object, the others follow; kNowhere: the environment lights them.
    uint32_t firstField = ~0u;
};

/// What a deformation was like in the last frame.
struct LastDeformation {
    std::span<const shader::BoneData> bones;
    std::span<const float> weights;
};

/// Skins and morph weights of visible objects; DeformationData.h converts them for the shaders.
struct DeformationList {
    std::span<const scene::Deformation> deformations;
    std::span<const scene::SkinRecord> skins;
    std::span<const DeformationPlace> places; ///< by slot of `deformations`
    std::span<const uint32_t> bones;          ///< by index of `skins`: its first bone, or kNowhere
    uint32_t boneCount = 0;                   ///< of all skins, and the room of records of weights
    uint32_t bytes = 0;                       ///< of all blocks of uniforms; 0: nothing visible is deformed
    std::span<const LastDeformation> last;    ///< by slot; none: no place has a last one
};

/// Which lights reach which part of a view (Froxels.h), as the shaders read it; see shader::kFroxelCountBits.
struct FroxelLists {
    std::span<const uint32_t> words; ///< one for each froxel, then the lists; none: there is one list for all
};

/// The lights of draws on certain channels (<filament_core/Light.h>), where these are not all lights of the view.
/// Shaders do not know of channels: such a draw binds other uniforms, whose light list is its own.
struct ChannelLights {
    bool hasSun = false;
    shader::FrameUniforms uniforms{};
    std::span<const shader::PunctualLight> lights;
    FroxelLists froxels;
};

/// Empty where every light of the view shines on everything in it.
struct ChannelLists {
    std::span<const ChannelLights> lists;
    std::span<const uint16_t> listOf; ///< by DrawProperties::lightChannels; 0: the list of the view; n: lists[n - 1]

    uint32_t of(uint8_t channels) const { return listOf.empty() ? 0 : listOf[channels]; }
    /// What a draw needs of `variant`, that of the view.
    uint8_t variantOf(DrawCall const& draw, uint8_t variant) const;
};

/// The profiles of the lights of a view, as shaders read them (shader::kProfiledLightWords).
struct ProfileLists {
    std::span<const uint32_t> lights;                  ///< kProfiledLightWords each
    std::span<const std::span<const uint32_t>> tables; ///< each once, in the order of their first lights
    bool empty() const { return lights.empty(); }
};

/// The images of the lights of the main view, as shaders read them (shader::ImagedLight).
struct LightImageLists {
    std::span<const shader::ImagedLight> records;      ///< and room for some more
    std::span<const std::span<const uint32_t>> tables; ///< each once, in the order of their first lights
    uint32_t words = 0;                                ///< from the first of the buffer to behind the last table
    uint8_t terms = 0;                                 ///< shader::LightImageTerms
    bool empty() const { return records.empty(); }
};

/// The draws of ViewPacket::blended that Quality::transparency composes in any order; none: all are drawn in order.
struct AnyOrderDraws {
    uint32_t first = 0, end = 0; ///< of `blended`
    float nearestMeters = 0; ///< how near the nearest of them is, by the middle of its box; weights count from there
    bool empty() const { return first == end; }
};

/// What one view sees.
struct ViewPacket {
    ViewKind kind = ViewKind::Color;
    uint8_t variant = 0; ///< shader::VariantBit set that the lights of the view select; 0 where nothing is shaded
    shader::FrameUniforms uniforms{};
    std::span<const shader::PunctualLight> lights; ///< relative to the camera of the view and pre-exposed by it
    FroxelLists froxels;
    ChannelLists channels;
    bool hasAreaLights = false; ///< among `lights`
    ProfileLists profiles;      ///< of `lights`
    LightImageLists images;     ///< of `lights`
    ObjectList objects;
    std::span<const DrawCall> opaque;         ///< opaque and masked, roughly front to back
    std::span<const DrawCall> blended;        ///< back to front; none where nothing is shaded
    std::span<const SceneColorCopy> pictures; ///< for what of `blended` refracts what is drawn before it; none: nothing
    AnyOrderDraws anyOrder;                   ///< where of `blended`
    ViewCounts counts;

    std::span<const DrawCall> anyOrderDraws() const {
        return blended.subspan(anyOrder.first, anyOrder.end - anyOrder.first);
    }
};

/// The environment of the scene, the same for all views; values that depend on a camera's exposure are in the uniforms.
struct EnvironmentPacket {
    backend::TextureHandle specular;   ///< none: no indirect light
    backend::TextureHandle irradiance; ///< none: the coefficients of the uniforms only
    backend::TextureHandle sky;        ///< none: no skybox
    scene::EnvironmentStorage storage{};
    bool skyHasGround = false; ///< FrameUniforms::skyGround
    bool skyIsRgbm = false;
};

/// The disc of a sun in the sky of the main view, and its halo, as shaders/material/sun_disc.mat reads them.
struct SunDisc {
    float4 axisX, axisY; ///< xyz: what a pixel to the right, and one further down, adds to axisZ; w: the pixel of axisZ
    float4 axisZ; ///< xyz: where the camera looks at that pixel; z towards the sun; w: tangent of the disc's radius
    float4 light; ///< rgb: pre-exposed luminance of the disc; w: exponent of the halo
    float4 halo;  ///< x: 1 - cos of the disc's radius; y: 1 / (1 - cos of the halo's - x), 0: no halo
};

/// How the last frame was seen; as this frame is, if there was none.
struct LastView {
    float4x4 clipFromWorld{ 1.0f }; ///< from this frame's world
    float4 alongView{ 0.0f };       ///< its product with a point of this frame's world, w = 1: metres along that view
    float4 time{ 0.0f };            ///< FrameUniforms::time
    bool isExposed = false;         ///< it left an exposure that this one follows
    bool isReflected = false;       ///< it left its scene colour, of as many pixels, for the reflections of this one
    float secondsSince = 0;         ///< of View::timeSeconds, >= 0
    bool isElsewhere = false;       ///< not as this frame is seen
};

/// How blurred a lens shows what lies at a distance along the view (Focus.h): in pixels, as the radius of a disc,
/// radius - radiusTimesFocus / distance.
struct Focus {
    float radius = 0, radiusTimesFocus = 0;
    float mostPixels = 0; ///< larger radii count as this
};

/// How this frame adds to an image that is accumulated over frames (TemporalPass.h).
struct Accumulation {
    float2 jitterPixels{ 0 }; ///< ViewInput::jitterPixels of the main view
    float weight = 1;         ///< of this frame in the accumulated colour, (0, 1]
    bool isFixed = false;     ///< only the direction of the camera changed: the accumulated colour is right
    float ramp = 0;           ///< of an image that accumulation enlarges: half the width of its filter's edges, pixels
};

/// What of volumetric fog this frame lights anew, and what it has from the last one (Fog::volumetricFrames).
struct FogAccumulation {
    float3 place{ 0.5f }; ///< of this frame in a sequence of low discrepancy, [0, 1)
    float weight = 1;     ///< share of the slices that it lights, (0, 1]; 1: all
    float exposure = 1;   ///< of this frame, by that of the last one
};

struct FramePacket {
    std::span<const ViewPacket> views; ///< one at least, in the order of the inputs
    FrameSettings settings;            ///< of the main view
    uint32_t motionView = kNowhere;    ///< of `views`: what moved by itself, two records an object (PrepareMotion.h)
    LastView last;                     ///< of the main view
    Accumulation accumulation;         ///< of the main view
    FogAccumulation fogAccumulation;   ///< of the main view
    Focus focus;                       ///< of the main view
    DeformationList deformations;      ///< of what any of the views sees, each once
    ShadowPacket shadows;              ///< of the main view; maps that are drawn name their views
    EnvironmentPacket environment;
    /// Pixels of `settings.size`: objects of the main view cover no others (CoveredPixels.h), if an effect asks;
    /// otherwise all.
    backend::Rect covered{ 0, 0, 1, 1 };
    std::span<const SunDisc> discs; ///< of the main view, in the order of the scene
    uint32_t discsOutOfView = 0;
    SplatPacket splats; ///< of the main view
    ProbePacket probes; ///< of the main view
    GridPacket grids;   ///< of the main view
    /// Of debug views of numbers, in the place of the fields of `grids`: the objects of the main view, each by itself;
    /// center.w is its number. DrawCall::firstField counts into it.
    std::span<const shader::IrradianceField> numbered;
    SceneDemand demand; ///< of the main view

    /// What DrawCall::firstField counts into.
    std::span<const shader::IrradianceField> fields() const { return numbered.empty() ? grids.fields : numbered; }

    /// Of the view that the user asked for.
    ViewPacket const& mainView() const { return views[0]; }
};

/// A hash of everything in a packet and behind it, including object data: contents, never addresses. The same for any
/// number of workers.
uint64_t hashPacket(FramePacket const& packet);

} // namespace filament_core::prepare
