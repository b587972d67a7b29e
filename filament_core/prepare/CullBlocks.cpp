// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/CullBlocks.h"

#include "filament_core/prepare/LoadBoxes.h"

#include <bit>
#include <cmath>

namespace filament_core::prepare {
namespace {

using scene::RestingBlocks;
using simd::Float4;
using simd::Float8;
using simd::kLanes;

constexpr size_t kBlockRange = 2048; // about 5 us

// The distance of a box from a plane is a sum of six products: rounding changes it by less than 16 * 2^-24 of the sum
// of their absolute values, and normals are unit vectors. Twice that: for the block and for a member.
constexpr float kMargin = 1.0f / (1 << 19);

Float8 absolute(Float8 const& v) { return { v.low < 0 ? -v.low : v.low, v.high < 0 ? -v.high : v.high }; }

class BlockFrustum {
public:
    BlockFrustum(Frustum const& frustum, double3 const& cameraWorld) : mFrustum(frustum), mCamera(cameraWorld) {
        for (size_t i = 0; i < frustum.planes.size(); ++i) mReaches[i] = glm::abs(float3(frustum.planes[i]));
    }

    /// Bit i: block first + i may have members in view.
    uint32_t sees8(scene::BoundsColumns const& bounds, size_t first) const {
        const Box8 boxes = loadBoxes(bounds.four(first / 4), bounds.four(first / 4 + 1), mCamera);
        std::array<Float8, 3> const &center = boxes.center, &half = boxes.halfExtent;
        const Float8 size =
                absolute(center[0]) + absolute(center[1]) + absolute(center[2]) + half[0] + half[1] + half[2];
        simd::Mask8 outside{};
        for (size_t i = 0; i < mReaches.size(); ++i) {
            const float4 plane = mFrustum.planes[i];
            const Float8 distance = simd::dot(float3(plane), center) + plane.w;
            const Float8 margin = (size + std::abs(plane.w)) * kMargin;
            outside = outside | (distance + margin < -simd::dot(mReaches[i], half));
        }
        return ~simd::bits8(outside) & 0xFFu;
    }

private:
    Frustum const& mFrustum;
    double3 mCamera;
    std::array<float3, 5> mReaches;
};

} // namespace

std::span<const uint64_t> cullBlocks(jobs::JobSystem& jobs, Arena& arena, RestingBlocks const& blocks,
                                     Frustum const& frustum, double3 const& cameraWorld) {
    const std::span<const RestingBlocks::Word> words = blocks.words();
    if (!blocks.holdMost()) return {};
    const size_t eights = (blocks.limit() + kLanes - 1) / kLanes;
    const auto seen = arena.arrayForOverwrite<uint8_t>(eights);
    jobs::parallelFor<"cull blocks">(jobs, eights, kBlockRange / kLanes, [&](size_t begin, size_t end) {
        const BlockFrustum culler(frustum, cameraWorld);
        for (size_t i = begin; i < end; ++i) seen[i] = static_cast<uint8_t>(culler.sees8(blocks.bounds(), i * kLanes));
    });
    const auto forEachSeen = [&](auto const& visit) {
        for (size_t i = 0; i < eights; ++i) {
            for (uint32_t left = seen[i]; left != 0; left &= left - 1) {
                const auto block = static_cast<uint32_t>(i * kLanes) + static_cast<uint32_t>(std::countr_zero(left));
                if (block < blocks.limit()) visit(blocks.members(block));
            }
        }
    };
    size_t members = 0;
    forEachSeen([&](std::span<const uint32_t> of) { members += of.size(); });
    if (members > 16 * words.size()) return {}; // more than a quarter of all: testing them in their order is faster
    const auto may = arena.arrayForOverwrite<uint64_t>(words.size());
    for (size_t i = 0; i < words.size(); ++i) may[i] = words[i].unsettled;
    forEachSeen([&](std::span<const uint32_t> of) {
        for (const uint32_t at : of) may[at / 64] |= uint64_t{ 1 } << at % 64;
    });
    return may;
}

} // namespace filament_core::prepare
