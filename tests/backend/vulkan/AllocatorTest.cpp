// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Allocator.h"
#include "backend/vulkan/Memory.h"

#include <gtest/gtest.h>

#include <map>

namespace filament_core::backend::vulkan {
namespace {

constexpr uint64_t kMiB = uint64_t{ 1 } << 20;

/// A device with a budget; memory type 1 can be mapped.
class BudgetSource final : public MemorySource {
public:
    explicit BudgetSource(uint64_t budget) : mBudget(budget) {}

    std::optional<MemoryChunk> allocate(uint32_t memoryType, uint64_t bytes) override {
        if (bytes > mBudget - used()) return std::nullopt;
        const uint64_t id = ++mLast;
        live[id] = { memoryType, bytes, memoryType == 1 ? std::vector<std::byte>(bytes) : std::vector<std::byte>() };
        return MemoryChunk{ id, memoryType == 1 ? live[id].host.data() : nullptr };
    }
    void release(MemoryChunk chunk) override { ASSERT_EQ(live.erase(chunk.id), 1u) << "released twice"; }
    uint64_t used() const {
        uint64_t bytes = 0;
        for (auto const& [id, chunk] : live) bytes += chunk.bytes;
        return bytes;
    }

    struct Chunk {
        uint32_t memoryType;
        uint64_t bytes;
        std::vector<std::byte> host;
    };
    std::map<uint64_t, Chunk> live;

private:
    uint64_t mBudget, mLast = 0;
};

TEST(Allocator, CutsSmallRequestsOutOfOneBlock) {
    BudgetSource source(1024 * kMiB);
    Allocator allocator(source);
    const auto a = allocator.allocate({ .bytes = 1000 }), b = allocator.allocate({ .bytes = 1000 });
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->memory, b->memory);
    EXPECT_NE(a->offset, b->offset);
    EXPECT_EQ(allocator.statistics().blocks, 1u);
    EXPECT_EQ(allocator.statistics().usedBytes, 2000u);
    EXPECT_EQ(allocator.statistics().reservedBytes, 64 * kMiB);
    allocator.free(*a);
    allocator.free(*b);
    EXPECT_EQ(allocator.statistics().usedBytes, 0u);
}

TEST(Allocator, GivesRequestsAboveHalfABlockMemoryOfTheirOwn) {
    BudgetSource source(1024 * kMiB);
    Allocator allocator(source);
    const auto large = allocator.allocate({ .bytes = 100 * kMiB });
    ASSERT_TRUE(large);
    EXPECT_EQ(source.live.at(large->memory).bytes, 100 * kMiB);
    EXPECT_EQ(allocator.statistics().dedicated, 1u);
    allocator.free(*large);
    EXPECT_TRUE(source.live.empty()) << "such memory goes back at once";
}

TEST(Allocator, NeverMixesLinearAndOptimalResourcesOrMemoryTypesInABlock) {
    BudgetSource source(1024 * kMiB);
    Allocator allocator(source);
    const auto buffer = allocator.allocate({ .bytes = 1000, .kind = ResourceKind::Linear });
    const auto image = allocator.allocate({ .bytes = 1000, .kind = ResourceKind::Optimal });
    const auto mapped = allocator.allocate({ .bytes = 1000, .memoryType = 1 });
    ASSERT_TRUE(buffer && image && mapped);
    EXPECT_NE(buffer->memory, image->memory);
    EXPECT_NE(buffer->memory, mapped->memory);
    EXPECT_EQ(source.live.at(mapped->memory).memoryType, 1u);
    for (auto const& each : { buffer, image, mapped }) allocator.free(*each);
}

TEST(Allocator, PointsIntoTheMappedBlockAtTheOffset) {
    BudgetSource source(1024 * kMiB);
    Allocator allocator(source);
    const auto first = allocator.allocate({ .bytes = 1000, .memoryType = 1 });
    const auto second = allocator.allocate({ .bytes = 1000, .memoryType = 1 });
    const auto unmapped = allocator.allocate({ .bytes = 1000, .memoryType = 0 });
    EXPECT_EQ(second->mapped - first->mapped, static_cast<ptrdiff_t>(second->offset - first->offset));
    EXPECT_EQ(unmapped->mapped, nullptr);
    for (auto const& each : { first, second, unmapped }) allocator.free(*each);
}

TEST(Allocator, KeepsOneEmptyBlockAndReturnsTheOthers) {
    BudgetSource source(1024 * kMiB);
    Allocator allocator(source, { .blockBytes = kMiB });
    std::vector<Allocation> all;
    for (int i = 0; i < 8; ++i) all.push_back(*allocator.allocate({ .bytes = kMiB / 2 })); // two a block
    EXPECT_EQ(allocator.statistics().blocks, 4u);
    for (Allocation const& each : all) allocator.free(each);
    EXPECT_EQ(allocator.statistics().blocks, 1u);
    EXPECT_EQ(source.live.size(), 1u);
}

TEST(Allocator, TakesSmallerBlocksWhenTheDeviceIsNearlyFull) {
    BudgetSource source(20 * kMiB);
    Allocator allocator(source);
    const auto allocation = allocator.allocate({ .bytes = 1000 });
    ASSERT_TRUE(allocation);
    EXPECT_EQ(source.live.at(allocation->memory).bytes, 16 * kMiB); // 64 does not fit, a quarter of it does
    allocator.free(*allocation);
}

TEST(Allocator, FallsBackToTheExactSizeAndThenToNothing) {
    BudgetSource source(30 * kMiB);
    Allocator allocator(source);
    const auto exact = allocator.allocate({ .bytes = 20 * kMiB }); // neither a block nor a quarter of one fits
    ASSERT_TRUE(exact);
    EXPECT_EQ(source.used(), 20 * kMiB);
    EXPECT_FALSE(allocator.allocate({ .bytes = 20 * kMiB }));
    EXPECT_EQ(allocator.statistics().usedBytes, 20 * kMiB);
    allocator.free(*exact);
    EXPECT_EQ(source.used(), 0u);
}

TEST(Allocator, ReturnsEverythingToTheSourceInTheEnd) {
    BudgetSource source(1024 * kMiB);
    {
        Allocator allocator(source);
        allocator.free(*allocator.allocate({ .bytes = 1000 }));
        EXPECT_EQ(source.live.size(), 1u);
    }
    EXPECT_TRUE(source.live.empty());
}

TEST(AllocatorDeathTest, MemoryIsGivenBackBeforeItsAllocatorGoes) {
    EXPECT_DEATH(
            {
                BudgetSource source(1024 * kMiB);
                Allocator allocator(source);
                (void)allocator.allocate({ .bytes = 1000 });
            },
            "given back before its allocator goes");
}

// ---------------------------------------------------------------------------------------------- memory types

VkPhysicalDeviceMemoryProperties discreteGpu() {
    constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkPhysicalDeviceMemoryProperties memory{};
    memory.memoryTypeCount = 6;
    memory.memoryTypes[0].propertyFlags = 0;
    memory.memoryTypes[1].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    memory.memoryTypes[2].propertyFlags = kHost;
    memory.memoryTypes[3].propertyFlags = kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    memory.memoryTypes[4].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
    memory.memoryTypes[5].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_PROTECTED_BIT;
    return memory;
}

std::vector<uint32_t> order(MemoryPurpose purpose, uint32_t typeBits = ~0u) {
    const MemoryTypeOrder result = memoryTypeOrder(discreteGpu(), typeBits, purpose);
    return { result.types, result.types + result.count };
}

TEST(MemoryTypeOrder, PrefersWhatThePurposeNeedsAndNeverProtectedMemory) {
    EXPECT_EQ(order(MemoryPurpose::Device), (std::vector<uint32_t>{ 1, 4, 0, 2, 3 }));
    EXPECT_EQ(order(MemoryPurpose::Transient).front(), 4u);
    EXPECT_EQ(order(MemoryPurpose::Upload), (std::vector<uint32_t>{ 2, 3 }));
    EXPECT_EQ(order(MemoryPurpose::Readback), (std::vector<uint32_t>{ 3, 2 }));
}

TEST(MemoryTypeOrder, KeepsToTheTypesThatTheResourceAllows) {
    EXPECT_EQ(order(MemoryPurpose::Device, 1u << 2), (std::vector<uint32_t>{ 2 }));
    EXPECT_TRUE(order(MemoryPurpose::Upload, 1u << 1).empty());
}

} // namespace
} // namespace filament_core::backend::vulkan
