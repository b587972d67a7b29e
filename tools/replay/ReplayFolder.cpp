// SPDX-License-Identifier: Apache-2.0
#include "tools/replay/ReplayFolder.h"

#include "base/Hash.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/Console.h"
#include "tools/replay/Attachments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace filament_core::replay {
namespace {

using record::Manifest;
using record::ReplayRequest;
using record::Trace;
using record::TraceRecord;

/// A trace of the folder, and how to replay it.
struct Track {
    TraceRecord const* record = nullptr;
    Trace trace;
    ReplayRequest request;
    const char* name() const { return toString(trace.backend); }
};

/// Everything that one call works with.
struct Work {
    Options const& options;
    Manifest manifest;
    std::vector<Track> tracks;
    Report report;

    template <class... Args>
    void say(fmt::format_string<Args...> format, Args&&... args) {
        report.text += fmt::format(format, std::forward<Args>(args)...) + '\n';
    }
};

Result<Track> loadTrack(Work const& work, TraceRecord const& record, Edits const& edits) {
    Result<Trace> trace = record::loadTrace(work.options.folder, record);
    if (!trace) return trace.error();
    Track track{ .record = &record, .trace = std::move(*trace) };
    track.request.backend = record.backend;
    track.request.requireDevice = work.options.requireDevice;
    if (const auto edit = edits.find(record.backend); edit != edits.end()) track.request.edit = edit->second;
    return track;
}

/// The null driver has no shaders to run: it can check every trace.
Result<void> loadTracks(Work& work, Edits const& edits) {
    std::vector<Backend> const& wanted = work.options.backends;
    const bool isAll = wanted.empty() || wanted.front() == Backend::Null;
    for (TraceRecord const& record : work.manifest.traces) {
        if (!isAll && std::ranges::find(wanted, record.backend) == wanted.end()) continue;
        Result<Track> track = loadTrack(work, record, edits);
        if (!track) return track.error();
        work.tracks.push_back(std::move(*track));
    }
    if (!work.tracks.empty()) return {};
    const std::vector<std::string> problems = problemsOf(work.manifest);
    return fail(ErrorCode::NotFound, "'{}' has no trace of {}{}", work.options.folder.string(),
                isAll ? "any API" : toString(wanted.front()), problems.empty() ? "" : "; " + problems.front());
}

// ---------------------------------------------------------------------------------------------- --list

void listFrame(Work& work, Track const& track, size_t index) {
    record::ListedFrame const& frame = track.trace.frames[index];
    work.say("{}: frame {} of {}: {} passes, {} draws", track.name(), index + 1, track.trace.frames.size(),
             frame.passes.size(), frame.draws.size());
    for (size_t i = 0; i < frame.passes.size(); ++i) {
        record::ListedPass const& pass = frame.passes[i];
        work.say("  pass {} '{}': {} draws to {}", i + 1, pass.name, pass.drawCount, fmt::join(pass.attachments, ", "));
        for (uint32_t k = pass.firstDraw; k < pass.firstDraw + pass.drawCount; ++k) {
            record::ListedDraw const& draw = frame.draws[k];
            work.say("    draw {} '{}': {} {}, {} instances", k + 1, draw.pipeline, draw.vertices,
                     draw.isIndexed ? "indices" : "vertices", draw.instances);
        }
    }
}

void listAll(Work& work) {
    work.say("saved by {}, commit {}", work.manifest.program, work.manifest.commit);
    work.say("on {}", work.manifest.machine);
    for (record::PictureRecord const& picture : work.manifest.pictures)
        work.say("picture '{}': {}x{}, hash {:016x}", picture.name, picture.size.x, picture.size.y, picture.hash);
    for (Track const& track : work.tracks) {
        work.say("{}: {}, {}", track.name(), track.record->device, track.record->driver);
        for (size_t i = 0; i < track.trace.frames.size(); ++i) {
            if (!work.options.frame || *work.options.frame == i + 1) listFrame(work, track, i);
        }
    }
    for (std::string const& problem : problemsOf(work.manifest)) work.say("{}", problem);
}

// ---------------------------------------------------------------------------------------------- comparing

Result<void> explainDifference(Work& work, Track const& track) {
    if (!track.record->problem.empty()) work.say("        when it was saved: {}", track.record->problem);
    const Result<std::string> change = record::firstChangedPass(work.manifest, track.trace, track.request);
    if (!change) return change.error();
    if (change->empty())
        work.say("        every attachment is as it was when the frame was saved");
    else
        work.say("        first with other bits than when the frame was saved: {}", *change);
    return {};
}

Result<void> savePictures(Work& work, Track const& track, record::Verdict const& verdict) {
    if (work.options.out.empty()) return {};
    for (record::FramePicture const& picture : verdict.pictures) {
        if (picture.image.pixels.empty()) continue;
        const auto path = savePicture(work.options.out, fmt::format("{}-{}", track.name(), picture.name), picture);
        if (!path) return path.error();
        work.say("        {}", path->string());
    }
    return {};
}

Result<void> compareTrack(Work& work, Track const& track) {
    tools::showProgress(fmt::format("{}: replaying", track.name()));
    const Result<record::Verdict> verdict = record::compareReplay(work.manifest, track.trace, track.request);
    tools::clearProgress();
    if (!verdict) return verdict.error();
    const bool isEqual = verdict->difference.empty();
    work.say("{:7} {}, {}: {}", track.name(), verdict->device, verdict->driver,
             isEqual ? "every picture has the recorded bits" : verdict->difference);
    for (std::string const& error : verdict->errors) work.say("        {}", error);
    if (Result<void> saved = savePictures(work, track, *verdict); !saved) return saved;
    if (isEqual) return {};
    work.report.isEqual = false;
    return explainDifference(work, track);
}

/// An API without a device is no reason not to replay the other one.
Result<void> compareAll(Work& work) {
    std::vector<Track const*> drawn;
    std::string missing;
    for (Track const& track : work.tracks) {
        const Result<void> compared = compareTrack(work, track);
        if (compared) {
            drawn.push_back(&track);
            continue;
        }
        if (compared.error().code != ErrorCode::DeviceUnavailable) return compared;
        missing = compared.error().message;
        work.say("{:7} not replayed: {}", track.name(), missing);
    }
    if (drawn.empty()) return fail(ErrorCode::DeviceUnavailable, "no trace could be replayed: {}", missing);
    if (work.report.isEqual || drawn.size() < 2) return {};
    tools::showProgress("looking for the first draw after which the APIs disagree");
    const Result<std::string> found =
            record::firstDisagreement(drawn[0]->trace, drawn[0]->request, drawn[1]->trace, drawn[1]->request);
    tools::clearProgress();
    if (!found) return found.error();
    if (found->empty())
        work.say("{} and {} agree in every attachment: both draw other bits than were shown", drawn[0]->name(),
                 drawn[1]->name());
    else
        work.say("{} and {} first disagree in {}", drawn[0]->name(), drawn[1]->name(), *found);
    return {};
}

/// Without a device there is no image; the validator still judges every command.
Result<void> checkAll(Work& work) {
    for (Track const& track : work.tracks) {
        ReplayRequest request = track.request;
        request.backend = Backend::Null;
        const Result<record::Replayed> replayed = record::replayTrace(track.trace, request);
        if (!replayed) return replayed.error();
        work.say("null    {}.trace: {} streams, {} frames, {}; nothing is drawn without a device", track.name(),
                 track.trace.streams.size(), track.trace.frames.size(),
                 replayed->errors.empty() ? "every command obeys the rules" : "rules are broken");
        for (std::string const& error : replayed->errors) work.say("        {}", error);
        work.report.isEqual = work.report.isEqual && replayed->errors.empty();
    }
    return {};
}

// ---------------------------------------------------------------------------------------------- cutting off

/// A pass of one frame, and how many draws of the frame are run.
struct Place {
    uint32_t frame = 0, pass = 0, draws = 0;
};

Result<uint32_t> frameIndex(Work const& work, Track const& track) {
    const size_t count = track.trace.frames.size();
    if (count == 0) return fail(ErrorCode::NotFound, "{}.trace has no frame", track.name());
    const size_t number = work.options.frame.value_or(static_cast<uint32_t>(count));
    if (number > count)
        return fail(ErrorCode::NotFound, "--frame {}: {}.trace has {} frames", number, track.name(), count);
    return static_cast<uint32_t>(number - 1);
}

Result<uint32_t> passIndex(record::ListedFrame const& frame, std::string const& word) {
    const auto count = static_cast<uint32_t>(frame.passes.size());
    if (const auto number = tools::wholeNumber(word, 1, std::max(count, 1u)); number && count > 0) return *number - 1;
    const auto named = std::ranges::find(frame.passes, word, &record::ListedPass::name);
    if (named == frame.passes.end())
        return fail(ErrorCode::NotFound, "--stop-after-pass {}: the frame has {} passes, none of that name; see --list",
                    word, count);
    return static_cast<uint32_t>(named - frame.passes.begin());
}

Result<Place> afterPass(Work const& work, Track const& track) {
    const Result<uint32_t> index = frameIndex(work, track);
    if (!index) return index.error();
    record::ListedFrame const& frame = track.trace.frames[*index];
    const Result<uint32_t> pass = passIndex(frame, *work.options.stopAfterPass);
    if (!pass) return pass.error();
    return Place{ *index, *pass, frame.passes[*pass].firstDraw + frame.passes[*pass].drawCount };
}

Result<Place> afterDraw(Work const& work, Track const& track, uint32_t draw) {
    const Result<uint32_t> index = frameIndex(work, track);
    if (!index) return index.error();
    record::ListedFrame const& frame = track.trace.frames[*index];
    if (draw > frame.draws.size())
        return fail(ErrorCode::NotFound, "--stop-after-draw {}: the frame has {} draws", draw, frame.draws.size());
    uint32_t pass = 0;
    while (frame.passes[pass].firstDraw + frame.passes[pass].drawCount < draw) ++pass;
    return Place{ *index, pass, draw };
}

Result<backend::CapturedPass> passAt(Track const& track, Place const& place) {
    Result<backend::CapturedFrame> frame = record::frameOf(track.trace, track.request, place.frame)(place.draws);
    if (!frame) return frame.error();
    if (place.pass >= frame->passes.size())
        return fail(ErrorCode::Corrupt, "{}: pass {} was not replayed", track.name(), place.pass + 1);
    return std::move(frame->passes[place.pass]);
}

/// Of all attachments together.
uint64_t hashOf(backend::CapturedPass const& pass) {
    uint64_t hash = 0;
    for (backend::CapturedAttachment const& attachment : pass.attachments)
        hash = hashCombine(hash, hashBytes(attachment.bytes));
    return hash;
}

/// Null: the whole pass was not recorded.
record::PassRecord const* recordedPass(Track const& track, Place const& place) {
    for (record::FrameRecord const& frame : track.record->frames) {
        if (frame.index == place.frame && place.pass < frame.passes.size()) return &frame.passes[place.pass];
    }
    return nullptr;
}

bool hasRecordedBits(backend::CapturedPass const& pass, record::PassRecord const& recorded) {
    return std::ranges::equal(
            pass.attachments, recorded.attachments, {},
            [](backend::CapturedAttachment const& a) { return hashBytes(a.bytes); }, &record::AttachmentRecord::hash);
}

Result<void> showPass(Work& work, Track const& track, Place const& place, backend::CapturedPass const& pass,
                      std::filesystem::path const& folder) {
    record::ListedFrame const& frame = track.trace.frames[place.frame];
    const uint32_t last = frame.passes[place.pass].firstDraw + frame.passes[place.pass].drawCount;
    std::string verdict;
    if (record::PassRecord const* recorded = recordedPass(track, place); recorded && place.draws >= last) {
        const bool isEqual = hasRecordedBits(pass, *recorded);
        verdict = isEqual ? ", as recorded" : ", other bits than recorded";
        work.report.isEqual = work.report.isEqual && isEqual;
    }
    work.say("{:7} after draw {}{}, pass {} '{}': hash {:016x}{}", track.name(), place.draws,
             place.draws > 0 ? fmt::format(" '{}'", frame.draws[place.draws - 1].pipeline) : std::string(),
             place.pass + 1, pass.name, hashOf(pass), verdict);
    if (folder.empty()) return {};
    for (backend::CapturedAttachment const& attachment : pass.attachments) {
        const std::string stem = fmt::format("{}-draw{:04}-{}-{}{}", track.name(), place.draws, fileStem(pass.name),
                                             fileStem(attachment.name), attachment.isDepth ? "-depth" : "");
        const auto path = saveAttachment(folder, stem, attachment);
        if (!path) return path.error();
    }
    return {};
}

/// The same place on every API, and whether they agree there.
Result<void> stopAt(Work& work, std::vector<Place> const& places, std::filesystem::path const& folder) {
    std::optional<uint64_t> first;
    for (size_t i = 0; i < work.tracks.size(); ++i) {
        tools::showProgress(fmt::format("{}: replaying up to draw {}", work.tracks[i].name(), places[i].draws));
        const Result<backend::CapturedPass> pass = passAt(work.tracks[i], places[i]);
        tools::clearProgress();
        if (!pass) return pass.error();
        if (Result<void> shown = showPass(work, work.tracks[i], places[i], *pass, folder); !shown) return shown;
        const uint64_t hash = hashOf(*pass);
        if (first.value_or(hash) != hash) {
            work.say("        {} and {} disagree here", work.tracks[0].name(), work.tracks[i].name());
            work.report.isEqual = false;
        }
        first = first.value_or(hash);
    }
    return {};
}

Result<void> stopOnce(Work& work) {
    std::vector<Place> places;
    for (Track const& track : work.tracks) {
        const Result<Place> place = work.options.stopAfterPass ? afterPass(work, track)
                                                               : afterDraw(work, track, *work.options.stopAfterDraw);
        if (!place) return place.error();
        places.push_back(*place);
    }
    return stopAt(work, places, work.options.out);
}

/// The draws of one pass, or of the frame.
Result<std::pair<uint32_t, uint32_t>> drawsToStep(Work const& work) {
    Track const& track = work.tracks.front();
    const Result<uint32_t> index = frameIndex(work, track);
    if (!index) return index.error();
    record::ListedFrame const& frame = track.trace.frames[*index];
    if (!work.options.stopAfterPass) return std::pair(1u, static_cast<uint32_t>(frame.draws.size()));
    const Result<uint32_t> pass = passIndex(frame, *work.options.stopAfterPass);
    if (!pass) return pass.error();
    record::ListedPass const& chosen = frame.passes[*pass];
    return std::pair(chosen.firstDraw + 1, chosen.firstDraw + chosen.drawCount);
}

Result<void> stepAll(Work& work) {
    const auto range = drawsToStep(work);
    if (!range) return range.error();
    for (uint32_t draw = range->first; draw <= range->second; ++draw) {
        std::vector<Place> places;
        for (Track const& track : work.tracks) {
            const Result<Place> place = afterDraw(work, track, draw);
            if (!place) return place.error();
            places.push_back(*place);
        }
        if (Result<void> shown = stopAt(work, places, work.options.step); !shown) return shown;
    }
    return {};
}

Result<void> doWork(Work& work) {
    const bool isNull = !work.options.backends.empty() && work.options.backends.front() == Backend::Null;
    if (work.options.list) {
        listAll(work);
        return {};
    }
    if (isNull) return checkAll(work);
    if (!work.options.step.empty()) return stepAll(work);
    if (work.options.stopAfterPass || work.options.stopAfterDraw) return stopOnce(work);
    return compareAll(work);
}

} // namespace

Result<Report> replayFolder(Options const& options, Edits const& edits) {
    Result<Manifest> manifest = record::readManifest(options.folder);
    if (!manifest) return manifest.error();
    Work work{ .options = options, .manifest = std::move(*manifest) };
    if (Result<void> loaded = loadTracks(work, edits); !loaded) return loaded.error();
    if (Result<void> done = doWork(work); !done) return done.error();
    return std::move(work.report);
}

} // namespace filament_core::replay
