// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/PathFrames.h"

#include "tools/view/app/VideoFile.h"
#include "tools/view/camera/PathSampling.h"
#include "tools/view/document/TextForms.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

#include <unistd.h>

#include <deque>
#include <future>

namespace filament_core::view {
namespace {

constexpr size_t kEncoders = 2; // images at a time

Result<void> makeFolder(std::filesystem::path const& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && std::filesystem::is_directory(folder, error)) return {};
    return fail(ErrorCode::Unreadable, "cannot make the folder '{}': {}; choose another one", folder.string(),
                error ? error.message() : "a file has its name");
}

/// Where frames lie while a video alone is asked for: beside it, removed at the end.
class FrameFolder {
public:
    explicit FrameFolder(FrameSeries const& series) : mPath(series.folder), mIsOwn(series.folder.empty()) {
        if (mIsOwn)
            mPath = series.video.parent_path() / fmt::format(".{}.{}.frames", series.video.stem().string(), getpid());
    }
    FrameFolder(FrameFolder const&) = delete;
    FrameFolder& operator=(FrameFolder const&) = delete;
    ~FrameFolder() {
        std::error_code ignored;
        if (mIsOwn) std::filesystem::remove_all(mPath, ignored);
    }
    std::filesystem::path const& path() const { return mPath; }

private:
    std::filesystem::path mPath;
    bool mIsOwn;
};

/// Encodes images on other threads, a few at a time.
class Encoders {
public:
    Result<void> add(std::filesystem::path file, Image image, OutputSpace space) {
        if (mRunning.size() == kEncoders)
            if (Result<void> saved = takeFirst(); !saved) return saved;
        mRunning.push_back(std::async(std::launch::async,
                                      [=, image = std::move(image)] { return savePicture(file, image, space); }));
        return {};
    }
    Result<void> finish() {
        while (!mRunning.empty())
            if (Result<void> saved = takeFirst(); !saved) return saved;
        return {};
    }

private:
    Result<void> takeFirst() {
        Result<void> saved = mRunning.front().get();
        mRunning.pop_front();
        return saved;
    }
    std::deque<std::future<Result<void>>> mRunning;
};

Document documentAt(PathRequest const& request, Stage const& stage, double seconds) {
    Document document = request.document;
    document.view.camera = sampled(request.path, seconds);
    document.view.timeSeconds += seconds;
    Model const* const model = stage.model();
    std::optional<uint32_t> const& animation = document.playback.animation;
    if (model && animation && *animation < model->animationCount())
        document.playback = advanced(document.playback, seconds, model->animationSeconds(*animation));
    return document;
}

/// The first thing that was said of a file that is not there.
Result<void> checkLoaded(Document const& document, Stage const& stage, std::vector<std::string> const& messages) {
    if (stage.loadError()) return *stage.loadError();
    const bool isThere = document.model.file.empty() || stage.shownFile() == document.model.file;
    if (isThere) return {};
    return fail(ErrorCode::NotFound, "{}", messages.empty() ? "the model could not be loaded" : messages.front());
}

Result<void> drawFrames(PathRequest const& request, std::filesystem::path const& folder, Stage& stage,
                        PathProgress& progress) {
    const std::vector<double> times = frameTimes(request.path, request.series.framesPerSecond);
    progress.total = static_cast<uint32_t>(times.size());
    const Format format = imageFormatOf(request.series.format);
    const Owned<SwapChain> chain = stage.engine().own(stage.engine().create(
            SwapChainDesc{ .size = request.document.view.size, .format = format, .name = "path" }));
    Encoders encoders;
    for (uint32_t frame = 0; frame < times.size(); ++frame) {
        if (progress.isCancelled)
            return fail(ErrorCode::Cancelled, "stopped after {} of {} frames", frame, times.size());
        stage.apply(documentAt(request, stage, times[frame]));
        stage.render(chain);
        Result<Image> image = stage.renderer().waitPixels(stage.renderer().readPixels(chain));
        if (!image) return image.error();
        Result<void> added = encoders.add(folder / frameName(frame, request.series.format), std::move(*image),
                                          request.document.view.display.outputSpace);
        if (!added) return added;
        ++progress.done;
    }
    return encoders.finish();
}

std::vector<std::string> record(PathRequest const& request, PathProgress& progress) {
    FrameSeries const& series = request.series;
    Result<PathResult> drawn = drawPath(request, progress);
    if (!drawn) return { fmt::format("camera path: {}", drawn.error().message) };
    std::vector<std::string> lines = std::move(drawn->messages);
    lines.insert(lines.begin(), fmt::format("recorded {} frames to {}", drawn->frames,
                                            (series.video.empty() ? series.folder : series.video).string()));
    return lines;
}

} // namespace

std::string frameName(uint32_t frame, PictureFormat format) {
    return fmt::format("frame-{:05}{}", frame, endingOf(format));
}

Result<void> check(PathRequest const& request) {
    FrameSeries const& series = request.series;
    if (Result<void> valid = check(request.path); !valid) return valid;
    if (request.path.keys.empty())
        return fail(ErrorCode::InvalidArgument, "the camera path '{}' has no keys", request.path.name);
    const bool hasRate = series.framesPerSecond >= kLeastFrameRate && series.framesPerSecond <= kMostFrameRate;
    if (!hasRate)
        return fail(ErrorCode::InvalidArgument, "{} frames a second; give {} to {}", series.framesPerSecond,
                    kLeastFrameRate, kMostFrameRate);
    const double frames = durationOf(request.path) * series.framesPerSecond + 1;
    if (frames > kMostFrames)
        return fail(ErrorCode::InvalidArgument,
                    "the camera path takes {:.6g} s: {:.0f} frames, and at most {} are recorded; give fewer a second",
                    durationOf(request.path), frames, kMostFrames);
    if (series.folder.empty() && series.video.empty())
        return fail(ErrorCode::InvalidArgument, "frames are recorded to a folder, to a video or to both");
    if (series.video.empty()) return {};
    if (series.format != PictureFormat::Png)
        return fail(ErrorCode::InvalidArgument, "a video is made of PNG frames, not of EXR");
    return checkVideo(series.video);
}

Result<PathResult> drawPath(PathRequest const& request, PathProgress& progress) {
    if (Result<void> good = check(request); !good) return good.error();
    const FrameFolder folder(request.series);
    if (Result<void> made = makeFolder(folder.path()); !made) return made.error();
    const std::filesystem::path ofVideo = request.series.video.parent_path();
    if (Result<void> made = ofVideo.empty() ? Result<void>() : makeFolder(ofVideo); !made) return made.error();
    PathResult result;
    {
        auto stage = Stage::create({ .engine = request.engine, .watchesFiles = false });
        if (!stage) return stage.error();
        (*stage)->apply(request.document);
        (*stage)->finishLoading([&] { return progress.isCancelled.load(); });
        if (progress.isCancelled) return fail(ErrorCode::Cancelled, "stopped while the files were being loaded");
        result.messages = (*stage)->takeMessages();
        if (Result<void> loaded = checkLoaded(request.document, **stage, result.messages); !loaded)
            return loaded.error();
        if (Result<void> drawn = drawFrames(request, folder.path(), **stage, progress); !drawn) return drawn.error();
        for (std::string& message : (*stage)->takeMessages()) result.messages.push_back(std::move(message));
    }
    result.frames = progress.total;
    if (request.series.video.empty()) return result;
    const VideoRequest video{ .file = request.series.video,
                              .pattern = folder.path() / "frame-%05d.png",
                              .frames = result.frames,
                              .framesPerSecond = request.series.framesPerSecond };
    const Result<void> made = makeVideo(video, [&] { return progress.isCancelled.load(); });
    if (!made) return made.error();
    return result;
}

PathRecorder::~PathRecorder() {
    cancel(); // the end of mLines waits
}

bool PathRecorder::start(PathRequest request) {
    if (isBusy()) return false;
    mProgress.done = mProgress.total = 0;
    mProgress.isCancelled = false;
    mLines.emplace([this, request = std::move(request)] { return record(request, mProgress); });
    return true;
}

} // namespace filament_core::view
