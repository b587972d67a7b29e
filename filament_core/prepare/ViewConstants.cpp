// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ViewConstants.h"

#include "base/math/Elementary.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

float4x4 rotationY(float radians) {
    const float c = elementary::cos(radians), s = elementary::sin(radians);
    return float4x4(float4(c, 0, -s, 0), float4(0, 1, 0, 0), float4(s, 0, c, 0), float4(0, 0, 0, 1));
}

/// How the cubes of the environment lie in the world.
template <class Record>
float4x4 worldFromEnvironment(Record const& environment) {
    return rotationY(environment.rotationRadians) * float4x4(environment.worldFromCube);
}

// z' = w - z: the near plane is at 0, infinity at 1.
float4x4 withOrdinaryDepth(float4x4 clip) {
    for (int column = 0; column < 4; ++column) clip[column][2] = clip[column][3] - clip[column][2];
    return clip;
}

/// Moves the image by pixels: row 0 is at y = -1.
float4x4 withJitter(float4x4 clip, float2 pixels, uint2 size) {
    const float2 moved = 2.0f * pixels / float2(size);
    for (int column = 0; column < 4; ++column) {
        clip[column].x += moved.x * clip[column].w;
        clip[column].y += moved.y * clip[column].w;
    }
    return clip;
}

/// A lens that shows so many more pixels on each side.
float4x4 withBand(float4x4 clip, uint2 inside, uint2 size) {
    const float2 share = float2(inside) / float2(size);
    for (int column = 0; column < 4; ++column) clip[column].x *= share.x, clip[column].y *= share.y;
    return clip;
}

// FrameUniforms::time. The fraction of a time just below a whole second must not round up to 1.
float4 shaderTime(double seconds) {
    const auto rounded = static_cast<float>(seconds);
    const auto fraction = static_cast<float>(seconds - std::floor(seconds));
    return { rounded, static_cast<float>(seconds - rounded), std::min(fraction, std::nextafter(1.0f, 0.0f)), 0 };
}

// Heights are relative to the camera, so that they are exact wherever it is.
float logDensityAt(double height, Fog const& fog) {
    const double logDensity = elementary::log(static_cast<double>(fog.density)) -
                              static_cast<double>(fog.heightFalloff) * (height - static_cast<double>(fog.heightMeters));
    return static_cast<float>(std::clamp(logDensity, -1e20, 1e20)); // without density: minus infinity
}

/// Columns become wider until all cells fit.
float4 fogGrid(Fog const& fog, uint2 size) {
    constexpr uint64_t kMostBytes = uint64_t{ 1 } << 27; // of a storage buffer, on every device
    uint32_t pixels = fog.volumetricPixels;
    const auto columns = [&] { return (size + pixels - 1u) / pixels; };
    while (uint64_t{ columns().x } * columns().y * (fog.volumetricSlices + 1u) * shader::kFogCellBytes > kMostBytes)
        pixels *= 2;
    return float4(float2(columns()), fog.volumetricSlices, fog.volumetricMeters);
}

/// The camera in the lattice of the noise, which the wind carries along: in double precision, because swirls must not
/// jump after hours or far from the origin.
float4 fogNoise(Fog const& fog, double3 camera, double seconds) {
    constexpr double kPeriod = 256; // cells of the widest octave, as in fog.glsl
    const auto size = static_cast<double>(fog.noiseMeters);
    const double3 place = (camera - double3(fog.noiseWind) * seconds) / (size * kPeriod);
    return float4(float3((place - glm::floor(place)) * kPeriod), static_cast<float>(1 / size));
}

/// `hasLight`: of an environment, which the colour is relative to.
void writeFog(shader::FrameUniforms& frame, ViewInput const& view, double3 camera, bool hasLight) {
    constexpr float kTwoPi = 6.28318531f, kNever = 1e30f;
    frame.fogMedium = frame.fogLight = frame.fogSun = frame.fogSunDirection = float4(0);
    frame.fogGrid = frame.fogScattering = frame.fogNoise = frame.fogVariation = float4(0);
    Fog const& fog = view.effects.fog;
    if (!fog.enabled) return;
    frame.fogMedium = float4(logDensityAt(camera.y, fog), fog.heightFalloff, fog.startMeters,
                             fog.cutOffMeters > 0 ? fog.cutOffMeters : kNever);
    frame.fogLight = float4(fog.color * (hasLight ? frame.ambient.x : 1.0f), fog.maximumOpacity);
    const float glow = fog.inScatteringSize > 0 ? (fog.inScatteringSize + 1) / kTwoPi : 0.0f;
    frame.fogSun = float4(float3(glow), fog.inScatteringSize); // times the sun: SelectLights.cpp
    frame.fogSunDirection = float4(0, 1, 0, std::max(fog.startMeters, fog.inScatteringStartMeters));
    if (!fog.volumetric) return;
    frame.fogGrid = fogGrid(fog, view.size);
    frame.fogScattering = float4(fog.albedo / (2 * kTwoPi), fog.anisotropy);
    frame.fogSun = float4(float3(frame.fogScattering), fog.attenuatesLight ? 0.0f : 1.0f); // 0: see SelectLights.cpp
    if (fog.noiseAmplitude <= 0) return;
    frame.fogNoise = fogNoise(fog, camera, view.timeSeconds);
    frame.fogVariation = float4(fog.noiseAmplitude, fog.noiseOctaves, 0, 0);
}

/// Planes relative to the camera, the signed distance of which is exact to a float wherever both are: in double
/// precision until then. The planes that cut come first.
void writeSection(shader::FrameUniforms& frame, SectionPlanes const& section, double3 camera) {
    frame.sectionPlanes = {};
    frame.section = frame.sectionCap = frame.sectionHatch = frame.sectionHatchColor = float4(0);
    uint32_t count = 0;
    for (double4 const& plane : section.planes) {
        if (!SectionPlanes::isPlane(plane)) continue;
        const double4 unit = plane / glm::length(double3(plane));
        frame.sectionPlanes[count++] =
                float4(float3(unit), static_cast<float>(glm::dot(double3(unit), camera) + unit.w));
    }
    if (count == 0) return;
    frame.section = float4(count, section.cut == SectionCut::Corner ? 1 : 0, section.caps ? 1 : 0, 0);
    frame.sectionCap = glm::clamp(section.capColor, 0.0f, 1.0f);
    frame.sectionHatchColor = float4(glm::clamp(section.hatchColor, 0.0f, 1.0f), 0);
    const double meters = std::min(static_cast<double>(section.hatchMeters), 1e6);
    if (!(meters > 0)) return;
    // Sheets along (1, 1, 1) or (1, -1, 1): at 45 degrees on planes along the axes, `meters` apart.
    const double scale = 1 / (meters * std::sqrt(2.0));
    const auto phase = [&](double y) {
        const double place = (camera.x + y * camera.y + camera.z) * scale;
        return static_cast<float>(place - std::floor(place));
    };
    frame.sectionHatch =
            float4(static_cast<float>(scale), phase(1), phase(-1), glm::clamp(section.hatchWidth, 0.0f, 1.0f));
}

} // namespace

ViewSpace makeViewSpace(ViewInput const& view) {
    FILAMENT_ASSERT(view.size.x > 0 && view.size.y > 0, "a view has at least one pixel");
    ViewSpace space;
    space.cameraWorld = view.camera.position();
    const double3x3 worldFromView(view.camera.worldFromView);
    space.forward = -float3(worldFromView[2]);
    space.viewFromWorld = float4x4(double4x4(glm::transpose(worldFromView)));
    const float2 shown(view.shown()); // rounding of the drawn size changes no proportions
    const float aspect = shown.x / shown.y;
    space.clipFromView = view.clipFromView ? *view.clipFromView : view.camera.clipFromView(aspect);
    // The band before the jitter, which counts in pixels of the image with its band.
    if (view.band > 0) space.clipFromView = withBand(space.clipFromView, view.inside(), view.size);
    if (view.jitterPixels != float2(0))
        space.clipFromView = withJitter(space.clipFromView, view.jitterPixels, view.size);
    space.clipFromWorld = space.clipFromView * space.viewFromWorld;
    space.frustum = frustumFromClip(space.clipFromWorld); // the planes do not depend on the stored depth
    if (view.farMeters > 0) // in the place of the near plane: only boxes around the lamp are not outside of the others
        space.frustum.planes[4] = float4(-space.forward, view.farMeters);
    if (view.quality.depthRange == DepthRange::Ordinary) {
        space.clipFromView = withOrdinaryDepth(space.clipFromView);
        space.clipFromWorld = space.clipFromView * space.viewFromWorld;
    }
    // Maps are culled before they have a size, and samples of a pixel lie beside its centre.
    if (view.kind != ViewKind::Shadow && view.samples == 1) space.pixels = PixelGrid(space.clipFromWorld, view.size);
    space.exposure = view.camera.exposure.factor();
    space.visibleLayers = view.visibleLayers;
    return space;
}

void writeFrameUniforms(shader::FrameUniforms& frame, ViewSpace const& space, ViewInput const& view,
                        scene::SceneData const& scene) {
    frame.clipFromWorld = space.clipFromWorld;
    frame.worldFromClip = float4x4(glm::inverse(double4x4(space.clipFromWorld)));
    frame.viewFromWorld = space.viewFromWorld;
    frame.clipFromView = space.clipFromView;
    frame.cameraPosition = float4(float3(space.cameraWorld), view.quality.cameraRelative ? 0.0f : 1.0f);
    scene::BackgroundGround const& ground = scene.skybox.ground;
    frame.skyGround = float4(float3(space.cameraWorld - double3(0, ground.levelMeters, 0)), ground.heightMeters);
    frame.exposure = float4(space.exposure, view.camera.exposure.ev100(), ground.radiusMeters,
                            view.quality.depthRange == DepthRange::Ordinary ? 1.0f : 0.0f);
    frame.time = shaderTime(view.timeSeconds);
    frame.jitter = float4(2.0f * view.jitterPixels / float2(view.size), 0, view.band);
    frame.materialGlobals = view.materialGlobals;
    frame.froxelGrid = frame.froxelPlaces = float4(0); // one list of lights, until Froxels.h writes a grid

    scene::IndirectLightRecord const& light = scene.indirectLight;
    const float ambient = light.specular ? light.illuminance.value * space.exposure : 0.0f;
    frame.ambient = float4(ambient, light.levelOfRoughnessOne, view.quality.shBands, 0);
    frame.irradianceSh = light.irradianceSh;
    frame.worldFromEnvironment = light.specular ? worldFromEnvironment(light) : worldFromEnvironment(scene.skybox);
    frame.skyFactor = float4(float3(scene.skybox.illuminance.value * space.exposure), 0);
    ContactShadows const& contact = view.effects.contactShadows;
    frame.contactShadows = float4(contact.distanceMeters, contact.thicknessMeters, contact.steps, 0);
    writeFog(frame, view, space.cameraWorld, static_cast<bool>(light.specular));
    writeSection(frame, view.section, space.cameraWorld);
}

} // namespace filament_core::prepare
