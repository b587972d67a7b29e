// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DarkLights.h"

#include <algorithm>

namespace filament_core::prepare {
namespace {

/// Not 0: refraction repeats the edge of the image where there is no environment. Less than any half float shows.
constexpr float kUnseenLight = 1e-30f;

float4 withoutColor(float4 const& light) { return { 0, 0, 0, light.w }; }

void darkenSun(shader::FrameUniforms& frame) {
    frame.sunIlluminance = withoutColor(frame.sunIlluminance);
    frame.fogSun = withoutColor(frame.fogSun);
}

/// Fog has a colour of its own only where there is no environment.
void darkenEnvironment(scene::SceneData const& scene, shader::FrameUniforms& frame) {
    frame.ambient.x = std::min(frame.ambient.x, kUnseenLight);
    if (scene.indirectLight.specular) frame.fogLight = withoutColor(frame.fogLight);
}

} // namespace

void darken(Arena& arena, scene::SceneData const& scene, ViewInput const& input, PreparedView& view) {
    if (input.darkEnvironment) darkenEnvironment(scene, view.packet.uniforms);
    if (input.darkLights.empty()) return;
    if (view.sunRecord && isDark(input, *view.sunRecord)) darkenSun(view.packet.uniforms);
    const std::span<shader::PunctualLight> lights = arena.copy(view.packet.lights);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (isDark(input, view.lightRecords[i])) lights[i].colorIntensity = withoutColor(lights[i].colorIntensity);
    }
    view.packet.lights = lights;
}

} // namespace filament_core::prepare
