// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace filament_core::reference {
namespace {

std::string words(std::vector<std::string> const& arguments, size_t from) {
    std::string text;
    for (size_t i = from; i < std::min(arguments.size(), from + 2); ++i) text += (i == from ? "" : " ") + arguments[i];
    return text.empty() ? "nothing" : "'" + text + "'";
}

/// Where two command lines part, beginning with the option that differs.
std::string differenceOf(std::vector<std::string> const& a, std::vector<std::string> const& b) {
    size_t at = 0;
    while (at < a.size() && at < b.size() && a[at] == b[at]) ++at;
    while (at > 0 && (at >= a.size() || !a[at].starts_with("--")) && (at >= b.size() || !b[at].starts_with("--"))) --at;
    return fmt::format("{} here, {} there", words(a, at), words(b, at));
}

Result<void> checkSame(FilmPart const& part, FilmPart const& first) {
    PictureSettings const &a = part.header.settings, &b = first.header.settings;
    if (hashOf(a) == hashOf(b)) return {};
    std::string what = "other settings";
    if (a.arguments != b.arguments)
        what = fmt::format("another command line: {}; give both the same", differenceOf(a.arguments, b.arguments));
    else if (a.commit != b.commit)
        what = fmt::format("another build: {} here, {} there; use one", a.commit, b.commit);
    else if (a.contents != b.contents)
        what = "files of the scene with other contents; give both the same files";
    return fail(ErrorCode::InvalidArgument, "{} and {} were rendered with {}", part.file.string(), first.file.string(),
                what);
}

Result<void> checkDisjoint(std::vector<FilmPart> const& parts) {
    std::vector<FilmPart const*> byRow;
    for (FilmPart const& part : parts) byRow.push_back(&part);
    std::ranges::stable_sort(byRow, {}, [](FilmPart const* part) { return part->header.region.offset.y; });
    for (size_t i = 0; i < byRow.size(); ++i) {
        FilmRegion const& region = byRow[i]->header.region;
        for (size_t j = i + 1; j < byRow.size(); ++j) {
            FilmRegion const& other = byRow[j]->header.region;
            if (other.offset.y >= region.offset.y + region.size.y) break;
            const FilmRegion both = intersection(region, other);
            if (both.size.x == 0 || both.size.y == 0 || both.passes.count == 0) continue;
            const std::string files = byRow[j]->file.string() + " and " + byRow[i]->file.string();
            if (region == other) return fail(ErrorCode::InvalidArgument, "{} are the same part; give it once", files);
            return fail(ErrorCode::InvalidArgument, "{} overlap in {}; leave one out and render the rest of it", files,
                        toString(both));
        }
    }
    return {};
}

/// The first passes that no part of `column` has.
std::optional<PassRange> gapOf(std::vector<PassRange> column, uint32_t passes) {
    std::ranges::sort(column, {}, &PassRange::first);
    uint32_t next = 0;
    for (PassRange const& range : column) {
        if (range.first > next) return PassRange{ next, range.first - next };
        next = range.end();
    }
    if (next < passes) return PassRange{ next, passes - next };
    return std::nullopt;
}

// The upper left corner of what is missing has the row of the image's or a part's border, and so has its column.
Result<void> checkCovered(std::vector<FilmPart> const& parts) {
    PictureSettings const& settings = parts.front().header.settings;
    std::set<uint32_t> rows{ 0 };
    for (FilmPart const& part : parts) rows.insert(part.header.region.offset.y + part.header.region.size.y);
    for (const uint32_t y : rows) {
        if (y >= settings.size.y) continue;
        std::set<uint32_t> columns{ 0 };
        std::vector<FilmRegion> inRow;
        for (FilmPart const& part : parts) {
            FilmRegion const& region = part.header.region;
            if (y < region.offset.y || y >= region.offset.y + region.size.y) continue;
            inRow.push_back(region);
            columns.insert(region.offset.x + region.size.x);
        }
        for (const uint32_t x : columns) {
            if (x >= settings.size.x) continue;
            std::vector<PassRange> column;
            for (FilmRegion const& region : inRow)
                if (x >= region.offset.x && x < region.offset.x + region.size.x) column.push_back(region.passes);
            const std::optional<PassRange> gap = gapOf(std::move(column), settings.plan.passes);
            if (!gap) continue;
            const uint32_t samples = settings.plan.samplesPerPass;
            return fail(ErrorCode::InvalidArgument,
                        "no part has pixel {},{} with --samples {},{}; render the part that is missing and merge again",
                        x, y, gap->first * samples, gap->count * samples);
        }
    }
    return {};
}

} // namespace

Result<void> checkParts(std::vector<FilmPart> const& parts) {
    if (parts.empty())
        return fail(ErrorCode::InvalidArgument, "there is nothing to merge; give the files of all parts");
    for (FilmPart const& part : parts)
        if (const Result<void> same = checkSame(part, parts.front()); !same) return same;
    if (const Result<void> disjoint = checkDisjoint(parts); !disjoint) return disjoint;
    std::vector<tools::Shard> shards;
    for (FilmPart const& part : parts)
        if (part.header.shard) shards.push_back(*part.header.shard);
    if (shards.size() == parts.size())
        if (const Result<void> complete = tools::checkComplete(std::move(shards)); !complete) return complete;
    return checkCovered(parts);
}

Result<MergedPicture> mergeParts(std::vector<std::filesystem::path> const& files) {
    std::vector<FilmPart> parts;
    for (std::filesystem::path const& given : files) {
        const std::filesystem::path file = std::filesystem::is_directory(given) ? given / kPartName : given;
        Result<PartHeader> header = readPartHeader(file);
        if (!header) return header.error();
        parts.push_back({ file, std::move(*header) });
    }
    // The headers first: a missing part shows before gigabytes of pixels are read.
    if (const Result<void> checked = checkParts(parts); !checked) return checked.error();
    // FilmMerger adds the nodes of a pixel in the order of their passes.
    std::ranges::stable_sort(parts, {}, [](FilmPart const& part) { return part.header.region.passes.first; });
    PictureSettings const& settings = parts.front().header.settings;
    FilmMerger merger(settings.size, settings.plan);
    for (FilmPart const& part : parts) {
        const Result<PartialFilm> film = readPart(part.file);
        if (!film) return film.error();
        if (film->region != part.header.region)
            return fail(ErrorCode::Unreadable, "{} changed while it was read; merge again", part.file.string());
        merger.add(*film);
    }
    return MergedPicture{ settings, merger.finish() };
}

} // namespace filament_core::reference
