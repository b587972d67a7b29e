// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/GridTrace.h"

#include "filament_core/scene/SampleGrid.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::bake {
namespace {

constexpr uint64_t kHeldOutStream = uint64_t{ 1 } << 40; // beyond the numbers of probes
constexpr uint64_t kJudgeStream = uint64_t{ 1 } << 41;
constexpr double kFarthestMeters = 1e9; // of depths in a file
constexpr size_t kGridBatch = 64;       // records between two reports

/// The depths follow.
struct RecordHead {
    uint64_t rays = 0;
    std::array<float3, 9> irradianceSh{};
    float standardError = 0;
    uint32_t isInside = 0, reserved = 0;
};
static_assert(sizeof(RecordHead) == 128 && std::is_trivially_copyable_v<RecordHead>);

uint64_t numberOf(uint3 count) { return uint64_t{ count.x } * count.y * count.z; }

/// As coarse as asked for, or as the budget allows.
uint3 firstCount(GridSettings const& settings) {
    uint3 count(2);
    for (int axis = 0; axis < 3; ++axis) {
        const float cells = std::ceil(2 * settings.box.halfExtentMeters[axis] / settings.spacingMeters);
        count[axis] = static_cast<uint32_t>(std::clamp(cells, 1.0f, 65535.0f)) + 1;
    }
    while (numberOf(count) > settings.maxProbes) {
        int longest = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (count[axis] > count[longest]) longest = axis;
        count[longest] = count[longest] / 2;
    }
    return count;
}

/// Halves the longest spacing: the probes of before stay where they are.
uint3 finerCount(uint3 count, float3 half) {
    int longest = 0;
    const auto spacing = [&](int axis) { return half[axis] / static_cast<float>(std::max(count[axis], 2u) - 1); };
    for (int axis = 1; axis < 3; ++axis)
        if (spacing(axis) > spacing(longest)) longest = axis;
    count[longest] = count[longest] == 1 ? 2 : 2 * count[longest] - 1;
    return count;
}

} // namespace

GridTrace::GridTrace(reference::TracedScene const& scene, GridSettings const& settings)
        : mScene(scene), mSettings(settings) {
    size_t end = size_t{ settings.heldOutPoints } + settings.judgedPoints;
    for (uint3 count = firstCount(settings); mCounts.empty() || numberOf(count) <= settings.maxProbes;
         count = finerCount(count, settings.box.halfExtentMeters)) {
        end += numberOf(count);
        mCounts.push_back(count);
        mEnds.push_back(end);
    }
}

size_t GridTrace::recordBytes() const { return sizeof(RecordHead) + depths() * sizeof(float2); }

void GridTrace::trace(size_t first, size_t last, jobs::JobSystem& jobs,
                      std::function<bool(std::span<const std::byte>)> const& finished) const {
    std::vector<std::byte> records;
    for (size_t at = first; at < last; at += kGridBatch) {
        const size_t count = std::min(kGridBatch, last - at);
        records.assign(count * recordBytes(), std::byte{ 0 });
        jobs::parallelFor<"irradiance probes">(jobs, count, 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) write(traceOne(at + i), &records[i * recordBytes()]);
        });
        if (!finished(records)) return;
    }
}

std::vector<HeldOutProbe> GridTrace::heldOut(std::span<const std::byte> records) const {
    return points(0, mSettings.heldOutPoints, kHeldOutStream, records);
}

std::vector<HeldOutProbe> GridTrace::judging(std::span<const std::byte> records) const {
    return points(mSettings.heldOutPoints, mSettings.judgedPoints, kJudgeStream, records);
}

std::vector<TracedProbe> GridTrace::probesOf(size_t grid, std::span<const std::byte> records) const {
    std::vector<TracedProbe> probes;
    for (size_t i = mEnds[grid] - numberOf(mCounts[grid]); i < mEnds[grid]; ++i) probes.push_back(read(records, i));
    return probes;
}

std::vector<HeldOutProbe> GridTrace::points(size_t first, size_t count, uint64_t stream,
                                            std::span<const std::byte> records) const {
    std::vector<HeldOutProbe> result;
    for (size_t i = 0; i < count; ++i) {
        const TracedProbe traced = read(records, first + i);
        result.push_back({ pointOf(i, stream), traced.probe, traced.rays });
    }
    return result;
}

TracedProbe GridTrace::traceOne(size_t record) const {
    if (record < mSettings.heldOutPoints) return tracePoint(record, kHeldOutStream);
    record -= mSettings.heldOutPoints;
    if (record < mSettings.judgedPoints) return tracePoint(record, kJudgeStream);
    record += mSettings.heldOutPoints;
    const auto grid = static_cast<size_t>(std::ranges::upper_bound(mEnds, record) - mEnds.begin());
    const uint3 count = mCounts[grid];
    const size_t i = record - (mEnds[grid] - numberOf(count));
    scene::GridRecord places;
    places.halfExtent = mSettings.box.halfExtentMeters;
    auto probes = std::make_shared<IrradianceProbes>();
    probes->count = count;
    places.probes = probes;
    ProbeSettings settings = mSettings.probes;
    settings.farthestMeters = std::min(1.5 * double{ glm::length(scene::spacingOf(places)) }, kFarthestMeters);
    const uint3 at(i % count.x, i / count.x % count.y, i / count.x / count.y);
    return traceProbe(mScene, inWorld(scene::placeOf(places, at)), i, mSettings.box.worldFromBox, settings);
}

TracedProbe GridTrace::tracePoint(size_t number, uint64_t stream) const {
    ProbeSettings settings = mSettings.probes;
    settings.depthSize = 0;
    return traceProbe(mScene, inWorld(pointOf(number, stream)), stream + 1 + number, mSettings.box.worldFromBox,
                      settings);
}

float3 GridTrace::pointOf(size_t number, uint64_t stream) const {
    const reference::SampleStream numbers(reference::hashOf(mSettings.probes.seed, stream),
                                          static_cast<uint32_t>(number));
    const double3 u(numbers.pair(0), numbers.pair(1).x);
    return float3(2.0 * u - 1.0) * mSettings.box.halfExtentMeters;
}

double3 GridTrace::inWorld(float3 local) const {
    return mSettings.box.centerWorld + double3(mSettings.box.worldFromBox * local);
}

void GridTrace::write(TracedProbe const& probe, std::byte* to) const {
    const RecordHead head{ .rays = probe.rays,
                           .irradianceSh = probe.probe.irradianceSh,
                           .standardError = probe.probe.standardError,
                           .isInside = probe.probe.isInside ? 1u : 0u };
    std::memcpy(to, &head, sizeof(head));
    if (!probe.depths.empty())
        std::memcpy(to + sizeof(head), probe.depths.data(), probe.depths.size() * sizeof(float2));
}

TracedProbe GridTrace::read(std::span<const std::byte> records, size_t record) const {
    const std::span<const std::byte> bytes = records.subspan(record * recordBytes(), recordBytes());
    RecordHead head;
    std::memcpy(&head, bytes.data(), sizeof(head));
    TracedProbe traced;
    traced.probe = { head.irradianceSh, head.standardError, head.isInside != 0 };
    traced.rays = head.rays;
    traced.depths.resize(depths());
    if (depths() > 0) std::memcpy(traced.depths.data(), &bytes[sizeof(head)], depths() * sizeof(float2));
    return traced;
}

} // namespace filament_core::bake
