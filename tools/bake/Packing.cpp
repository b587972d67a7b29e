// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filament_core::bake {
namespace {

constexpr uint32_t kSideStep = 4; // sides are multiples of it

/// The upper border of what is placed: pieces from left to right, which fill the width.
class Skyline {
public:
    explicit Skyline(uint32_t side) : mSide(side), mPieces{ { 0, 0 } } {}

    std::optional<uint2> place(uint2 size) {
        uint32_t bestTop = ~0u, best = 0;
        for (uint32_t i = 0; i < mPieces.size(); ++i) {
            const uint32_t y = heightUnder(i, size.x);
            if (y == ~0u || y + size.y > mSide || y + size.y >= bestTop) continue;
            bestTop = y + size.y, best = i;
        }
        if (bestTop == ~0u) return std::nullopt;
        const uint2 at{ mPieces[best].x, bestTop - size.y };
        raise(best, size.x, bestTop);
        return at;
    }

private:
    struct Piece {
        uint32_t x = 0, y = 0;
    };
    uint32_t endOf(size_t i) const { return i + 1 < mPieces.size() ? mPieces[i + 1].x : mSide; }

    uint32_t heightUnder(size_t first, uint32_t width) const {
        const uint32_t end = mPieces[first].x + width;
        if (end > mSide) return ~0u;
        uint32_t height = 0;
        for (size_t i = first; i < mPieces.size() && mPieces[i].x < end; ++i) height = std::max(height, mPieces[i].y);
        return height;
    }

    void raise(size_t first, uint32_t width, uint32_t top) {
        const uint32_t begin = mPieces[first].x, end = begin + width;
        size_t last = first;
        while (last + 1 < mPieces.size() && mPieces[last + 1].x < end) ++last;
        std::vector<Piece> replaced{ { begin, top } };
        if (end < endOf(last)) replaced.push_back({ end, mPieces[last].y });
        const auto at = mPieces.begin() + static_cast<ptrdiff_t>(first);
        const auto rest = mPieces.erase(at, mPieces.begin() + static_cast<ptrdiff_t>(last) + 1);
        mPieces.insert(rest, replaced.begin(), replaced.end());
    }

    uint32_t mSide;
    std::vector<Piece> mPieces;
};

std::optional<std::vector<uint2>> packInto(std::span<const uint2> sizes, std::span<const uint32_t> order,
                                           uint32_t side) {
    Skyline skyline(side);
    std::vector<uint2> places(sizes.size());
    for (const uint32_t i : order) {
        const std::optional<uint2> at = skyline.place(sizes[i]);
        if (!at) return std::nullopt;
        places[i] = *at;
    }
    return places;
}

/// By descending height, and width.
std::vector<uint32_t> orderOf(std::span<const uint2> sizes) {
    std::vector<uint32_t> order(sizes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) {
        return sizes[a].y != sizes[b].y ? sizes[a].y > sizes[b].y : sizes[a].x > sizes[b].x;
    });
    return order;
}

double areaOfAll(std::span<const uint2> sizes) {
    double area = 0;
    for (const uint2 size : sizes) area += double(size.x) * size.y;
    return area;
}

std::optional<Packing> packOnePage(std::span<const uint2> sizes, uint32_t most, uint32_t sideStep) {
    const std::vector<uint32_t> order = orderOf(sizes);
    uint32_t low = std::max(static_cast<uint32_t>(std::ceil(std::sqrt(areaOfAll(sizes)) / sideStep)), 1u);
    uint32_t high = most / sideStep;
    if (low > high) return std::nullopt;
    std::optional<Packing> best;
    while (low <= high) {
        const uint32_t middle = best ? low + (high - low) / 2 : std::min(low + low / 4, high);
        std::optional<std::vector<uint2>> places = packInto(sizes, order, middle * sideStep);
        if (places) {
            best = Packing{ middle * sideStep, 1, std::move(*places) };
            high = middle - 1;
        } else {
            low = middle + 1;
        }
    }
    return best;
}

/// Places of as many of the first rectangles as a page holds, by bisection.
std::vector<uint2> fillPage(std::span<const uint2> sizes, uint32_t side) {
    std::vector<uint2> best;
    size_t low = 1, high = 0;
    for (double area = 0; high < sizes.size(); ++high) {
        area += double(sizes[high].x) * sizes[high].y;
        if (area > double(side) * side) break;
    }
    size_t next = high; // all of them may fit
    while (low <= high) {
        const auto first = sizes.first(next);
        if (std::optional<std::vector<uint2>> places = packInto(first, orderOf(first), side)) {
            best = std::move(*places);
            low = next + 1;
        } else {
            high = next - 1;
        }
        next = low + (high - low) / 2;
    }
    return best;
}

std::optional<Packing> packPages(std::span<const uint2> sizes, uint32_t side, uint32_t most) {
    Packing packing{ side, 0, {} };
    while (packing.places.size() < sizes.size()) {
        if (packing.pages == most) return std::nullopt;
        const std::vector<uint2> page = fillPage(sizes.subspan(packing.places.size()), side);
        if (page.empty()) return std::nullopt; // a rectangle is larger than a page
        for (const uint2 place : page) packing.places.push_back(place + uint2(0, packing.pages * side));
        ++packing.pages;
    }
    return packing;
}

} // namespace

std::optional<Packing> packRectangles(std::span<const uint2> sizes, PackingLimits limits, uint32_t step) {
    const uint32_t sideStep = std::max(kSideStep, step);
    std::optional<Packing> best = packOnePage(sizes, limits.side, sideStep);
    if (best || limits.pages == 1) return best;
    const uint32_t most = limits.side / sideStep * sideStep;
    best = packPages(sizes, most, limits.pages);
    if (!best) return best;
    constexpr double kGrowth = 1.02;
    for (double side = std::sqrt(areaOfAll(sizes) / best->pages);; side *= kGrowth) {
        const auto steps = static_cast<uint32_t>(std::ceil(side / sideStep));
        if (steps * sideStep >= most) return best;
        if (std::optional<Packing> smaller = packPages(sizes, steps * sideStep, best->pages)) return smaller;
    }
}

} // namespace filament_core::bake
