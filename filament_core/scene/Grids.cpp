// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Grids.h"

namespace filament_core::scene {

// Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", section 3.2: irradiance
// is a quadratic form of the normal, c + b.n + n.A n, and forms turn as their vectors do.
std::array<float3, 9> rotateIrradiance(std::array<float3, 9> const& irradianceSh, float3x3 const& to) {
    std::array<float3, 9> turned;
    for (int channel = 0; channel < 3; ++channel) {
        const auto sh = [&](size_t i) { return static_cast<double>(irradianceSh[i][channel]); };
        const double3x3 world(to);
        const double3 linear = world * double3(sh(3), sh(1), sh(2));
        double3x3 form(0.0);
        form[0][1] = form[1][0] = sh(4) / 2;
        form[1][2] = form[2][1] = sh(5) / 2;
        form[0][2] = form[2][0] = sh(7) / 2;
        form[0][0] = -sh(6) + sh(8); // 3 z^2 - 1 is 2 z^2 - x^2 - y^2 of unit vectors: no trace
        form[1][1] = -sh(6) - sh(8);
        form[2][2] = 2 * sh(6);
        form = world * form * glm::transpose(world);
        const std::array values{ sh(0),          linear.y,       linear.z,
                                 linear.x,       2 * form[0][1], 2 * form[1][2],
                                 form[2][2] / 2, 2 * form[0][2], (form[0][0] - form[1][1]) / 2 };
        for (size_t i = 0; i < values.size(); ++i) turned[i][channel] = static_cast<float>(values[i]);
    }
    return turned;
}

GridRecord gridRecord(IrradianceGridDesc const& desc) {
    GridRecord record{ .centerWorld = desc.centerWorld,
                       .worldFromBox = desc.worldFromBox,
                       .halfExtent = desc.halfExtentMeters,
                       .blendMeters = desc.blendMeters,
                       .irradianceSh = {},
                       .probes = desc.probes,
                       .name = desc.name };
    record.irradianceSh.reserve(desc.probes->probes.size());
    for (IrradianceProbe const& probe : desc.probes->probes) {
        std::array<float3, 9> light = rotateIrradiance(probe.irradianceSh, desc.worldFromBox);
        for (float3& coefficient : light) coefficient *= desc.intensity;
        record.irradianceSh.push_back(light);
    }
    return record;
}

} // namespace filament_core::scene
