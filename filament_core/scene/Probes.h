// SPDX-License-Identifier: Apache-2.0
/// Probes: the reflection probes of a scene (<filament_core/ReflectionProbe.h>).
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Memory  one record a probe; adding and removing are O(1), and removal moves the last record into the gap.
#pragma once

#include "backend/api/Handles.h"
#include "filament_core/scene/DenseIndex.h"

#include <filament_core/Format.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>
#include <filament_core/Quality.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::scene {

/// What shaders must know to read an environment.
struct EnvironmentStorage {
    bool isRgbm = false;            ///< the specular cube: RGBA8 as RGBM
    bool hasIrradianceCube = false; ///< else: the coefficients only
    RoughnessMapping mapping = RoughnessMapping::Quadratic;
};

/// Of a specular cube.
struct CubeShape {
    Format format = Format::None;
    uint32_t size = 0;   ///< texels of a side
    uint32_t levels = 0; ///< of its texture
    friend bool operator==(CubeShape const&, CubeShape const&) = default;
};

struct ProbeRecord {
    double3 centerWorld{ 0.0 };
    float3x3 worldFromBox{ 1.0f };
    float3 halfExtent{ 1.0f };
    float blendMeters = 0;
    float3 captureInBox{ 0.0f };
    float intensity = 1;
    bool lightsDiffuse = true;
    backend::TextureHandle cube;
    CubeShape shape{};
    EnvironmentStorage storage{};
    float levelOfRoughnessOne = 0;
    std::array<float4, 9> irradianceSh{};
    std::string name{};

    float volume() const { return halfExtent.x * halfExtent.y * halfExtent.z; }
};

struct Probes {
    explicit Probes(uint16_t owner = 0) : index(owner) {}

    DenseIndex<ReflectionProbeObject> index;
    std::vector<ProbeRecord> records;
};

} // namespace filament_core::scene
