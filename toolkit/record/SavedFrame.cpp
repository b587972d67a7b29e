// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/SavedFrame.h"

#include "backend/api/Format.h"
#include "base/Hash.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/pictures/Pixels.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace filament_core::record {
namespace {

PictureRecord pictureRecord(FramePicture const& picture) {
    return { .name = picture.name,
             .format = picture.image.format,
             .size = { picture.image.width, picture.image.height },
             .space = picture.space,
             .hash = hashBytes(picture.image.pixels) };
}

Result<void> checkPictures(std::span<const FramePicture> pictures) {
    if (pictures.empty() || pictures.size() > kMaxPictures)
        return fail(ErrorCode::InvalidArgument, "a saved frame has 1 to {} pictures, not {}", kMaxPictures,
                    pictures.size());
    std::set<std::string> names;
    for (FramePicture const& picture : pictures) {
        Image const& image = picture.image;
        if (!isPictureName(picture.name) || !names.insert(picture.name).second)
            return fail(ErrorCode::InvalidArgument,
                        "'{}' cannot name a picture: give each another one of 1 to 32 of a-z, 0-9 and '-'",
                        picture.name);
        if (image.width == 0 || image.height == 0 || image.width > kMaxPictureSide || image.height > kMaxPictureSide)
            return fail(ErrorCode::InvalidArgument, "picture '{}' has {}x{} pixels; give 1 to {} a side", picture.name,
                        image.width, image.height, kMaxPictureSide);
        if (image.pixels.size() != backend::imageBytes(image.format, image.width, image.height))
            return fail(ErrorCode::InvalidArgument, "picture '{}' of {}x{} pixels has {} bytes", picture.name,
                        image.width, image.height, image.pixels.size());
        if (!isPictureFormat(image.format))
            return fail(ErrorCode::InvalidArgument,
                        "picture '{}' is {}; a saved frame has RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F", picture.name,
                        backend::formatInfo(image.format).name);
    }
    return {};
}

Result<void> checkRequest(SaveRequest const& request) {
    if (!request.recipe) return fail(ErrorCode::InvalidArgument, "a frame is saved with a recipe that draws it");
    if (request.settings.size() > kMaxSettingsBytes || !nlohmann::ordered_json::accept(request.settings))
        return fail(ErrorCode::InvalidArgument, "the settings of a saved frame are JSON of at most {} bytes",
                    kMaxSettingsBytes);
    std::set<Backend> apis;
    for (const Backend backend : request.backends) {
        if (backend == Backend::Null || !apis.insert(backend).second)
            return fail(ErrorCode::InvalidArgument, "a frame is saved on vulkan, on gles or on both, not on {}",
                        backend == Backend::Null ? "null" : "one of them twice");
    }
    return request.shown.empty() ? Result<void>{} : checkPictures(request.shown);
}

/// Makes the folder, and removes frame.json and the traces of an earlier frame: without frame.json it is none.
Result<void> clearFolder(std::filesystem::path const& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return fail(ErrorCode::Unreadable, "cannot make the folder '{}': {}; choose another one", folder.string(),
                    error.message());
    std::filesystem::remove(manifestPath(folder), error);
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        std::filesystem::remove(tracePath(folder, backend), error);
        std::filesystem::remove(payloadPath(folder, backend), error);
    }
    return {};
}

/// How an image differs from the one that was shown; empty if it does not.
std::string differenceOf(FramePicture const& shown, FramePicture const& drawn) {
    if (shown.name != drawn.name) return fmt::format("it draws '{}' where '{}' was shown", drawn.name, shown.name);
    Image const &a = shown.image, &b = drawn.image;
    if (a.width != b.width || a.height != b.height || a.format != b.format)
        return fmt::format("picture '{}' has {}x{} pixels of {} instead of {}x{} of {}", shown.name, b.width, b.height,
                           backend::formatInfo(b.format).name, a.width, a.height, backend::formatInfo(a.format).name);
    const auto first = tools::firstDifference(a.format, a.width, a.pixels, b.pixels);
    if (!first) return {};
    return fmt::format("picture '{}': {} pixels are not as shown, first ({}, {}): {} instead of {}", shown.name,
                       first->count, first->x, first->y, tools::textOf(first->b), tools::textOf(first->a));
}

std::string differenceOf(std::span<const FramePicture> shown, std::span<const FramePicture> drawn) {
    if (shown.size() != drawn.size())
        return fmt::format("it draws {} pictures where {} were shown", drawn.size(), shown.size());
    for (size_t i = 0; i < shown.size(); ++i) {
        if (std::string text = differenceOf(shown[i], drawn[i]); !text.empty()) return text;
    }
    return {};
}

/// What one API drew, with its trace on disk.
struct Drawn {
    TraceRecord record;
    std::vector<FramePicture> pictures;
};

/// Nothing: this API has no device, which is then noted.
Result<std::optional<Drawn>> drawOn(SaveRequest const& request, Backend backend, Manifest& manifest) {
    EngineOptions options = request.engine;
    options.backend = backend;
    options.traceFile = tracePath(request.folder, backend);
    options.debug = {};
    Result<Engine> engine = Engine::create(options);
    if (!engine) {
        if (engine.error().code != ErrorCode::DeviceUnavailable) return engine.error();
        manifest.absent.push_back({ backend, engine.error().message });
        return std::optional<Drawn>();
    }
    Drawn drawn;
    drawn.record.backend = backend;
    drawn.record.device = engine->device().device;
    drawn.record.driver = engine->device().driver;
    Result<std::vector<FramePicture>> pictures = request.recipe(*engine);
    if (!pictures) return fail(pictures.error().code, "{}: {}", toString(backend), pictures.error().message);
    if (const Result<void> good = checkPictures(*pictures); !good) return good.error();
    drawn.pictures = std::move(*pictures);
    return std::optional(std::move(drawn)); // the end of the engine is in the trace, too
}

/// The last frames that can be looked into.
std::vector<FrameCut> lastFrames(Trace const& trace) {
    std::vector<FrameCut> cuts;
    for (size_t i = trace.frames.size(); i > 0 && cuts.size() < kMaxHashedFrames; --i) {
        const bool isFirstOfStream = i == 1 || trace.frames[i - 2].stream != trace.frames[i - 1].stream;
        if (isFirstOfStream) cuts.push_back({ .frame = static_cast<uint32_t>(i - 1) });
    }
    std::ranges::reverse(cuts);
    return cuts;
}

/// The read-back that answered with the image: the last one with its bits, or else with as many bytes.
DrawnPicture findPicture(Replayed const& replayed, Image const& image, std::set<uint64_t>& used) {
    const uint64_t hash = hashBytes(image.pixels);
    for (const bool needsBits : { true, false }) {
        for (size_t i = replayed.answers.size(); i > 0; --i) {
            Answer const& answer = replayed.answers[i - 1];
            const bool fits = needsBits ? answer.hash == hash : answer.bytes == image.pixels.size();
            if (fits && used.insert(answer.ticket).second) return { answer.ticket, answer.hash };
        }
    }
    return {};
}

/// Replays the trace as it is on disk: sizes, hashes, passes, and whether it draws what the engine has drawn.
Result<void> examine(std::filesystem::path const& folder, Drawn& drawn) {
    TraceRecord& record = drawn.record;
    const Result<TraceBytes> bytes = readTraceBytes(folder, record.backend);
    if (!bytes) return bytes.error();
    record.textBytes = bytes->text.size(), record.textHash = bytes->textHash();
    record.payloadBytes = bytes->payload.size(), record.payloadHash = bytes->payloadHash();
    const Result<Trace> trace = parseTrace(*bytes, record.backend, tracePath(folder, record.backend).string());
    if (!trace) return trace.error();
    const ReplayRequest request{ .backend = record.backend,
                                 .requireDevice = record.device,
                                 .inside = lastFrames(*trace) };
    const Result<Replayed> replayed = replayTrace(*trace, request);
    if (!replayed) return replayed.error();
    for (size_t i = 0; i < replayed->inside.size(); ++i)
        record.frames.push_back(recordOf(replayed->inside[i], request.inside[i].frame));
    std::set<uint64_t> used;
    for (FramePicture const& picture : drawn.pictures) {
        record.pictures.push_back(findPicture(*replayed, picture.image, used));
        if (record.pictures.back().hash == hashBytes(picture.image.pixels) || !record.problem.empty()) continue;
        record.problem = fmt::format("picture '{}': the replay of its trace has other bits than the frame{}",
                                     picture.name, replayed->errors.empty() ? "" : ": " + replayed->errors.front());
    }
    return {};
}

Result<void> savePicture(std::filesystem::path const& folder, FramePicture const& picture) {
    const std::filesystem::path path = picturePath(folder, pictureRecord(picture));
    return picture.image.format == Format::RGBA16F ? saveExr(path, picture.image)
                                                   : savePng(path, picture.image, picture.space);
}

/// Draws on every API that there is; completes what is expected with the images of the first one.
Result<std::vector<Drawn>> drawAll(SaveRequest const& request, std::vector<FramePicture>& shown, Manifest& manifest) {
    std::vector<Drawn> all;
    for (const Backend backend : request.backends) {
        Result<std::optional<Drawn>> drawn = drawOn(request, backend, manifest);
        if (!drawn) return drawn.error();
        if (!*drawn) continue;
        if (shown.empty()) shown = (*drawn)->pictures;
        (*drawn)->record.problem = differenceOf(shown, (*drawn)->pictures);
        all.push_back(std::move(**drawn));
    }
    if (all.empty())
        return fail(ErrorCode::DeviceUnavailable, "the frame cannot be saved: {}",
                    manifest.absent.empty() ? "no API was asked for" : manifest.absent.front().reason);
    return all;
}

std::string nameOf(FrameRecord const& frame, size_t pass) {
    return fmt::format("frame {}, pass {} '{}'", frame.index + 1, pass + 1, frame.passes[pass].name);
}

/// Empty: both have the same passes with the same attachments and bits.
std::string changeBetween(FrameRecord const& before, FrameRecord const& now) {
    for (size_t i = 0; i < std::min(before.passes.size(), now.passes.size()); ++i) {
        PassRecord const &a = before.passes[i], &b = now.passes[i];
        if (a.name != b.name || a.draws != b.draws || a.attachments.size() != b.attachments.size())
            return fmt::format("{} is '{}' now", nameOf(before, i), b.name);
        for (size_t k = 0; k < a.attachments.size(); ++k) {
            if (a.attachments[k].hash != b.attachments[k].hash)
                return fmt::format("{}, attachment '{}'", nameOf(before, i), a.attachments[k].name);
        }
    }
    return before.passes.size() == now.passes.size()
                   ? std::string()
                   : fmt::format("frame {} has {} passes instead of {}", before.index + 1, now.passes.size(),
                                 before.passes.size());
}

} // namespace

Result<Manifest> saveFrame(SaveRequest const& request) {
    if (Result<void> good = checkRequest(request); !good) return good.error();
    if (Result<void> cleared = clearFolder(request.folder); !cleared) return cleared.error();
    Manifest manifest{ .program = request.program,
                       .commit = tools::builtCommit(),
                       .machine = tools::describeMachine(),
                       .settings = request.settings };
    std::vector<FramePicture> shown = request.shown;
    Result<std::vector<Drawn>> all = drawAll(request, shown, manifest);
    if (!all) return all.error();
    for (FramePicture const& picture : shown) {
        manifest.pictures.push_back(pictureRecord(picture));
        if (Result<void> saved = savePicture(request.folder, picture); !saved) return saved.error();
    }
    for (Drawn& drawn : *all) {
        if (Result<void> examined = examine(request.folder, drawn); !examined) return examined.error();
        drawn.record.pictures.resize(shown.size());
        manifest.traces.push_back(std::move(drawn.record));
    }
    if (Result<void> written = writeManifest(request.folder, manifest); !written) return written.error();
    return manifest;
}

std::vector<std::string> problemsOf(Manifest const& manifest) {
    std::vector<std::string> lines;
    for (TraceRecord const& trace : manifest.traces) {
        if (!trace.problem.empty()) lines.push_back(fmt::format("{}: {}", toString(trace.backend), trace.problem));
    }
    for (AbsentBackend const& absent : manifest.absent)
        lines.push_back(fmt::format("{}: not saved: {}", toString(absent.backend), absent.reason));
    return lines;
}

Result<Verdict> compareReplay(Manifest const& manifest, Trace const& trace, ReplayRequest const& request) {
    TraceRecord const* const record = findTrace(manifest, trace.backend);
    if (!record) return fail(ErrorCode::NotFound, "the folder has no trace of {}", toString(trace.backend));
    ReplayRequest drawing = request;
    drawing.backend = trace.backend;
    for (DrawnPicture const& picture : record->pictures) drawing.keep.push_back(picture.ticket);
    Result<Replayed> replayed = replayTrace(trace, drawing);
    if (!replayed) return replayed.error();
    Verdict verdict{ .device = replayed->device, .driver = replayed->driver, .errors = std::move(replayed->errors) };
    for (size_t i = 0; i < manifest.pictures.size(); ++i) {
        PictureRecord const& wanted = manifest.pictures[i];
        std::vector<std::byte> pixels = std::move(replayed->kept[record->pictures[i].ticket]);
        const uint64_t hash = hashBytes(pixels);
        if (pixels.size() != backend::imageBytes(wanted.format, wanted.size.x, wanted.size.y)) {
            pixels.clear();
            if (verdict.difference.empty()) verdict.difference = fmt::format("picture '{}' was not drawn", wanted.name);
        } else if (hash != wanted.hash && verdict.difference.empty()) {
            verdict.difference =
                    fmt::format("picture '{}' has the hash {:016x} instead of {:016x}", wanted.name, hash, wanted.hash);
        }
        verdict.pictures.push_back(
                { wanted.name, Image{ wanted.size.x, wanted.size.y, wanted.format, std::move(pixels) }, wanted.space });
    }
    return verdict;
}

Result<std::string> firstChangedPass(Manifest const& manifest, Trace const& trace, ReplayRequest const& request) {
    TraceRecord const* const record = findTrace(manifest, trace.backend);
    if (!record) return fail(ErrorCode::NotFound, "the folder has no trace of {}", toString(trace.backend));
    ReplayRequest looking = request;
    looking.backend = trace.backend;
    for (FrameRecord const& frame : record->frames) looking.inside.push_back({ .frame = frame.index });
    const Result<Replayed> replayed = replayTrace(trace, looking);
    if (!replayed) return replayed.error();
    for (size_t i = 0; i < record->frames.size(); ++i) {
        const FrameRecord now = recordOf(replayed->inside[i], record->frames[i].index);
        if (std::string change = changeBetween(record->frames[i], now); !change.empty()) return change;
    }
    return std::string();
}

Result<std::string> firstDisagreement(Trace const& a, ReplayRequest const& ofA, Trace const& b,
                                      ReplayRequest const& ofB) {
    const size_t count = std::min({ a.frames.size(), b.frames.size(), size_t{ kMaxHashedFrames } });
    for (size_t back = count; back > 0; --back) {
        const auto frameA = static_cast<uint32_t>(a.frames.size() - back);
        const auto frameB = static_cast<uint32_t>(b.frames.size() - back);
        const auto found = tools::bisect(frameOf(a, ofA, frameA), frameOf(b, ofB, frameB));
        if (!found) return found.error();
        if (*found) return fmt::format("frame {}, {}", frameA + 1, (*found)->line());
    }
    return std::string();
}

} // namespace filament_core::record
