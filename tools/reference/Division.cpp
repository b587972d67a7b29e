// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Division.h"

#include "toolkit/program/CommandLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace filament_core::reference {
namespace {

using tools::invalidOption;

constexpr uint32_t kMinSide = 16; ///< smaller tiles cost more to divide than they gain

/// The numbers of "a,b,c", or nothing.
std::optional<std::vector<uint32_t>> numbersOf(std::string const& word, char separator) {
    std::vector<uint32_t> numbers;
    for (size_t begin = 0; begin <= word.size();) {
        const size_t end = std::min(word.find(separator, begin), word.size());
        const auto number = tools::wholeNumber(word.substr(begin, end - begin), 0, UINT32_MAX);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

/// Part `index` of `count` nearly equal parts of [0, length): first and number.
std::pair<uint32_t, uint32_t> slice(uint32_t length, uint32_t index, uint32_t count) {
    const auto border = [&](uint64_t i) { return static_cast<uint32_t>(uint64_t(length) * i / count); };
    return { border(index), border(index + 1) - border(index) };
}

void setTile(FilmRegion& region, uint32_t index, uint2 grid) {
    std::tie(region.offset.x, region.size.x) = slice(region.size.x, index % grid.x, grid.x);
    std::tie(region.offset.y, region.size.y) = slice(region.size.y, index / grid.x, grid.y);
}

Result<void> convertTile(std::string const& word, FilmRegion& region) {
    const uint2 size = region.size;
    const auto invalid = [&] {
        return invalidOption("--tile", word,
                             fmt::format("X,Y,W,H within {}x{} pixels, or I/CxR: tile I of C columns and R "
                                         "rows",
                                         size.x, size.y)
                                     .c_str());
    };
    if (const size_t slash = word.find('/'); slash != std::string::npos) {
        const auto grid = numbersOf(word.substr(slash + 1), 'x');
        if (!grid || grid->size() != 2) return invalid();
        const uint32_t columns = (*grid)[0], rows = (*grid)[1];
        if (columns < 1 || columns > size.x || rows < 1 || rows > size.y) return invalid();
        const auto index = tools::wholeNumber(word.substr(0, slash), 0, columns * rows - 1);
        if (!index) return invalid();
        setTile(region, *index, { columns, rows });
        return {};
    }
    const auto numbers = numbersOf(word, ',');
    if (!numbers || numbers->size() != 4) return invalid();
    const uint32_t x = (*numbers)[0], y = (*numbers)[1], width = (*numbers)[2], height = (*numbers)[3];
    if (x >= size.x || y >= size.y || width < 1 || width > size.x - x || height < 1 || height > size.y - y)
        return invalid();
    region.offset = { x, y }, region.size = { width, height };
    return {};
}

Result<void> convertSamples(std::string const& word, PassPlan const& plan, FilmRegion& region) {
    const auto numbers = numbersOf(word, ',');
    const uint32_t pass = plan.samplesPerPass, total = pass * plan.passes;
    const bool isRange = numbers && numbers->size() == 2 && (*numbers)[0] < total && (*numbers)[1] >= 1 &&
                         (*numbers)[1] <= total - (*numbers)[0];
    if (!isRange || (*numbers)[0] % pass || (*numbers)[1] % pass) {
        return invalidOption(
                "--samples", word,
                fmt::format("FIRST,COUNT, multiples of {} (a pass) within the {} samples of a pixel", pass, total)
                        .c_str());
    }
    region.passes = { (*numbers)[0] / pass, (*numbers)[1] / pass };
    return {};
}

/// The grid of `tiles` whose tiles are nearest to squares; nothing if none fits.
std::optional<uint2> gridOf(uint32_t tiles, uint2 size) {
    std::optional<uint2> best;
    double least = 0;
    for (uint32_t columns = 1; columns <= std::min(tiles, size.x); ++columns) {
        const uint32_t rows = tiles / columns;
        if (rows * columns != tiles || rows > size.y) continue;
        const double circumference = double(size.x) / columns + double(size.y) / rows;
        if (!best || circumference < least) best = { columns, rows }, least = circumference;
    }
    return best;
}

} // namespace

Result<FilmRegion> regionOf(std::string const& tile, std::string const& samples, uint2 size, PassPlan const& plan) {
    FilmRegion region{ { 0, 0 }, size, { 0, plan.passes } };
    if (!tile.empty()) {
        if (const Result<void> done = convertTile(tile, region); !done) return done.error();
    }
    if (!samples.empty()) {
        if (const Result<void> done = convertSamples(samples, plan, region); !done) return done.error();
    }
    return region;
}

Result<FilmRegion> regionOf(tools::Shard const& shard, uint2 size, PassPlan const& plan) {
    std::optional<std::pair<uint2, uint32_t>> chosen; // grid, and parts of the passes
    for (uint32_t parts = 1; parts <= std::min(shard.count, plan.passes); ++parts) {
        if (shard.count % parts != 0) continue;
        const std::optional<uint2> grid = gridOf(shard.count / parts, size);
        if (!grid) continue;
        chosen = { *grid, parts };
        if (size.x / grid->x >= kMinSide && size.y / grid->y >= kMinSide) break;
    }
    if (!chosen)
        return invalidOption(
                "--shard", fmt::format("{}/{}", shard.index, shard.count),
                fmt::format("a number of shards that divides {}x{} pixels and {} passes", size.x, size.y, plan.passes)
                        .c_str());
    auto const& [grid, parts] = *chosen;
    FilmRegion region{ { 0, 0 }, size, { 0, plan.passes } };
    setTile(region, shard.index / parts, grid);
    std::tie(region.passes.first, region.passes.count) = slice(plan.passes, shard.index % parts, parts);
    return region;
}

} // namespace filament_core::reference
