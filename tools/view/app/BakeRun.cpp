// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/BakeRun.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr auto kBakeLookInterval = std::chrono::milliseconds(250);
constexpr size_t kLongestBakeLog = size_t{ 1 } << 24;
constexpr uint32_t kMostProbes = 65536;
constexpr const char* kGridName = "grid";

/// The sun that filament-bake is told.
SunLight const* sunOf(Document const& document) {
    for (DocumentLight const& light : document.lights) {
        if (SunLight const* sun = std::get_if<SunLight>(&light.light); sun && light.isOn) return sun;
    }
    return nullptr;
}

std::string wordOf(float value) { return fmt::format("{}", value); }

Result<void> addEnvironment(BakeRequest const& request, std::vector<std::string>& words) {
    DocumentEnvironment const& environment = request.document.environment;
    if (!request.usesModelEnvironment) {
        if (environment.file.extension() == ".fenv")
            return fail(ErrorCode::InvalidArgument, "{}: a package cannot be traced; take the panorama that it is of",
                        environment.file.string());
        words.insert(words.end(), { "--environment", environment.file.empty() ? "none" : environment.file.string() });
    }
    const double degrees = std::remainder(glm::degrees(double{ environment.settings.rotationRadians }), 360.0);
    words.insert(words.end(), { "--ibl-intensity", wordOf(environment.settings.illuminance.value), "--ibl-rotation",
                                wordOf(static_cast<float>(degrees)) });
    return {};
}

std::string gridText(BakeRequest const& request) {
    const double3 middle = request.box.center(), half = (request.box.max - request.box.min) * 0.5;
    return fmt::format(R"({{"name": "{}", "at": [{}, {}, {}], "halfExtent": [{}, {}, {}], "spacing": {}, )"
                       R"("maxProbes": {}, "maxError": {}, "paths": {}}})",
                       kGridName, middle.x, middle.y, middle.z, half.x, half.y, half.z, request.settings.spacingMeters,
                       kMostProbes, request.settings.error, request.settings.paths);
}

std::string reasonIn(std::string_view log) {
    while (!log.empty() && (log.back() == '\n' || log.back() == '\r')) log.remove_suffix(1);
    return std::string(log.substr(log.find_last_of("\r\n") + 1).substr(0, 300));
}

} // namespace

Result<BakeCommand> bakeCommand(BakeRequest const& request) {
    Document const& document = request.document;
    std::string const ending = document.model.file.extension().string();
    if (ending != ".gltf" && ending != ".glb")
        return fail(ErrorCode::InvalidArgument, "'{}' cannot be baked: only .gltf and .glb models can",
                    document.model.file.string());
    const bool isGrid = request.settings.kind == BakeKind::Grid;
    if (isGrid && document.model.fit)
        return fail(ErrorCode::InvalidArgument,
                    "a grid lies in the metres of the file: switch 'fit' off in the panel Scene first");
    BakeCommand command;
    std::vector<std::string>& words = command.words;
    // nice: the window and the driver come first
    words = { "nice", "-n", "10", request.program.string(), document.model.file.string() };
    if (const Result<void> added = addEnvironment(request, words); !added) return added.error();
    Exposure const& exposure = document.view.camera.exposure;
    words.insert(words.end(),
                 { "--exposure", wordOf(exposure.aperture), wordOf(exposure.shutterSeconds), wordOf(exposure.iso) });
    if (SunLight const* sun = sunOf(document))
        words.insert(words.end(), { "--sun", wordOf(sun->illuminance.value), wordOf(sun->directionWorld.x),
                                    wordOf(sun->directionWorld.y), wordOf(sun->directionWorld.z) });
    if (isGrid)
        command.grid = gridText(request);
    else
        words.insert(words.end(), { "--density", wordOf(request.settings.texelsPerMeter), "--samples",
                                    fmt::format("{}", request.settings.paths) });
    uint64_t hash = hashString(command.grid);
    for (std::string const& word : words) hash = hashBytes(std::as_bytes(std::span(word)), hash);
    command.folder = request.out / fmt::format("bake-{:016x}", hash);
    command.file = command.folder / (isGrid ? std::string(kGridName) + ".grid" : std::string("baked.glb"));
    if (isGrid) words.insert(words.end(), { "--grid", (command.folder / "grid.json").string() });
    words.insert(words.end(), { "--out", command.folder.string() });
    return command;
}

BakeProgress progressIn(std::string_view log) {
    const size_t percent = log.rfind(" %  ");
    if (percent == std::string_view::npos) return {};
    size_t begin = percent;
    while (begin > 0 && log[begin - 1] >= '0' && log[begin - 1] <= '9') --begin;
    uint32_t value = 0;
    const auto read = std::from_chars(log.data() + begin, log.data() + percent, value);
    if (read.ec != std::errc() || value > 100) return {};
    const std::string_view line = log.substr(begin);
    return { .isRunning = true,
             .share = value / 100.0,
             .line = std::string(line.substr(0, std::min(line.find_first_of("\r\n"), line.size()))) };
}

std::filesystem::path bakeProgram() {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path beside = own.parent_path() / "filament-bake";
    return !error && std::filesystem::exists(beside, error) ? beside : std::filesystem::path("filament-bake");
}

Result<void> BakeRun::start(BakeRequest const& request) {
    if (mChild) return fail(ErrorCode::InvalidArgument, "a bake is running: cancel it first");
    Result<BakeCommand> command = bakeCommand(request);
    if (!command) return command.error();
    std::error_code error;
    std::filesystem::create_directories(command->folder, error);
    if (error) return fail(ErrorCode::Unreadable, "{}: {}", command->folder.string(), error.message());
    if (!command->grid.empty()) {
        const auto bytes = std::as_bytes(std::span(command->grid));
        const Result<void> written = assets::replaceFile(command->folder / "grid.json", bytes);
        if (!written) return written;
    }
    mCommand = std::move(*command);
    mKind = request.settings.kind;
    Result<tools::ChildProcess> child =
            tools::ChildProcess::start({ .words = mCommand.words, .environment = {}, .log = log() });
    if (!child) return child.error();
    mChild.emplace(std::move(*child));
    mProgress = { .isRunning = true, .line = "preparing" };
    mIsCancelled = false;
    return {};
}

void BakeRun::cancel() {
    if (!mChild) return;
    mIsCancelled = true;
    mChild->kill();
}

std::optional<Result<BakeResult>> BakeRun::poll() {
    if (!mChild) return std::nullopt;
    const bool isDue = std::chrono::steady_clock::now() >= mNextLook;
    const std::optional<tools::ChildEnd> end = mIsCancelled ? tools::ChildEnd{} : mChild->poll();
    if (!end && !isDue) return std::nullopt;
    mNextLook = std::chrono::steady_clock::now() + kBakeLookInterval;
    const Result<std::string> text = assets::readText(log(), kLongestBakeLog);
    if (!end) {
        if (BakeProgress read = text ? progressIn(*text) : BakeProgress{}; read.isRunning) mProgress = std::move(read);
        return std::nullopt;
    }
    mChild.reset();
    mProgress = {};
    if (mIsCancelled) return Result<BakeResult>(fail(ErrorCode::Cancelled, "the bake was cancelled"));
    if (end->exitStatus == 0 && end->signal == 0) return Result<BakeResult>(BakeResult{ mKind, mCommand.file });
    const std::string reason = text ? reasonIn(*text) : std::string();
    return Result<BakeResult>(fail(ErrorCode::Unreadable, "filament-bake ended with {}: {}", end->text(),
                                   reason.empty() ? "it gave no reason" : reason));
}

} // namespace filament_core::view
