// SPDX-License-Identifier: Apache-2.0
// filament-reference [MODEL] [options]: the picture that filament-render approximates, from the same command line.
// Exit status 0: rendered and written. 130: written with fewer samples, after Ctrl-C.
#include "tools/common/Console.h"
#include "tools/common/Program.h"
#include "tools/common/SceneFiles.h"
#include "tools/reference/LoadScene.h"
#include "tools/reference/Output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace filament::reference {
namespace {

using tools::failed;
using tools::showProgress;

std::string progressLine(RenderProgress const& progress, float wantedError) {
    constexpr size_t kWidth = 24;
    double done = double(progress.samplesDone) / progress.samplesTotal;
    if (wantedError > 0 && progress.relativeError > 0) {
        const double ratio = double(wantedError) / progress.relativeError; // error ~ 1 / sqrt(samples)
        done = std::max(done, std::min(ratio * ratio, 1.0));
    }
    const auto filled = static_cast<size_t>(done * kWidth);
    const double left = progress.seconds * (1 - done) / std::max(done, 1e-6);
    return fmt::format("[{}{}] {:3.0f} %  {}/{} samples  error {:.2f} %  {:.0f} s left", std::string(filled, '#'),
                       std::string(kWidth - filled, '.'), done * 100, progress.samplesDone, progress.samplesTotal,
                       progress.relativeError * 100, left);
}

int run(Options const& options) {
    if (const Result<void> made = tools::makeOutFolder(options); !made) return failed(made.error());
    jobs::JobSystem jobs({ .workers = options.workers });
    std::vector<std::string> notes;
    const Result<ReferenceScene> scene = loadScene(options, jobs, notes);
    if (!scene) return failed(scene.error());
    showProgress("building the ray tracer's tree");
    const Result<TracedScenePtr> traced = prepare(*scene, jobs);
    if (!traced) return failed(traced.error());
    notes.insert(notes.end(), warnings(**traced).begin(), warnings(**traced).end());

    const ReferenceView view{ .camera = tools::cameraOf(options), .size = options.size, .fog = options.effects.fog };
    const tools::StopOnInterrupt scope;
    const Result<ReferenceImage> image =
            render(**traced, view, options.settings, jobs, [&](RenderProgress const& progress) {
                showProgress(progressLine(progress, options.settings.relativeError));
                return !tools::isInterrupted();
            });
    tools::clearProgress();
    if (!image) return failed(image.error());
    for (std::string const& note : notes) tools::printWarning(note);
    for (auto write : { writePictures(options, *image), writeReport(options, *image, notes) }) {
        if (!write) return failed(write.error());
    }
    RenderStatistics const& statistics = image->statistics;
    std::printf("%s: %u samples a pixel, standard error %.2f %%, %.1f Mrays in %.1f s\n",
                (options.out / "reference.exr").c_str(), statistics.samplesPerPixel, statistics.relativeError * 100,
                static_cast<double>(statistics.rays) * 1e-6, statistics.seconds);
    if (!tools::isInterrupted()) return 0;
    tools::printWarning(fmt::format("interrupted: the picture has {} of {} samples a pixel", statistics.samplesPerPixel,
                                    options.settings.samplesPerPixel));
    return tools::kInterruptedStatus;
}

} // namespace
} // namespace filament::reference

int main(int argc, char** argv) {
    using namespace filament;
    return tools::runProgram("filament-reference", argc, argv, reference::parseOptions, reference::run,
                             "try a smaller model or size");
}
