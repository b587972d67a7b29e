// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadGrid.h"

#include "filament_core/scenefile/BoxFields.h"

namespace filament_core::scenefile {
namespace {

constexpr uint32_t kMostOfAxis = 64;

/// Light of one direction in three bands: its product with each basis function.
IrradianceProbe probeOf(float3 ambient, float3 directed, float3 from) {
    const float length = glm::length(from);
    const float3 n = length > 0 ? from / length : float3(0, 1, 0);
    const std::array<float, 9> shares{ 0.25f,
                                       0.5f * n.y,
                                       0.5f * n.z,
                                       0.5f * n.x,
                                       0.9375f * n.x * n.y,
                                       0.9375f * n.y * n.z,
                                       0.078125f * (3 * n.z * n.z - 1),
                                       0.9375f * n.z * n.x,
                                       0.234375f * (n.x * n.x - n.y * n.y) };
    IrradianceProbe probe;
    for (size_t i = 0; i < shares.size(); ++i) probe.irradianceSh[i] = shares[i] * directed;
    probe.irradianceSh[0] += ambient;
    return probe;
}

void readProbes(JsonReader& reader, IrradianceGridDesc& grid) {
    auto probes = std::make_shared<IrradianceProbes>();
    double3 count(2.0);
    reader.numbers("count", &count.x, 3, 1, kMostOfAxis);
    probes->count = uint3(count);
    reader.objects("probes", [&](JsonReader& r) {
        float3 ambient(0), directed(0), from(0, 1, 0);
        r.read("ambient", ambient);
        r.read("directed", directed);
        r.read("from", from);
        probes->probes.push_back(probeOf(ambient, directed, from));
        r.read("inside", probes->probes.back().isInside);
    });
    if (probes->probes.empty()) {
        reader.complain("probes", "expected one at least, or a file");
        return;
    }
    probes->probes.resize(size_t{ probes->count.x } * probes->count.y * probes->count.z, probes->probes.back());
    grid.probes = probes;
}

} // namespace

void readGrid(JsonReader& reader, SceneFileGrid& grid) {
    IrradianceGridDesc& desc = grid.grid;
    readBox(reader, desc);
    reader.read("intensity", desc.intensity, 0, 1e9);
    reader.read("name", desc.name);
    reader.read("file", grid.file);
    if (grid.file.empty()) readProbes(reader, desc); // describes them, too
}

} // namespace filament_core::scenefile
