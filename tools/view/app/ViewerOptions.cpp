// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/ViewerOptions.h"

#include "toolkit/program/CommandLine.h"
#include "tools/view/panels/Panels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace filament_core::view {
namespace {

using tools::invalidOption;

struct Words {
    std::string backend = "vulkan", presentMode = "fifo", frames = "0", workers, screenshot, document, panels = "on",
                compare = "off";
    std::string cameraPath, framesTo, frameFormat = "png", framesPerSecond = "30", video;
};

void declare(tools::CommandLine& app, Words& words, ViewerOptions& options) {
    app.option("--backend", words.backend, "vulkan (default) or gles; B changes it while it runs")
            .shownDefault("vulkan");
    app.option("--present", words.presentMode, "fifo (default: vsync), mailbox or immediate").shownDefault("fifo");
    app.option("--frames", words.frames, "end after so many frames of the loaded scene (0: when it is closed)");
    app.option("--screenshot", words.screenshot, "FILE.png: save the last frame, with the panels");
    app.option("--document", words.document, "FILE.json: what a viewer saved, in the place of the other options");
    app.option("--camera-path", words.cameraPath, "FILE.json: a camera path, as the viewer saves it");
    app.option("--frames-to", words.framesTo,
               "FOLDER: draw the camera path to numbered pictures, without a window, and end");
    app.option("--frame-format", words.frameFormat, "of those: png (default), or exr: light before the tone mapper")
            .shownDefault("png");
    app.option("--video", words.video, "FILE.mp4, .mov, .mkv, .webm: make a video of them, by the ffmpeg command");
    app.option("--fps", words.framesPerSecond, "frames a second of the camera path").shownDefault("30");
    app.option("--panels", words.panels, "on (default) or off; Tab changes it while it runs").shownDefault("on");
    app.option("--panel", options.openPanels, "NAME, as on its tab: open it at the start; repeatable");
    app.option("--compare", words.compare,
               "off (default), wipe, difference or flip: with the other API; C changes it while it runs")
            .shownDefault("off");
    app.option("--select", options.select, "NODE: select this node of the model, once it is loaded");
    app.option("--workers", words.workers, "job threads besides the app thread (one per remaining core)");
    app.flag("--validation", options.validation, "check every command, and enable the validation layers");
}

Result<void> convertChoices(Words const& words, ViewerOptions& options) {
    if (words.backend == "gles")
        options.backend = Backend::Gles;
    else if (words.backend != "vulkan")
        return invalidOption("--backend", words.backend, "vulkan or gles");
    if (words.presentMode == "mailbox")
        options.presentMode = PresentMode::Mailbox;
    else if (words.presentMode == "immediate")
        options.presentMode = PresentMode::Immediate;
    else if (words.presentMode != "fifo")
        return invalidOption("--present", words.presentMode, "fifo, mailbox or immediate");
    constexpr std::array<std::pair<std::string_view, CompareMode>, 4> kModes{ { { "off", CompareMode::Off },
                                                                                { "wipe", CompareMode::Wipe },
                                                                                { "difference",
                                                                                  CompareMode::Difference },
                                                                                { "flip", CompareMode::Flip } } };
    const auto mode = std::ranges::find(kModes, words.compare, &std::pair<std::string_view, CompareMode>::first);
    if (mode == kModes.end()) return invalidOption("--compare", words.compare, "off, wipe, difference or flip");
    options.compare = mode->second;
    for (std::string const& name : options.openPanels)
        if (const std::vector<std::string_view> known = panelNames(); std::ranges::find(known, name) == known.end())
            return invalidOption("--panel", name, fmt::format("one of {}", fmt::join(known, ", ")).c_str());
    return tools::convertSwitch("--panels", words.panels, options.panels);
}

Result<void> convertCounts(Words const& words, ViewerOptions& options) {
    const auto frames = tools::wholeNumber(words.frames, 0, 1'000'000);
    if (!frames) return invalidOption("--frames", words.frames, "a whole number from 0 to 1000000");
    options.frames = *frames;
    if (words.workers.empty()) return {};
    const auto workers = tools::wholeNumber(words.workers, 0, 256);
    if (!workers) return invalidOption("--workers", words.workers, "a whole number from 0 to 256");
    options.workers = static_cast<int>(*workers);
    return {};
}

Result<void> convertFiles(Words const& words, ViewerOptions& options) {
    options.screenshot = words.screenshot;
    options.document = words.document;
    if (!words.screenshot.empty() && options.screenshot.extension() != ".png")
        return invalidOption("--screenshot", words.screenshot, "a file that ends with .png");
    if (!words.screenshot.empty() && options.frames == 0)
        return invalidOption("--screenshot", words.screenshot, "it together with --frames, which says when");
    return {};
}

Result<void> convertPath(Words const& words, ViewerOptions& options) {
    options.cameraPath = words.cameraPath;
    options.series.folder = words.framesTo;
    options.series.video = words.video;
    const auto rate = tools::finiteNumber(words.framesPerSecond);
    if (!rate || *rate < kLeastFrameRate || *rate > kMostFrameRate)
        return invalidOption("--fps", words.framesPerSecond, "a number from 0.01 to 1000");
    options.series.framesPerSecond = *rate;
    if (words.frameFormat == "exr")
        options.series.format = PictureFormat::Exr;
    else if (words.frameFormat != "png")
        return invalidOption("--frame-format", words.frameFormat, "png or exr");
    if (!options.drawsPath()) return {};
    const char* const option = words.framesTo.empty() ? "--video" : "--frames-to";
    const std::string& word = words.framesTo.empty() ? words.video : words.framesTo;
    if (words.cameraPath.empty())
        return invalidOption(option, word, "it together with --camera-path, along which frames are drawn");
    if (options.frames > 0) return invalidOption(option, word, "it without --frames: the path says how many");
    return {};
}

} // namespace

Result<std::optional<ViewerOptions>> parseViewerOptions(int argc, const char* const* argv) {
    ViewerOptions options;
    tools::SceneWords sceneWords;
    Words words;
    tools::CommandLine app{ "Shows a glTF model or a material in a window, on Vulkan or OpenGL ES. F1 lists the keys.",
                            "filament-view" };
    tools::declareSceneOptions(app, sceneWords, options);
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<ViewerOptions>{};
    if (const Result<void> done = tools::convertSceneOptions(sceneWords, options); !done) return done.error();
    for (auto convert : { convertChoices, convertCounts, convertFiles, convertPath }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::view
