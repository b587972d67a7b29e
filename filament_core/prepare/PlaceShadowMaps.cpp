// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceShadowMaps.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace filament_core::prepare {
namespace {

uint64_t texelsOf(std::span<const uint32_t> sizes) {
    uint64_t sum = 0;
    for (const uint64_t size : sizes) sum += size * size;
    return sum;
}

/// Until they fit: the largest are halved, the least important of them first; then the least important left out.
void shrinkToFit(std::span<uint32_t> sizes, uint32_t atlas) {
    for (uint32_t& size : sizes) size = std::min(size, atlas);
    uint64_t texels = texelsOf(sizes);
    const uint64_t most = uint64_t{ atlas } * atlas;
    while (texels > most) {
        const uint32_t largest = std::ranges::max(sizes);
        for (size_t i = sizes.size(); i-- > 0 && texels > most;) {
            if (sizes[i] != largest) continue;
            sizes[i] = largest > kSmallestShadowMap ? largest / 2 : 0;
            texels -= uint64_t{ largest } * largest - uint64_t{ sizes[i] } * sizes[i];
        }
    }
}

/// Which cells of an atlas are taken; a cell has kSmallestShadowMap texels a side.
class Cells {
public:
    Cells(Arena& arena, uint32_t atlas)
            : mSide(atlas / kSmallestShadowMap), mTaken(arena.array<uint8_t>(size_t{ mSide } * mSide)) {}

    bool isFree(ShadowTile tile) const {
        bool free = true;
        forEachCell(tile, [&](size_t cell) { free = free && mTaken[cell] == 0; });
        return free;
    }
    void take(ShadowTile tile) const {
        forEachCell(tile, [&](size_t cell) { mTaken[cell] = 1; });
    }
    /// Size 0: there is no room.
    ShadowTile find(uint32_t size) const {
        for (uint32_t y = 0; y + size <= mSide * kSmallestShadowMap; y += size) {
            for (uint32_t x = 0; x + size <= mSide * kSmallestShadowMap; x += size) {
                const ShadowTile tile{ static_cast<uint16_t>(x), static_cast<uint16_t>(y),
                                       static_cast<uint16_t>(size) };
                if (isFree(tile)) return tile;
            }
        }
        return {};
    }

private:
    template <class F>
    void forEachCell(ShadowTile tile, F&& function) const {
        const uint32_t x = tile.x / kSmallestShadowMap, y = tile.y / kSmallestShadowMap;
        const uint32_t count = tile.size / kSmallestShadowMap;
        for (uint32_t row = y; row < y + count; ++row) {
            for (uint32_t column = x; column < x + count; ++column) function(size_t{ row } * mSide + column);
        }
    }

    uint32_t mSide;
    std::span<uint8_t> mTaken;
};

ShadowTile heldTile(ShadowAtlas const& held, uint64_t owner, uint32_t size) {
    const auto found = std::ranges::find(held.maps, owner, &HeldShadowMap::owner);
    return found != held.maps.end() && found->tile.size == size ? found->tile : ShadowTile{};
}

std::span<const uint32_t> largestFirst(Arena& arena, std::span<const uint32_t> sizes) {
    const auto order = arena.arrayForOverwrite<uint32_t>(sizes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order,
                      [&](uint32_t a, uint32_t b) { return sizes[a] != sizes[b] ? sizes[a] > sizes[b] : a < b; });
    return order;
}

/// False: no room for one of them around those that keep their tiles.
bool place(Arena& arena, std::span<const uint32_t> sizes, std::span<const ShadowTile> kept, uint32_t atlas,
           std::span<ShadowTile> tiles) {
    const Cells cells(arena, atlas);
    std::ranges::copy(kept, tiles.begin());
    for (ShadowTile const& tile : kept) cells.take(tile);
    for (const uint32_t i : largestFirst(arena, sizes)) {
        if (sizes[i] == 0 || tiles[i].size != 0) continue;
        tiles[i] = cells.find(sizes[i]);
        if (tiles[i].size == 0) return false;
        cells.take(tiles[i]);
    }
    return true;
}

} // namespace

PlacedShadowMaps placeShadowMaps(Arena& arena, std::span<const ShadowMapRequest> requests, ShadowAtlas const& held,
                                 uint32_t largestAtlas) {
    if (requests.empty()) return {};
    const auto sizes = arena.arrayForOverwrite<uint32_t>(requests.size());
    std::ranges::transform(requests, sizes.begin(), &ShadowMapRequest::size);
    shrinkToFit(sizes, largestAtlas);
    const auto tiles = arena.array<ShadowTile>(requests.size());
    const auto kept = arena.array<ShadowTile>(requests.size());
    // An atlas with room is kept: another one would redraw all maps.
    const bool hasRoom = held.size <= largestAtlas && texelsOf(sizes) <= uint64_t{ held.size } * held.size &&
                         std::ranges::max(sizes) <= held.size;
    if (hasRoom) {
        for (size_t i = 0; i < requests.size(); ++i) kept[i] = heldTile(held, requests[i].owner, sizes[i]);
        // Tiles that stay may leave no aligned gap for a new one. Then all of them are placed anew, from the largest
        // down, which always fits; the maps that move are drawn again.
        if (place(arena, sizes, kept, held.size, tiles)) return { held.size, tiles };
        std::ranges::fill(kept, ShadowTile{});
    }
    uint32_t atlas = hasRoom ? held.size : std::ranges::max(sizes);
    while (uint64_t{ atlas } * atlas < texelsOf(sizes)) atlas *= 2;
    [[maybe_unused]] const bool fits = place(arena, sizes, kept, atlas, tiles);
    FILAMENT_ASSERT(fits, "aligned tiles fit from the largest down");
    return { atlas, tiles };
}

uint64_t atlasBytes(uint32_t size, ShadowMoments moments) {
    const auto squared = [](uint64_t side) { return side * side; };
    const uint64_t bytesOfMoments = moments == ShadowMoments::None ? 0 : moments == ShadowMoments::Two ? 8 : 16;
    uint64_t texels = 0;
    for (uint32_t level = 0; level < kShadowMomentLevels; ++level) texels += squared(size >> level);
    return 4 * squared(size) + bytesOfMoments * texels;
}

uint32_t atlasSizeForBytes(uint64_t bytes, ShadowMoments moments) {
    uint32_t size = kLargestShadowMap;
    while (size > kSmallestShadowMap && atlasBytes(size, moments) > bytes) size /= 2;
    return size;
}

} // namespace filament_core::prepare
