// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/Manifest.h"

#include "backend/layers/EnumNames.h"
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace filament_core::record {
namespace {

using tools::Json;
using tools::JsonReader;

constexpr const char* kVersion = "filament-frame 1";
constexpr size_t kMaxNameLength = 32, kMaxTextLength = 4096;
constexpr double kMaxBytes = 0x1p40;

std::string hexOf(uint64_t value) { return fmt::format("{:016x}", value); }

Json sizeOf(uint2 size) { return Json::array({ size.x, size.y }); }

std::string nameOf(Format format) { return std::string(backend::enumName(format)); }

std::optional<Format> formatFromName(std::string_view name) {
    const std::optional<size_t> index = backend::enumIndex<Format>(name);
    return index ? std::optional(static_cast<Format>(*index)) : std::nullopt;
}

// ---------------------------------------------------------------------------------------------- writing

Json toJson(AttachmentRecord const& attachment) {
    return { { "name", attachment.name },
             { "format", nameOf(attachment.format) },
             { "size", sizeOf(attachment.size) },
             { "hash", hexOf(attachment.hash) } };
}

Json toJson(FrameRecord const& frame) {
    Json passes = Json::array();
    for (PassRecord const& pass : frame.passes) {
        Json attachments = Json::array();
        for (AttachmentRecord const& attachment : pass.attachments) attachments.push_back(toJson(attachment));
        passes.push_back({ { "name", pass.name }, { "draws", pass.draws }, { "attachments", std::move(attachments) } });
    }
    return { { "index", frame.index }, { "passes", std::move(passes) } };
}

Json toJson(TraceRecord const& trace) {
    Json pictures = Json::array(), frames = Json::array();
    for (DrawnPicture const& picture : trace.pictures)
        pictures.push_back({ { "ticket", picture.ticket }, { "hash", hexOf(picture.hash) } });
    for (FrameRecord const& frame : trace.frames) frames.push_back(toJson(frame));
    return { { "backend", toString(trace.backend) },
             { "device", trace.device },
             { "driver", trace.driver },
             { "textBytes", trace.textBytes },
             { "textHash", hexOf(trace.textHash) },
             { "payloadBytes", trace.payloadBytes },
             { "payloadHash", hexOf(trace.payloadHash) },
             { "problem", trace.problem },
             { "pictures", std::move(pictures) },
             { "frames", std::move(frames) } };
}

Json toJson(PictureRecord const& picture) {
    return { { "name", picture.name },
             { "format", nameOf(picture.format) },
             { "size", sizeOf(picture.size) },
             { "space", toString(picture.space) },
             { "hash", hexOf(picture.hash) } };
}

// ---------------------------------------------------------------------------------------------- reading

// Names are printed: no line breaks, no control sequences of terminals.
void readName(JsonReader& reader, const char* key, std::string& value) {
    reader.read(key, value);
    const bool isPlain = std::none_of(value.begin(), value.end(),
                                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (value.size() > kMaxTextLength || !isPlain)
        reader.complain(key, fmt::format("expected up to {} characters in one line", kMaxTextLength));
}

void readHash(JsonReader& reader, const char* key, uint64_t& value) {
    std::string text = hexOf(0);
    reader.read(key, text);
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != 16 || status != std::errc{} || end != text.data() + text.size() || hexOf(value) != text)
        reader.complain(key, "expected 16 lower-case hexadecimal digits");
}

void readCount(JsonReader& reader, const char* key, uint64_t& value) {
    double number = 0;
    reader.read(key, number, 0, kMaxBytes);
    value = static_cast<uint64_t>(number);
    if (static_cast<double>(value) != number) reader.complain(key, "expected a whole number");
}

void readSize(JsonReader& reader, uint2& size) {
    double sides[2] = { 1, 1 };
    reader.numbers("size", sides, 2, 1, kMaxPictureSide);
    size = { static_cast<uint32_t>(sides[0]), static_cast<uint32_t>(sides[1]) };
    if (double(size.x) != sides[0] || double(size.y) != sides[1]) reader.complain("size", "expected whole numbers");
}

void readFormat(JsonReader& reader, Format& format) {
    reader.choice("format", format, "expected a name such as RGBA8", formatFromName);
}

void readBackend(JsonReader& reader, Backend& backend) {
    reader.choice("backend", backend, "expected vulkan or gles", [](std::string const& name) {
        const std::optional<Backend> known = enumFromName<Backend>(name);
        return known && *known != Backend::Null ? known : std::nullopt;
    });
}

/// A list of at most `most` objects.
template <class T, class Fill>
void readList(JsonReader& reader, const char* key, std::vector<T>& list, uint32_t most, Fill const& fill) {
    reader.objects(key, [&](JsonReader& element) {
        T& value = list.emplace_back();
        fill(element, value);
        if (list.size() > most) element.complain("number", fmt::format("expected at most {}", most));
    });
}

void readPicture(JsonReader& reader, PictureRecord& picture) {
    readName(reader, "name", picture.name);
    if (!isPictureName(picture.name)) reader.complain("name", "expected 1 to 32 of a-z, 0-9 and '-'");
    readFormat(reader, picture.format);
    if (!isPictureFormat(picture.format)) reader.complain("format", "expected RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F");
    readSize(reader, picture.size);
    reader.choice("space", picture.space, "expected a colour space such as srgb", enumFromName<OutputSpace>);
    readHash(reader, "hash", picture.hash);
}

void readAttachment(JsonReader& reader, AttachmentRecord& attachment) {
    readName(reader, "name", attachment.name);
    readFormat(reader, attachment.format);
    readSize(reader, attachment.size);
    readHash(reader, "hash", attachment.hash);
}

void readFrame(JsonReader& reader, FrameRecord& frame) {
    reader.read("index", frame.index, 0, 1u << 30);
    readList(reader, "passes", frame.passes, kMaxPasses, [](JsonReader& element, PassRecord& pass) {
        readName(element, "name", pass.name);
        element.read("draws", pass.draws, 0, 1u << 30);
        readList(element, "attachments", pass.attachments, kMaxAttachments, readAttachment);
    });
}

void readTraceRecord(JsonReader& reader, TraceRecord& trace) {
    readBackend(reader, trace.backend);
    readName(reader, "device", trace.device);
    readName(reader, "driver", trace.driver);
    readCount(reader, "textBytes", trace.textBytes);
    readHash(reader, "textHash", trace.textHash);
    readCount(reader, "payloadBytes", trace.payloadBytes);
    readHash(reader, "payloadHash", trace.payloadHash);
    readName(reader, "problem", trace.problem);
    readList(reader, "pictures", trace.pictures, kMaxPictures, [](JsonReader& element, DrawnPicture& picture) {
        readCount(element, "ticket", picture.ticket);
        readHash(element, "hash", picture.hash);
    });
    readList(reader, "frames", trace.frames, kMaxHashedFrames, readFrame);
}

/// What the fields say together.
void checkWhole(JsonReader& reader, Manifest const& manifest) {
    if (manifest.pictures.empty()) reader.complain("pictures", "expected at least one");
    for (size_t i = 0; i < manifest.pictures.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            if (manifest.pictures[i].name == manifest.pictures[k].name)
                reader.complain("pictures", fmt::format("'{}' is there twice", manifest.pictures[i].name));
        }
    }
    for (TraceRecord const& trace : manifest.traces) {
        if (findTrace(manifest, trace.backend) != &trace)
            reader.complain("traces", fmt::format("{} is there twice", toString(trace.backend)));
        if (trace.pictures.size() != manifest.pictures.size())
            reader.complain("traces", fmt::format("{} draws {} of {} pictures", toString(trace.backend),
                                                  trace.pictures.size(), manifest.pictures.size()));
    }
}

void readWhole(JsonReader& reader, Manifest& manifest) {
    std::string version;
    reader.read("version", version);
    if (version != kVersion) reader.complain("version", fmt::format("expected \"{}\"", kVersion));
    readName(reader, "program", manifest.program);
    readName(reader, "commit", manifest.commit);
    readName(reader, "machine", manifest.machine);
    if (Json const* settings = reader.raw("settings")) manifest.settings = settings->dump();
    readList(reader, "pictures", manifest.pictures, kMaxPictures, readPicture);
    readList(reader, "traces", manifest.traces, 2, readTraceRecord);
    readList(reader, "absent", manifest.absent, 2, [](JsonReader& element, AbsentBackend& absent) {
        readBackend(element, absent.backend);
        readName(element, "reason", absent.reason);
    });
    checkWhole(reader, manifest);
}

} // namespace

TraceRecord const* findTrace(Manifest const& manifest, Backend backend) {
    const auto found = std::ranges::find(manifest.traces, backend, &TraceRecord::backend);
    return found == manifest.traces.end() ? nullptr : &*found;
}

bool isPictureName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxNameLength && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    });
}

bool isPictureFormat(Format format) {
    return format == Format::RGBA8 || format == Format::RGBA8Srgb || format == Format::RGB10A2 ||
           format == Format::RGBA16F;
}

std::filesystem::path manifestPath(std::filesystem::path const& folder) { return folder / "frame.json"; }

std::filesystem::path tracePath(std::filesystem::path const& folder, Backend backend) {
    return folder / fmt::format("{}.trace", toString(backend));
}

std::filesystem::path payloadPath(std::filesystem::path const& folder, Backend backend) {
    return folder / fmt::format("{}.trace.bin", toString(backend));
}

std::filesystem::path picturePath(std::filesystem::path const& folder, PictureRecord const& picture) {
    return folder / fmt::format("{}.{}", picture.name, picture.format == Format::RGBA16F ? "exr" : "png");
}

std::string toJson(Manifest const& manifest) {
    Json pictures = Json::array(), traces = Json::array(), absent = Json::array();
    for (PictureRecord const& picture : manifest.pictures) pictures.push_back(toJson(picture));
    for (TraceRecord const& trace : manifest.traces) traces.push_back(toJson(trace));
    for (AbsentBackend const& one : manifest.absent)
        absent.push_back({ { "backend", toString(one.backend) }, { "reason", one.reason } });
    Json settings = Json::parse(manifest.settings, nullptr, false);
    if (settings.is_discarded()) settings = Json::object();
    const Json json{
        { "version", kVersion },         { "program", manifest.program },     { "commit", manifest.commit },
        { "machine", manifest.machine }, { "settings", std::move(settings) }, { "pictures", std::move(pictures) },
        { "traces", std::move(traces) }, { "absent", std::move(absent) }
    };
    return tools::jsonText(json);
}

Result<Manifest> parseManifest(std::string_view text, std::string const& name) {
    const Result<Json> json = tools::parseJson(text, name);
    if (!json) return fail(ErrorCode::Corrupt, "{}; save the frame again", json.error().message);
    Manifest manifest;
    JsonReader reader(*json, name);
    readWhole(reader, manifest);
    if (const Result<void> read = reader.finish(); !read) return Error{ ErrorCode::Corrupt, read.error().message };
    return manifest;
}

Result<Manifest> readManifest(std::filesystem::path const& folder) {
    const std::filesystem::path path = manifestPath(folder);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        return fail(ErrorCode::NotFound, "'{}' is no saved frame: it has no file frame.json", folder.string());
    const Result<std::string> text = assets::readText(path, kMaxManifestBytes);
    if (!text) return text.error();
    return parseManifest(*text, path.string());
}

Result<void> writeManifest(std::filesystem::path const& folder, Manifest const& manifest) {
    const std::string text = toJson(manifest);
    return assets::replaceFile(manifestPath(folder), std::as_bytes(std::span(text)));
}

} // namespace filament_core::record
