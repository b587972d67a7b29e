// SPDX-License-Identifier: Apache-2.0
// filament-reference [MODEL] [options]: the picture that filament-render approximates, from the same command line.
// Exit status 0: rendered and written. 130: written with fewer samples, after Ctrl-C; a part is then not written.
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Program.h"
#include "toolkit/program/SceneFiles.h"
#include "tools/reference/LoadScene.h"
#include "tools/reference/Merge.h"
#include "tools/reference/Output.h"
#include "tools/reference/ProbeCube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace filament_core::reference {
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

/// What is rendered, ready to be traced.
struct Job {
    TracedScenePtr scene;
    uint64_t contents = 0;
    std::vector<std::string> notes;
};

Result<Job> prepareJob(Options const& options, jobs::JobSystem& jobs) {
    if (const Result<void> made = tools::makeOutFolder(options); !made) return made.error();
    Job job;
    const Result<ReferenceScene> scene = loadScene(options, jobs, job.notes);
    if (!scene) return scene.error();
    job.contents = contentsOf(options, *scene);
    showProgress("building the ray tracer's tree");
    Result<TracedScenePtr> traced = prepare(*scene, jobs);
    if (!traced) return traced.error();
    job.scene = std::move(*traced);
    job.notes.insert(job.notes.end(), warnings(*job.scene).begin(), warnings(*job.scene).end());
    return job;
}

ReferenceView viewOf(Options const& options) {
    return { .camera = tools::cameraOf(options),
             .size = options.view.size,
             .fog = options.view.effects.fog,
             .timeSeconds = options.view.timeSeconds };
}

Progress progressOf(Options const& options) {
    return [&options](RenderProgress const& progress) {
        showProgress(progressLine(progress, options.settings.relativeError));
        return !tools::isInterrupted();
    };
}

/// Ends a run whose picture is complete. Returns the exit status.
int writePicture(Options const& options, ReferenceImage const& image, std::vector<std::string> const& notes) {
    for (std::string const& note : notes) tools::printWarning(note);
    if (auto written = writePictures(options, image); !written) return failed(written.error());
    if (auto written = writeReport(options, image, notes); !written) return failed(written.error());
    RenderStatistics const& statistics = image.statistics;
    std::printf("%s: %u samples a pixel, standard error %.2f %%, %.1f Mrays in %.1f s\n",
                (options.out / "reference.exr").c_str(), statistics.samplesPerPixel, statistics.relativeError * 100,
                static_cast<double>(statistics.rays) * 1e-6, statistics.seconds);
    return 0;
}

int renderPicture(Options const& options, Job const& job, jobs::JobSystem& jobs) {
    const Result<ReferenceImage> image =
            render(*job.scene, viewOf(options), options.settings, jobs, progressOf(options));
    tools::clearProgress();
    if (!image) return failed(image.error());
    const int status = writePicture(options, *image, job.notes);
    if (status != 0 || !tools::isInterrupted()) return status;
    tools::printWarning(fmt::format("interrupted: the picture has {} of {} samples a pixel",
                                    image->statistics.samplesPerPixel, options.settings.samplesPerPixel));
    return tools::kInterruptedStatus;
}

int renderProbe(Options const& options, Job const& job, jobs::JobSystem& jobs) {
    const auto file =
            traceProbe(*job.scene, viewOf(options), options.probeSize, options.settings, jobs, progressOf(options));
    tools::clearProgress();
    if (!file) return failed(file.error());
    for (std::string const& note : job.notes) tools::printWarning(note);
    const std::filesystem::path path = options.out / "probe.ktx2";
    if (auto written = assets::replaceFile(path, *file); !written) return failed(written.error());
    std::printf("%s: %u texels a side; intensity %.6g\n", path.c_str(), options.probeSize,
                1 / double{ viewOf(options).camera.exposure.factor() });
    return tools::isInterrupted() ? tools::kInterruptedStatus : 0;
}

int renderOnePart(Options const& options, Job const& job, jobs::JobSystem& jobs) {
    const Result<PartialFilm> part =
            renderPart(*job.scene, viewOf(options), options.settings, *options.part, jobs, progressOf(options));
    tools::clearProgress();
    if (!part) return failed(part.error());
    if (tools::isInterrupted()) {
        tools::printWarning("interrupted: the part was not written");
        return tools::kInterruptedStatus;
    }
    const PictureSettings settings{ tools::builtCommit(), options.arguments,        job.contents,
                                    options.view.size,    planOf(options.settings), job.notes };
    const std::filesystem::path file = options.out / kPartName;
    if (auto written = writePart(file, settings, *part, options.shard); !written) return failed(written.error());
    std::printf("%s: %s, %.1f Mrays in %.1f s\n", file.c_str(), toString(part->region).c_str(),
                static_cast<double>(part->rays) * 1e-6, part->seconds);
    return 0;
}

/// The options with which `settings` were rendered.
Result<Options> optionsOf(PictureSettings const& settings) {
    std::vector<const char*> words{ "filament-reference" };
    for (std::string const& word : settings.arguments) words.push_back(word.c_str());
    Result<std::optional<Options>> parsed = parseOptions(static_cast<int>(words.size()), words.data());
    if (!parsed) return parsed.error();
    const bool isPicture =
            *parsed && !(*parsed)->part && (*parsed)->merge.empty() && (*parsed)->view.size == settings.size;
    if (isPicture) return std::move(**parsed);
    return fail(ErrorCode::Corrupt, "the settings of the parts contradict each other; render all parts again");
}

int mergePicture(Options const& options) {
    if (const Result<void> made = tools::makeOutFolder(options); !made) return failed(made.error());
    const Result<MergedPicture> merged = mergeParts(options.merge);
    if (!merged) return failed(merged.error());
    Result<Options> whole = optionsOf(merged->settings);
    if (!whole) return failed(whole.error());
    whole->out = options.out;
    return writePicture(*whole, merged->image, merged->settings.warnings);
}

int run(Options const& options) {
    if (!options.merge.empty()) return mergePicture(options);
    jobs::JobSystem jobs({ .workers = options.workers });
    const Result<Job> job = prepareJob(options, jobs);
    if (!job) return failed(job.error());
    const tools::StopOnInterrupt scope;
    if (options.probeSize > 0) return renderProbe(options, *job, jobs);
    return options.part ? renderOnePart(options, *job, jobs) : renderPicture(options, *job, jobs);
}

} // namespace
} // namespace filament_core::reference

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-reference", argc, argv, reference::parseOptions, reference::run,
                             "try a smaller model or size");
}
