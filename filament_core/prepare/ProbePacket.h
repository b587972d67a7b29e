// SPDX-License-Identifier: Apache-2.0
/// ProbePacket: the reflection probes of the main view, and where their cubes lie in the array that shaders read.
///   Thread  plain values.   Memory: spans into the frame arena.
#pragma once

#include "backend/api/Handles.h"
#include "filament_core/scene/Probes.h"
#include "shaders/interface/ShaderInterface.h"

#include <array>
#include <cstdint>
#include <span>

namespace filament_core::prepare {

inline constexpr size_t kProbeLayers = shader::kMaxProbesOfView + 1; ///< the first is the environment's

/// A cube as its texture was when it was copied.
struct ProbeCube {
    backend::TextureHandle texture; ///< none: the layer is empty
    uint32_t version = 0;           ///< ContentVersions
    friend bool operator==(ProbeCube const&, ProbeCube const&) = default;
};

using ProbeCubes = std::array<ProbeCube, kProbeLayers>;

/// What a renderer's array of cubes holds, and whether the device has such arrays.
struct HeldProbes {
    ProbeCubes cubes{};
    scene::CubeShape shape{};
    bool hasArrays = true;
};

/// Why a view does not use a probe.
enum class ProbeUse : uint8_t { Used, OutOfReach, OverLimit, OtherShape, NotCopyable, NoArrays };

/// Boxes without a point.
shader::ProbeUniforms noProbes();

struct ProbePacket {
    shader::ProbeUniforms const* uniforms = nullptr; ///< null: none is used
    bool addsEnvironment = false;                    ///< some visible surface is not wholly in a box
    std::span<const ProbeUse> uses;                  ///< by scene::Probes::records
    ProbeCubes cubes{};                              ///< that the array holds in this frame
    scene::CubeShape shape{};
    scene::EnvironmentStorage storage{};
    uint32_t used = 0, outOfReach = 0, leftOut = 0;

    bool empty() const { return used == 0; }
};

} // namespace filament_core::prepare
