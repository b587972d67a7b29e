// SPDX-License-Identifier: Apache-2.0
// filament-render [MODEL] [options]: draws the picture of one command line on one or two backends and compares the two.
// Exit status 0: everything was drawn and, with two backends, all pixels are equal (within --tolerance). With
// --check-asset: no material breaks a rule.
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/machine/DriverPromise.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Program.h"
#include "toolkit/program/SceneFiles.h"
#include "tools/filament-render/AovFiles.h"
#include "tools/filament-render/BackendRun.h"
#include "tools/filament-render/CheckAsset.h"
#include "tools/filament-render/Options.h"
#include "tools/filament-render/Report.h"
#include "tools/filament-render/SaveFrame.h"
#include "tools/filament-render/SceneFileRun.h"
#include "tools/filament-render/ShareFiles.h"

#include <filament_core/Look.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <span>

namespace filament_core::tools {
namespace {

constexpr uint32_t kSavedLookSize = 33; // a side: that of most programs

int listAllDevices() {
    const std::vector<DeviceDescription> devices = listDevices();
    for (DeviceDescription const& device : devices) {
        std::printf("%-7s %s, %s, %u pixels a side, MSAA %ux\n", fileStem(device.backend), device.device.c_str(),
                    device.driver.c_str(), device.maxTextureSize, device.maxSamples);
    }
    if (!devices.empty()) return 0;
    return failed(fail(ErrorCode::DeviceUnavailable,
                       "no device of any backend; install mesa-vulkan-drivers, or libegl-mesa0 and libgl1-mesa-dri"));
}

std::filesystem::path picturePath(Options const& options, Backend backend) {
    return options.out / fmt::format("{}.{}", fileStem(backend), options.format == PictureFormat::Exr ? "exr" : "png");
}

/// Draws and saves. Errors go to `errors`, once each, however many backends report them.
std::vector<BackendRun> drawAll(Options const& options, showcase::Files const& files,
                                std::vector<std::string>& errors) {
    const auto note = [&](std::string const& message) {
        if (std::find(errors.begin(), errors.end(), message) == errors.end()) errors.push_back(message);
    };
    std::vector<BackendRun> runs;
    Options wanted = options;
    for (const Backend backend : options.backends) {
        Result<BackendRun> run = isSceneFile(options.model)
                                         ? runSceneFile(options, backend)
                                         : runBackend(wanted, backend, files.model, files.environment);
        clearProgress();
        if (!run) {
            note(run.error().message);
            continue;
        }
        for (std::string const& warning : run->warnings) printWarning(warning);
        for (std::string const& error : run->errors) note(fmt::format("{}: {}", fileStem(backend), error));
        const std::filesystem::path path = picturePath(options, backend);
        const Result<void> saved = options.format == PictureFormat::Exr
                                           ? saveExr(path, run->image)
                                           : savePng(path, run->image, options.view.display.outputSpace);
        const Result<void> savedAovs = saveAovs(options, *run);
        if (!savedAovs) note(savedAovs.error().message);
        if (const Result<void> savedShares = saveShares(options, *run); !savedShares) note(savedShares.error().message);
        if (!saved)
            note(saved.error().message);
        else
            std::printf("%-7s %s: %s\n", fileStem(backend), run->device.device.c_str(), path.string().c_str());
        if (run->decision) { // both APIs must draw with the same settings to be comparable
            wanted.view.quality = run->decision->quality;
            wanted.budgetMilliseconds.reset();
            std::fputs(run->decision->explanation.c_str(), stdout);
        }
        runs.push_back(std::move(*run));
    }
    return runs;
}

Result<ImageComparison> compareRuns(Options const& options, BackendRun const& a, BackendRun const& b) {
    Result<ImageComparison> comparison = compareImages(a.image, b.image);
    if (!comparison) return comparison;
    std::printf("%s\n", comparison->line().c_str());
    const Result<void> saved = savePng(options.out / "diff.png", differenceImage(a.image, b.image));
    if (!saved) return saved.error();
    return comparison;
}

/// Combines the tables of the measured backends.
Result<void> writeCosts(Options const& options, std::vector<BackendRun> const& runs) {
    std::optional<QualityCosts> costs;
    for (BackendRun const& run : runs) {
        if (!run.costs) continue;
        if (costs)
            addBackend(*costs, *run.costs, run.backend);
        else
            costs = run.costs;
    }
    if (!costs) return {};
    costs->machine = describeMachine();
    costs->commit = builtCommit();
    const std::string text = toJson(*costs);
    return assets::replaceFile(options.measureCosts, std::as_bytes(std::span(text)));
}

int render(Options const& options) {
    if (const Result<void> made = makeOutFolder(options); !made) return failed(made.error());
    const Result<showcase::Files> files =
            isSceneFile(options.model) ? showcase::Files{ options.model, {} } : chooseFiles(options);
    if (!files) return failed(files.error());

    if (!options.saveLook.empty()) {
        const Look look = bakeLook(options.view.display, options.view.effects.colorGrading, kSavedLookSize);
        if (const Result<void> saved = saveLook(options.saveLook, look); !saved) return failed(saved.error());
    }
    std::vector<std::string> errors;
    const std::vector<BackendRun> runs = drawAll(options, *files, errors);
    if (!runs.empty())
        std::fputs(explain(runs.front().lights, { .illuminance = options.iblIntensity }).c_str(), stdout);
    std::optional<ImageComparison> comparison;
    bool hasSameAovs = true;
    if (runs.size() == 2) {
        const DeviceDescription devices[] = { runs[0].device, runs[1].device };
        if (const std::string note = driverNote(devices, cpuFeatures()); !note.empty()) printWarning(note);
        const Result<ImageComparison> compared = compareRuns(options, runs[0], runs[1]);
        if (compared)
            comparison = *compared;
        else
            errors.push_back(compared.error().message);
        const AovComparison aovs = compareAovs(options, runs[0], runs[1]);
        if (!aovs.line.empty()) std::printf("%s\n", aovs.line.c_str());
        hasSameAovs = aovs.same && hasSameShares(runs[0], runs[1]);
        if (!hasSameShares(runs[0], runs[1])) std::printf("shares differ between the APIs\n");
    }
    if (!runs.empty() && runs.front().explained) std::fputs(textOf(*runs.front().explained).c_str(), stdout);
    for (BackendRun const& run : runs) {
        if (options.explain) std::printf("%s\n%s\n", fileStem(run.backend), run.explanation.c_str());
        if (options.timing) std::fputs(timingText(run).c_str(), stdout);
    }
    const Result<void> reported =
            runs.empty() ? Result<void>{}
                         : writeReport(options.out / "report.json",
                                       { options, files->model, files->environment, runs, comparison, errors });
    if (!reported) errors.push_back(reported.error().message);
    if (const Result<void> written = writeCosts(options, runs); !written) errors.push_back(written.error().message);
    if (const Result<void> saved = saveRunAsFrame(options, *files, runs); !saved)
        errors.push_back(saved.error().message);

    if (!errors.empty()) return failed(fail(ErrorCode::Internal, "{}", fmt::join(errors, "; ")));
    return (comparison && !comparison->within(options.tolerance)) || !hasSameAovs ? 1 : 0;
}

int check(Options const& options) {
    const Result<AssetFindings> findings =
            checkAsset(options.model, options.modelOptions.filesFromAnywhere ? assets::FilesFrom::Anywhere
                                                                             : assets::FilesFrom::Folder);
    if (!findings) return failed(findings.error());
    for (std::string const& warning : findings->warnings) printWarning(warning);
    std::fputs(textOf(*findings).c_str(), stdout);
    return findings->isPlausible() ? 0 : 1;
}

int run(Options const& options) {
    if (options.listDevices) return listAllDevices();
    return options.checkAsset ? check(options) : render(options);
}

} // namespace
} // namespace filament_core::tools

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-render", argc, argv, tools::parseOptions, tools::run,
                             "try a smaller model or size");
}
