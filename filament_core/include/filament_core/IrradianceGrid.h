// SPDX-License-Identifier: Apache-2.0
/// IrradianceGrid: diffuse light that depends on the place. Probes on a regular grid in a box know the light that
/// arrives at them and how far they see; renderables in the box, moving ones too, have it in place of the environment's
/// diffuse light. Added to a Scene, any number of them. filament-bake traces them.
///   Light     what arrives from the environment, from glowing surfaces, and by any number of bounces. Lights of the
///             scene shine on surfaces all the same, so a grid does not hold what comes from them without a bounce.
///   Field     a renderable gets one field of light over its box: three bands of spherical harmonics at the middle of
///             its box, of which the first two change linearly along its three axes. It is evaluated again when the
///             renderable moves, or when a grid or the environment changes. What a linear field cannot describe, such
///             as a whole building in one mesh, is lit by its mean: Renderer::explain() says how far off the field is.
///   Walls     a probe counts where it is seen: the mean and the mean square of the distance to what it sees, by
///             direction. Majercik et al. 2019, "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance
///             Fields". Walls that are thinner than a twentieth of the distance of probes leak.
///   Blending  as of reflection probes: the smallest grid comes first, others give what it leaves, and the environment
///             the rest. Where a renderable has a field, reflection probes give no diffuse light.
///   Affects   diffuse light of all lit materials. Quality::diffuseIrradiance and Quality::shBands do nothing there.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Objects.h>
#include <filament_core/Result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace filament_core {

/// What arrives at one place.
struct IrradianceProbe {
    /// Irradiance / pi, candela / m2, as IndirectLightDesc::irradianceSh: coefficients of 1, y, z, x, xy, yz, 3 z^2-1,
    /// zx and x^2 - y^2 of the normal, along the axes of the grid.
    std::array<float3, 9> irradianceSh{};
    float standardError = 0; ///< of the luminance of the first coefficient
    bool isInside = false;   ///< of geometry: it lights nothing
};

/// Probes at the corners of the cells of a box, x first, then y, then z.
struct IrradianceProbes {
    static constexpr uint32_t kMaxProbes = 1u << 20, kMaxDepthSize = 32;

    uint3 count{ 2 };                    ///< along each axis, >= 1; at most kMaxProbes in all; 1: at the middle
    std::vector<IrradianceProbe> probes; ///< as many
    uint32_t depthSize = 0; ///< directions along a side of the octahedral map of each probe, <= kMaxDepthSize; 0: none,
                            ///< and every probe sees everything
    std::vector<float2> depths; ///< metres: mean and mean square of the distance to what is seen; depthSize^2 a probe
};

/// All numbers are finite.
struct IrradianceGridDesc {
    double3 centerWorld{ 0 };      ///< of the box, metres
    float3 halfExtentMeters{ 1 };  ///< half of each side, > 0
    float3x3 worldFromBox{ 1.0f }; ///< axes of the box: three unit vectors at right angles
    float blendMeters = 0.25f;     ///< how far outside of the box its light ends, >= 0
    float intensity = 1;           ///< multiplies the light, >= 0
    std::shared_ptr<const IrradianceProbes> probes{};
    std::string name{}; ///< in Renderer::explain()
};

/// A file of format version 1: box, probes with half floats, depths with 16 bits. Little-endian; the layout is in
/// docs/irradiance-grids.md.
std::vector<std::byte> writeIrradianceGrid(IrradianceGridDesc const& grid);
/// Fails: InvalidArgument in one line for what is no such file, is cut short, or holds numbers outside of their ranges.
Result<IrradianceGridDesc> readIrradianceGrid(std::span<const std::byte> bytes);

} // namespace filament_core
