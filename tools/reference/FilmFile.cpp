// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/FilmFile.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/json/JsonReader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>

namespace filament_core::reference {
namespace {

using tools::Json;

static_assert(std::endian::native == std::endian::little, "partial films are little-endian");
static_assert(sizeof(PixelSums) == 6 * sizeof(double));

constexpr std::string_view kMagic = "FILMPART";
constexpr uint32_t kVersion = 1;
constexpr uint64_t kMaxHeader = 16u << 20;
constexpr uint32_t kMaxSide = 16384, kMaxPasses = 1u << 20;

struct Prefix {
    char magic[8];
    uint32_t version, headerBytes;
};

/// Thrown while a header is read: what is wrong with it.
struct Wrong {
    std::string what;
};

Error damaged(std::string const& name, std::string_view what) {
    return fail(ErrorCode::Corrupt, "{}: {}; render this part again", name, what);
}

uint32_t number(Json const& json, uint32_t low, uint32_t high) {
    if (!json.is_number_unsigned() || json.get<uint64_t>() < low || json.get<uint64_t>() > high)
        throw Wrong{ fmt::format("a number of its header is not from {} to {}", low, high) };
    return json.get<uint32_t>();
}

Json settingsToJson(PictureSettings const& settings) {
    return { { "commit", settings.commit },
             { "arguments", settings.arguments },
             { "contents", fmt::format("{:016x}", settings.contents) },
             { "size", { settings.size.x, settings.size.y } },
             { "samplesPerPass", settings.plan.samplesPerPass },
             { "passes", settings.plan.passes },
             { "warnings", settings.warnings } };
}

uint64_t fromHex(std::string const& text) {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (error != std::errc() || end != text.data() + text.size() || text.size() != 16)
        throw Wrong{ "a hash of its header is none" };
    return value;
}

PictureSettings settingsFromJson(Json const& json) {
    PictureSettings settings;
    settings.commit = json.at("commit");
    settings.arguments = json.at("arguments").get<std::vector<std::string>>();
    settings.contents = fromHex(json.at("contents"));
    settings.size = { number(json.at("size").at(0), 1, kMaxSide), number(json.at("size").at(1), 1, kMaxSide) };
    settings.plan = { number(json.at("samplesPerPass"), 1, kMaxPasses), number(json.at("passes"), 2, kMaxPasses) };
    settings.warnings = json.at("warnings").get<std::vector<std::string>>();
    return settings;
}

FilmRegion regionFromJson(Json const& json, PictureSettings const& settings) {
    Json const &tile = json.at("tile"), &range = json.at("passRange");
    const uint2 size = settings.size;
    const uint2 offset{ number(tile.at(0), 0, size.x - 1), number(tile.at(1), 0, size.y - 1) };
    const uint32_t first = number(range.at(0), 0, settings.plan.passes - 1);
    return { offset,
             { number(tile.at(2), 1, size.x - offset.x), number(tile.at(3), 1, size.y - offset.y) },
             { first, number(range.at(1), 1, settings.plan.passes - first) } };
}

PartHeader headerFromJson(Json const& json) {
    PartHeader header{ .settings = settingsFromJson(json.at("settings")) };
    if (fromHex(json.at("settingsHash")) != hashOf(header.settings))
        throw Wrong{ "its settings do not have the hash of its header" };
    header.region = regionFromJson(json, header.settings);
    if (json.contains("shard")) {
        const uint32_t count = number(json.at("shard").at(1), 1, tools::kMaxShards);
        header.shard = { number(json.at("shard").at(0), 0, count - 1), count };
    }
    header.rays = json.at("rays");
    header.lostSamples = json.at("lostSamples");
    header.seconds = json.at("seconds");
    return header;
}

uint64_t pixelBytes(FilmRegion const& region) {
    return uint64_t(region.size.x) * region.size.y * nodesOf(region.passes).size() * sizeof(PixelSums);
}

struct Parsed {
    PartHeader header;
    uint64_t pixels = 0; ///< where they begin
};

/// `fileBytes`: the length of the file, of which `begin` has at least the header.
Result<Parsed> parseHeader(std::span<const std::byte> begin, uint64_t fileBytes, std::string const& name) {
    Prefix prefix{};
    if (begin.size() >= sizeof(prefix)) std::memcpy(&prefix, begin.data(), sizeof(prefix));
    if (std::string_view(prefix.magic, sizeof(prefix.magic)) != kMagic)
        return fail(ErrorCode::Corrupt,
                    "{}: no partial film of filament-reference; give files written with --shard, "
                    "--tile or --samples",
                    name);
    if (prefix.version != kVersion)
        return damaged(name, fmt::format("version {} of partial films, not {}", prefix.version, kVersion));
    const uint64_t pixels = sizeof(prefix) + uint64_t(prefix.headerBytes);
    if (prefix.headerBytes > kMaxHeader || begin.size() < pixels) return damaged(name, "truncated");
    const auto* text = reinterpret_cast<const char*>(begin.data()) + sizeof(prefix);
    try {
        const Json json = Json::parse(text, text + prefix.headerBytes);
        Parsed parsed{ headerFromJson(json), pixels };
        const uint64_t expected = pixels + pixelBytes(parsed.header.region) + sizeof(uint64_t);
        if (fileBytes < expected) return damaged(name, fmt::format("truncated: {} of {} bytes", fileBytes, expected));
        if (fileBytes > expected) return damaged(name, fmt::format("{} bytes follow its end", fileBytes - expected));
        return parsed;
    } catch (Json::exception const&) {
        return damaged(name, "its header is damaged");
    } catch (Wrong const& wrong) {
        return damaged(name, wrong.what);
    }
}

template <class T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
    const auto added = std::as_bytes(values);
    bytes.insert(bytes.end(), added.begin(), added.end());
}

} // namespace

uint64_t hashOf(PictureSettings const& settings) {
    return hashString(settingsToJson(settings).dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::vector<std::byte> bytesOf(PictureSettings const& settings, PartialFilm const& part,
                               std::optional<tools::Shard> const& shard) {
    FilmRegion const& region = part.region;
    Json json{ { "settings", settingsToJson(settings) },
               { "settingsHash", fmt::format("{:016x}", hashOf(settings)) },
               { "tile", { region.offset.x, region.offset.y, region.size.x, region.size.y } },
               { "passRange", { region.passes.first, region.passes.count } } };
    if (shard) json["shard"] = { shard->index, shard->count };
    json["rays"] = part.rays, json["lostSamples"] = part.lostSamples, json["seconds"] = part.seconds;
    const std::string header = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    Prefix prefix{ {}, kVersion, static_cast<uint32_t>(header.size()) };
    std::memcpy(prefix.magic, kMagic.data(), sizeof(prefix.magic));

    std::vector<std::byte> bytes;
    bytes.reserve(sizeof(prefix) + header.size() + pixelBytes(region) + sizeof(uint64_t));
    append(bytes, std::span<const Prefix>(&prefix, 1));
    append(bytes, std::span<const char>(header));
    for (FilmNode const& node : part.nodes) append(bytes, std::span<const PixelSums>(node.pixels));
    const uint64_t hash = hashBytes(bytes);
    append(bytes, std::span<const uint64_t>(&hash, 1));
    return bytes;
}

Result<void> writePart(std::filesystem::path const& file, PictureSettings const& settings, PartialFilm const& part,
                       std::optional<tools::Shard> const& shard) {
    return assets::replaceFile(file, bytesOf(settings, part, shard));
}

Result<PartHeader> readPartHeader(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    std::error_code error;
    const uint64_t size = std::filesystem::file_size(file, error);
    if (!in || error)
        return fail(ErrorCode::Unreadable, "{}: {}; give the files or folders of all parts", file.string(),
                    error ? error.message() : "cannot be opened");
    std::vector<std::byte> begin(std::min<uint64_t>(size, sizeof(Prefix)));
    const auto extend = [&](uint64_t bytes) {
        const size_t had = begin.size();
        begin.resize(std::max<uint64_t>(had, std::min(size, bytes)));
        in.read(reinterpret_cast<char*>(begin.data() + had), static_cast<std::streamsize>(begin.size() - had));
    };
    in.read(reinterpret_cast<char*>(begin.data()), static_cast<std::streamsize>(begin.size()));
    if (begin.size() == sizeof(Prefix)) {
        Prefix prefix{};
        std::memcpy(&prefix, begin.data(), sizeof(prefix));
        extend(sizeof(Prefix) + std::min<uint64_t>(prefix.headerBytes, kMaxHeader));
    }
    if (!in) return fail(ErrorCode::Unreadable, "{}: cannot be read", file.string());
    Result<Parsed> parsed = parseHeader(begin, size, file.string());
    if (!parsed) return parsed.error();
    return std::move(parsed->header);
}

Result<PartialFilm> parsePart(std::span<const std::byte> bytes, std::string const& name) {
    const Result<Parsed> parsed = parseHeader(bytes, bytes.size(), name);
    if (!parsed) return parsed.error();
    uint64_t hash = 0;
    const auto hashed = bytes.first(bytes.size() - sizeof(hash));
    std::memcpy(&hash, bytes.data() + hashed.size(), sizeof(hash));
    if (hash != hashBytes(hashed)) return damaged(name, "damaged: its hash is another");
    PartHeader const& header = parsed->header;
    PartialFilm part{ header.region, {}, header.rays, header.lostSamples, header.seconds };
    auto rest = hashed.subspan(parsed->pixels);
    for (PassRange const& passes : nodesOf(header.region.passes)) {
        FilmNode& node = part.nodes.emplace_back(FilmNode{ passes, {} });
        node.pixels.resize(size_t(header.region.size.x) * header.region.size.y);
        const auto pixels = std::as_writable_bytes(std::span(node.pixels));
        std::memcpy(pixels.data(), rest.data(), pixels.size());
        rest = rest.subspan(pixels.size());
    }
    return part;
}

Result<PartialFilm> readPart(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    return bytes ? parsePart(*bytes, file.string()) : bytes.error();
}

} // namespace filament_core::reference
